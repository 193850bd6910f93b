#include "replan/file_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "model/text_scan.hpp"
#include "replan/modal.hpp"
#include "replan/refusals.hpp"

namespace cleancolor {
namespace {

constexpr double same_spot_mm = 0.002;

}  // namespace

void refuse_line(const GcodePrint& print, std::size_t offset, const std::string& what) {
  throw Error(fmt::format("{}:{}: {}", print.name, line_number(*print.text, offset), what));
}

bool begins_with_one_of(std::string_view line, const std::array<std::string_view, 2>& prefixes) {
  return std::ranges::any_of(prefixes, [&](std::string_view p) { return !p.empty() && line.starts_with(p); });
}

bool is_set(std::string_view value) {
  return !value.empty() && value.find_first_not_of("0.,%") != value.npos;
}

FileHabits habits_of_file(const GcodePrint& print) {
  FileHabits habits;
  const std::string_view slopes = last_value(print.facts, "travel_slope");
  habits.travel_slope =
      std::tan(number<double>(slopes.substr(0, slopes.find(','))).value_or(0) * std::numbers::pi / 180);
  habits.stands_aside = last_value(print.facts, "ooze_prevention") == "1";
  const std::string_view flavour = last_value(print.facts, "gcode_flavor");
  habits.says_on_and_off = flavour == "makerware";
  habits.e_of_each_tool = habits.says_on_and_off || flavour == "sailfish";
  const std::string_view text = *print.text;
  habits.says_roles_behind = print.facts.dialect == Dialect::slic3r && text.find("\n;TYPE:") == text.npos &&
                             text.find("gcode_comments = 1") != text.npos;
  return habits;
}

void require_rising(const RecoveredPrint& recovered, const GcodePrint& print) {
  for (std::size_t k = 1; k < recovered.layers.size(); ++k)
    if (recovered.layers[k].z_mm <= recovered.layers[k - 1].z_mm + same_height_mm)
      throw Error(
          fmt::format("{}: layer {} is no higher than the one before: objects that are printed one after the "
                      "other are not re-planned",
                      print.name, k + 1));
}

std::size_t line_end(std::string_view text, std::size_t at) {
  return std::min(text.find('\n', at), text.size() - 1) + 1;
}

std::size_t behind_wipe(std::string_view text, std::size_t at, std::size_t stop, const DialectWords& words) {
  for (std::size_t p = at; p < stop; p = line_end(text, p)) {
    const std::string_view line = text.substr(p, text.find('\n', p) - p);
    if (line.starts_with(words.wipe_ends)) return line_end(text, p);
    // Between road and wipe some slicers tell that the object ends, or another acceleration.
    GcodeLine told;
    const bool passes = line.empty() || line.starts_with('G') || line.starts_with(words.wipe_begins) ||
                        (!parse_line(line, told) && modal_line(told));
    if (!passes) break;
  }
  return at;
}

TowerPiece tower_piece(const GcodePrint& print, std::size_t first_road, double z_mm) {
  TowerPiece piece{.last_road = {}, .next_road_at = print.text->size()};
  for (std::size_t i = first_road; i < print.moves.size(); ++i) {
    if (!lays_plastic(print, i)) continue;
    const GcodeMove& move = print.moves[i];
    if (move.role != Role::wipe_tower || std::abs(move.to_mm.z - z_mm) > same_height_mm) {
      piece.next_road_at = move.offset;
      break;
    }
    piece.last_road = i;
  }
  return piece;
}

std::size_t behind_spiral(const GcodePrint& print, std::size_t move) {
  constexpr std::size_t most_moves = 256;
  if (move == 0 || !print.moves[move].known_start) return move;
  const Vec3 begin = print.moves[move - 1].to_mm;
  double z_mm = begin.z;
  for (std::size_t i = move; i < std::min(print.moves.size(), move + most_moves); ++i) {
    const GcodeMove& m = print.moves[i];
    if (m.filament_mm != 0 || m.to_mm.z <= z_mm) return move;
    z_mm = m.to_mm.z;
    if (std::hypot(m.to_mm.x - begin.x, m.to_mm.y - begin.y) <= same_spot_mm) return i > move ? i + 1 : move;
  }
  return move;
}

namespace {

/// Behind what the last nozzle still travels: it is no way from anywhere else.
std::size_t behind_last_way(std::string_view text, std::size_t at, const DialectWords& words) {
  while (true) {
    const std::string_view rest = text.substr(at);
    const bool travels = rest.starts_with("G0 ") && rest.substr(0, rest.find('\n')).find('Z') == rest.npos;
    if (!travels && !rest.starts_with(words.elapsed)) return at;
    at = line_end(text, at);
  }
}

}  // namespace

LayersText layers_text(const GcodePrint& print, const DialectWords& words) {
  const std::string_view text = *print.text, mark = words.layer_begins.front();
  if (text.find('\r') != text.npos)
    refuse_line(print, text.find('\r'),
                "some lines end with CR, others do not; save the file with line ends of one kind");
  std::size_t first = text.npos;
  for (const std::string_view begins : words.layer_begins)
    if (!begins.empty()) first = std::min(first, text.find(fmt::format("\n{}", begins)));
  if (first == text.npos)
    throw Error(fmt::format("{}: it has no {} comments{}", print.name, mark,
                            mark == ";LAYER_CHANGE" ? "; say them in the slicer's G-code after layer change (Slic3r: "
                                                      "layer_gcode = ;LAYER_CHANGE)"
                                                    : ", so that its layers are not known"));
  LayersText layers{.begin = first + 1};
  std::size_t last = 0;
  for (std::size_t i = 0; i < print.moves.size(); ++i) {
    if (!lays_plastic(print, i)) continue;
    layers.prints_after = words.tower_is_roads && is_auxiliary(print.moves[i].role);
    if (!layers.prints_after) last = print.moves[i].offset;
  }
  if (last <= first) refuse_line(print, last, fmt::format("nothing is printed after the first {}", mark));
  layers.end = behind_wipe(text, line_end(text, last), text.size(), words);
  if (words.tower_is_roads) layers.end = behind_last_way(text, layers.end, words);
  return layers;
}

void require_no_own_changes(const GcodePrint& print, const LayersText& layers) {
  if (const std::size_t at = print.text->find("\nM620 ", layers.begin); at < layers.end)
    refuse_line(print, at + 1,
                "the printer changes its filament by M620, which is not re-planned: it goes only where a tool change "
                "(T) moves nothing else");
}

void part_headers(RecoveredPrint& recovered, const std::vector<ChangedHeader>& changed, const GcodePrint& print,
                  const DialectWords& words) {
  const auto marks = [&](std::string_view line) {
    // PrusaSlicer's profiles tell the height behind marks of their own.
    const bool height_alone = line.starts_with(';') && number<double>(trimmed(line.substr(1)));
    return height_alone || line.starts_with(";AFTER_LAYER_CHANGE") || begins_with_one_of(line, words.header_ends) ||
           begins_with_one_of(line, words.layer_begins);
  };
  for (const ChangedHeader& c : changed) {
    std::vector<std::string>& header = recovered.layers[c.layer].header;
    const ToolChanges::Lines* known = recovered.changes.leave(c.from_tool);
    std::size_t plain = header.size();
    while (plain > 0 && !marks(header[plain - 1])) --plain;
    const std::size_t length = known != nullptr ? known->size() : header.size() - plain;
    const auto rest = header.end() - std::ptrdiff_t(std::min(length, header.size()));
    const std::vector<std::string> leave(rest, header.end());
    std::optional<FixedLines>& fixed = recovered.layers[c.layer].runs.front().fixed;
    if (fixed && !fixed->lays) {
      fixed->lines.insert(fixed->lines.begin(), leave.begin(), leave.end());
      fixed->tool_at = leave.size();
    } else if (!recovered.changes.take_leave(c.from_tool, leave)) {
      refuse_line(print, c.offset,
                  "a layer begins with a tool change that is not as those before; look at the custom G-code of tool "
                  "and filament");
    }
    header.erase(rest, header.end());
  }
}

}  // namespace cleancolor
