#include "replan/tool_changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "model/text_scan.hpp"
#include "reader/line.hpp"

namespace cleancolor {
namespace {

/// Where the line sets the temperature of that tool, which is taken: the number's place in it.
std::optional<std::span<const char>> temperature_in(const std::string& text, int tool) {
  GcodeLine line;
  const bool fails = parse_line(text, line).has_value();
  const bool sets = !fails && line.letter == 'M' && (line.number == 104 || line.number == 109) && line.has_value('S');
  const std::size_t at = text.find(" S");
  if (!sets || line.value_or('T', tool) != tool || at == text.npos) return std::nullopt;
  const std::size_t begin = at + 2, end = std::min(text.find_first_not_of("0123456789.", begin), text.size());
  return std::span(text).subspan(begin, end - begin);
}

std::string with_temperature(const std::string& text, int tool, const std::string& to) {
  const auto number = temperature_in(text, tool);
  if (!number) return text;
  std::string changed = text;
  return changed.replace(std::size_t(number->data() - text.data()), number->size(), to);
}

/// Comments, and what the printer shows: it may tell the layer, or the tool that follows.
bool only_tells(const std::string& text) {
  GcodeLine line;
  if (parse_line(text, line)) return false;
  const bool shows = line.letter == 'M' && (line.number == 117 || line.number == 118);
  return shows || (line.letter == 0 && line.word.empty() && line.present == 0);
}

/// Without the comment behind it.
std::string command_of(const std::string& text) {
  return std::string(trimmed(std::string_view(text).substr(0, text.find(';'))));
}

/// Whether they are the same but for what only tells. What tells another thing in both goes from the first.
/// but: makes of a line what must be the same.
template <class But>
bool join(ToolChanges::Lines& known, const ToolChanges::Lines& lines, But but) {
  if (known.size() != lines.size()) return false;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (but(known[i]) == but(lines[i])) continue;
    const std::string command = command_of(known[i]), other = command_of(lines[i]);
    if (only_tells(known[i]) && only_tells(lines[i]))
      known[i].clear();
    else if (but(command) == but(other))
      known[i] = command;
    else
      return false;
  }
  return true;
}

}  // namespace

bool ToolChanges::take_leave(int tool, const Lines& lines) {
  return join(leave_.try_emplace(tool, lines).first->second, lines, std::identity());
}

bool ToolChanges::take_enter(int tool, const Lines& lines, bool in_first_layer) {
  auto &own = in_first_layer ? enter_first_ : enter_, &other = in_first_layer ? enter_ : enter_first_;
  const auto but_hot = [&](const std::string& text) { return with_temperature(text, tool, ""); };
  if (const auto found = other.find(tool); found != other.end() && !join(found->second, lines, but_hot)) return false;
  return join(own.try_emplace(tool, lines).first->second, lines, std::identity());
}

const ToolChanges::Lines* ToolChanges::leave(int tool) const {
  const auto found = leave_.find(tool);
  return found == leave_.end() ? nullptr : &found->second;
}

ToolChanges::Lines ToolChanges::enter(int tool, bool in_first_layer, const Extruder& extruder) const {
  const auto &own = in_first_layer ? enter_first_ : enter_, &other = in_first_layer ? enter_ : enter_first_;
  if (const auto found = own.find(tool); found != own.end()) return found->second;
  const auto found = other.find(tool);
  if (found == other.end()) return {};
  const std::string first = fmt::format("{}", extruder.first_layer_temperature_c);
  const std::string later = fmt::format("{}", extruder.temperature_c);
  Lines lines = found->second;
  for (std::string& text : lines) {
    const auto number = temperature_in(text, tool);
    if (number && std::string(number->begin(), number->end()) == (in_first_layer ? later : first))
      text = with_temperature(text, tool, in_first_layer ? first : later);
  }
  return lines;
}

}  // namespace cleancolor
