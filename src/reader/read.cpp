#include "reader/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <numbers>

#include "base/error.hpp"
#include "model/text_file.hpp"
#include "reader/interpreter.hpp"
#include "reader/layers.hpp"

namespace cleancolor {
namespace {

constexpr std::size_t longest_line = std::size_t{1} << 20;

void require_text(std::string_view text, const std::string& name) {
  if (text.empty()) throw Error(fmt::format("{}: the file is empty", name));
  if (text.starts_with("GCDE")) {
    throw Error(fmt::format(
        "{}: this is binary G-code (.bgcode); switch off \"Supports binary G-code\" in the printer settings "
        "and export again, or convert it with PrusaSlicer: File > Convert > Convert binary G-code to ASCII",
        name));
  }
  if (text.starts_with("PK\x03\x04")) {
    throw Error(
        fmt::format("{}: this is a zip archive, not G-code; of a .gcode.3mf unpack Metadata/plate_1.gcode", name));
  }
  if (const void* zero = std::memchr(text.data(), 0, text.size())) {
    const auto at = std::size_t(static_cast<const char*>(zero) - text.data());
    throw Error(fmt::format("{}:{}: this is binary data, not G-code", name, line_number(text, at)));
  }
  if (text.size() >= std::numeric_limits<std::uint32_t>::max())
    throw Error(fmt::format("{}: more than 4 GB of G-code are not supported", name));
}

/// Lines that begin with G0 ... G3, so that moves need no second allocation.
std::size_t count_moves(std::string_view text) {
  std::size_t count = 0;
  const char* const end = text.data() + text.size();
  for (const char* p = text.data(); p < end;) {
    if (*p == 'G' || *p == 'N') ++count;
    const void* next = std::memchr(p, '\n', std::size_t(end - p));
    if (next == nullptr) break;
    p = static_cast<const char*>(next) + 1;
  }
  return count;
}

void read_lines(GcodePrint& print, const Progress& progress) {
  const std::string_view text = *print.text;
  Interpreter interpreter(print);
  GcodeLine line;
  std::size_t next_report = 0;
  for (std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0; at < text.size();) {
    const std::size_t stop = std::min(text.find('\n', at), text.size());
    const std::string_view words = text.substr(at, stop - at);
    if (words.size() > longest_line && words.front() != ';')
      throw Error(fmt::format("{}:{}: a line of more than 1 MB; this is no G-code", print.name, line_number(text, at)));
    if (const auto fault = parse_line(words, line))
      throw Error(fmt::format("{}:{}: {}; the file is damaged", print.name, line_number(text, at), *fault));
    interpreter.run(line, std::uint32_t(at));
    at = stop + 1;
    if (at >= next_report) {
      progress.advance("reading", double(std::min(at, text.size())) / double(text.size()));
      next_report = at + text.size() / 50 + 1;
    }
  }
  interpreter.finish();
}

bool lays(const GcodePrint& print, std::size_t i) {
  const GcodeMove& move = print.moves[i];
  if (move.filament_mm <= 0 || !move.known_start || i == 0) return false;
  const Vec3 from = print.moves[i - 1].to_mm;
  return from.x != move.to_mm.x || from.y != move.to_mm.y;
}

/// What is extruded before the file first says what it prints is the user's start code.
void mark_start_code(GcodePrint& print) {
  const auto told = std::ranges::find_if(print.moves, [](const GcodeMove& m) { return m.role != Role::unknown; });
  if (told == print.moves.end()) return;
  for (auto move = print.moves.begin(); move != told; ++move) move->role = Role::custom;
}

}  // namespace

GcodePrint read_gcode(std::string text, const std::string& name, const Progress& progress) {
  require_text(text, name);
  GcodePrint print;
  print.name = name;
  print.text = std::make_shared<const std::string>(std::move(text));
  read_facts(*print.text, name, print.facts, print.warnings);
  print.moves.reserve(count_moves(*print.text));
  read_lines(print, progress);
  bool any = false;
  for (std::size_t i = 0; i < print.moves.size() && !any; ++i) any = lays(print, i);
  if (!any) throw Error(fmt::format("{}: no move lays plastic; is this G-code of a printer?", name));
  mark_start_code(print);
  std::vector<double> areas(max_tools, std::numbers::pi / 4 * 1.75 * 1.75);
  const std::vector<double>& d = print.facts.filament_diameter_mm;
  for (std::size_t t = 0; t < areas.size() && !d.empty(); ++t) {
    const double diameter = d[std::min(t, d.size() - 1)];
    areas[t] = std::numbers::pi / 4 * diameter * diameter;
  }
  assign_layers(print, areas);
  return print;
}

GcodePrint read_gcode_file(const std::filesystem::path& file, const Progress& progress) {
  return read_gcode(end_of_file(file, std::numeric_limits<std::uint32_t>::max()), file.string(), progress);
}

}  // namespace cleancolor
