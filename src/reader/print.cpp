#include "reader/print.hpp"

#include <cmath>

#include <algorithm>

namespace cleancolor {
namespace {

/// Files of very old systems end their lines with '\r' alone.
char line_end(std::string_view text) {
  return text.find('\n') == text.npos ? '\r' : '\n';
}

}  // namespace

bool lays_plastic(const GcodePrint& print, std::size_t i) {
  const GcodeMove& move = print.moves[i];
  if (i == 0 || move.filament_mm <= 0 || !move.known_start) return false;
  const Vec3& from = print.moves[i - 1].to_mm;
  return from.x != move.to_mm.x || from.y != move.to_mm.y;
}

std::size_t line_number(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  return std::size_t(std::ranges::count(before, line_end(text))) + 1;
}

std::string_view line_at(std::string_view text, std::size_t offset) {
  if (offset > text.size()) return {};
  const char end = line_end(text);
  const std::size_t before = offset == 0 ? text.npos : text.rfind(end, offset - 1);
  const std::size_t begin = before == text.npos ? 0 : before + 1;
  std::string_view line = text.substr(begin, text.find(end, begin) - begin);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::string_view last_value(const GcodeFacts& facts, std::string_view key) {
  std::string_view found;
  for (const IniEntry& entry : facts.config)
    if (entry.key == key) found = entry.value;
  return found;
}

double way_mm(const GcodePrint& print, std::size_t i) {
  const Vec3 from = print.moves[i - 1].to_mm, to = print.moves[i].to_mm;
  return std::hypot(to.x - from.x, to.y - from.y);
}

}  // namespace cleancolor
