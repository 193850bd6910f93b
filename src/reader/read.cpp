#include "reader/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

/// Commands that may move, so that the moves of all but arcs need no second allocation.
std::size_t most_moves(std::string_view text) {
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

/// Reads all lines into the print. Returns the cross-section of each tool's filament.
std::vector<double> read_lines(GcodePrint& print, const Progress& progress) {
  const std::string_view text = *print.text;
  const char line_end = text.find('\n') == text.npos ? '\r' : '\n';
  const std::size_t report_bytes = std::max<std::size_t>(text.size() / 50, 1 << 20);
  Interpreter interpreter(print);
  GcodeLine line;
  std::size_t next_report = 0;
  for (std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0; at < text.size();) {
    const std::size_t stop = std::min(text.find(line_end, at), text.size());
    const std::string_view words = text.substr(at, stop - at);
    if (words.size() > longest_line && std::min(words.find(';'), words.size()) > longest_line)
      throw Error(fmt::format("{}:{}: a line of more than 1 MB; this is no G-code", print.name, line_number(text, at)));
    if (const auto fault = parse_line(words, line))
      throw Error(fmt::format("{}:{}: {}; the file is damaged, export or download it again", print.name,
                              line_number(text, at), *fault));
    interpreter.run(line, std::uint32_t(at));
    at = stop + 1;
    if (at < next_report) continue;
    next_report = at + report_bytes;
    if (progress.interrupted()) throw Error("interrupted");
    progress.advance("reading", double(std::min(at, text.size())) / double(text.size()));
  }
  interpreter.finish();
  const auto& areas = interpreter.filament().area_mm2();
  return {areas.begin(), areas.end()};
}

bool any_plastic(const GcodePrint& print) {
  for (std::size_t i = 0; i < print.moves.size(); ++i)
    if (lays_plastic(print, i)) return true;
  return false;
}

/// What is extruded before the file first says what it prints is the user's start code.
void mark_start_code(GcodePrint& print) {
  const std::size_t says_so = print.text->find(";TYPE:Unknown");
  const auto told = std::ranges::find_if(
      print.moves, [&](const GcodeMove& m) { return m.role != Role::unknown || m.offset > says_so; });
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
  print.moves.reserve(std::min(most_moves(*print.text), print.text->size() / 8));
  const std::vector<double> filament_area_mm2 = read_lines(print, progress);
  if (print.facts.volumetric_e && print.facts.filament_diameter_mm.empty())
    print.facts.filament_diameter_mm = {2 * std::sqrt(filament_area_mm2.front() / std::numbers::pi)};
  if (!any_plastic(print)) throw Error(fmt::format("{}: no move lays plastic; is this G-code of a printer?", name));
  mark_start_code(print);
  assign_layers(print, filament_area_mm2);
  return print;
}

GcodePrint read_gcode_file(const std::filesystem::path& file, const Progress& progress) {
  return read_gcode(gcode_text(file), file.string(), progress);
}

std::string gcode_text(const std::filesystem::path& file) {
  return end_of_file(file, std::numeric_limits<std::uint32_t>::max());
}

}  // namespace cleancolor
