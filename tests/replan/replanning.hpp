// For tests of replan: the file of a slicer, and what becomes of it.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <sstream>
#include <tuple>

#include "audit/audit.hpp"
#include "reader/read.hpp"
#include "replan/replan.hpp"
#include "replan/worth.hpp"
#include "support_errors.hpp"

namespace cleancolor::test {

inline std::string fixture(const std::string& name) {
  return file_text(std::string(CLEANCOLOR_ROOT) + "/tests/replan/files/" + name);
}

inline Replanned replanned_text(const std::string& text, const ReplanRequest& request = {},
                                const Progress& progress = {}, const MachineRequest& where = {}) {
  const GcodePrint print = read_gcode(text, "in.gcode");
  return replanned(print, audit_machine(print, where), request, progress);
}

/// The text with one line put before the first that begins so, beyond `after` bytes.
inline std::string with_line(std::string text, const std::string& line, const std::string& before,
                             std::size_t after = 0) {
  const std::size_t at = text.find("\n" + before, after);
  return text.insert(at + 1, line + "\n");
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  return at == text.npos ? text : text.replace(at, what.size(), by);
}

using ToolRole = std::pair<int, Role>;

/// Filament of the part, mm.
inline std::map<ToolRole, double> part_filament(const GcodePrint& print) {
  std::map<ToolRole, double> sums;
  for (std::size_t i = 0; i < print.moves.size(); ++i)
    if (lays_plastic(print, i) && !is_auxiliary(print.moves[i].role))
      sums[{print.moves[i].feeds, print.moves[i].role}] += print.moves[i].filament_mm;
  return sums;
}

/// Of all that is laid but walls of a rampart, mm.
inline std::map<ToolRole, double> kept_filament(const GcodePrint& print) {
  std::map<ToolRole, double> sums;
  for (std::size_t i = 0; i < print.moves.size(); ++i)
    if (lays_plastic(print, i) && print.moves[i].role != Role::rampart && print.moves[i].role != Role::refill)
      sums[{print.moves[i].feeds, print.moves[i].role}] += print.moves[i].filament_mm;
  return sums;
}

/// A road of the part, whichever way it is walked: tool, height, and both its ends, in micrometres.
using RoadKey =
    std::tuple<int, std::int64_t, std::pair<std::int64_t, std::int64_t>, std::pair<std::int64_t, std::int64_t>>;
inline std::map<RoadKey, int> part_roads(const GcodePrint& print) {
  std::map<RoadKey, int> roads;
  const auto um = [](double mm) { return std::int64_t(std::llround(mm * 1e3)); };
  for (std::size_t i = 1; i < print.moves.size(); ++i) {
    if (!lays_plastic(print, i) || is_auxiliary(print.moves[i].role)) continue;
    const Vec3 a = print.moves[i - 1].to_mm, b = print.moves[i].to_mm;
    std::pair from{um(a.x), um(a.y)}, to{um(b.x), um(b.y)};
    if (to < from) std::swap(from, to);
    ++roads[{print.moves[i].feeds, um(b.z), from, to}];
  }
  return roads;
}
inline double length_mm(const RoadKey& road) {
  const auto& [tool, z, from, to] = road;
  return std::hypot(double(to.first - from.first), double(to.second - from.second)) / 1000;
}

/// Of worst, as the audit counts.
inline Cleanness cleanness(const std::string& text, const MachineRequest& where = {}) {
  const GcodePrint print = read_gcode(text, "print.gcode");
  const AuditResult result = audit(print, audit_machine(print, where));
  return {result.scenarios.front().total.smear_volume(), result.scenarios.front().total.hole_volume,
          result.print_time_s};
}

/// Lines left out, said twice, swapped or with another letter: whatever comes in is refused, or planned whole.
/// spared: lines at the end that stay as they are. Returns: how many of the damaged files were planned.
inline int planned_of_damaged(
    const std::string& sound, unsigned count, std::size_t spared = 400,
    const std::function<Replanned(const std::string&)>& replan = [](const std::string& text) {
      return replanned_text(text);
    }) {
  std::vector<std::string> lines;
  std::istringstream in(sound);
  for (std::string line; std::getline(in, line);) lines.push_back(line + "\n");
  int planned = 0;
  for (unsigned seed = 0; seed < count; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::vector<std::string> damaged = lines;
    const std::size_t at = random() % (damaged.size() - spared), other = random() % (damaged.size() - spared);
    const auto place = damaged.begin() + std::ptrdiff_t(at);
    switch (random() % 4) {
      case 0:
        damaged.erase(place);
        break;
      case 1:
        damaged.insert(place, std::string(damaged[other]));
        break;
      case 2:
        std::swap(damaged[at], damaged[other]);
        break;
      default:
        damaged[at][0] = char('A' + random() % 26);
    }
    std::string text;
    for (const std::string& line : damaged) text += line;
    std::string out;
    try {
      out = replan(text).text;
    } catch (const Error&) {
      continue;
    }
    ++planned;
    const auto before = part_filament(read_gcode(text, "")), after = part_filament(read_gcode(out, ""));
    for (const auto& [what, mm] : before) EXPECT_NEAR(after.at(what), mm, 1e-4 * mm + 0.01);
  }
  return planned;
}

}  // namespace cleancolor::test
