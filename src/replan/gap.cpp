#include "replan/gap.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/text_scan.hpp"
#include "reader/line.hpp"
#include "replan/file_parts.hpp"

namespace cleancolor {

void Gap::begin_tool(int tool) {
  tool_at_ = docks_at_.value_or(lines_.size());
  // Temperatures in the header of a layer are the layer's.
  for (std::size_t i = layer_at_ ? *tool_at_ : 0; i < *tool_at_; ++i) {
    GcodeLine line;
    const bool fails = parse_line(lines_[i].text, line).has_value();
    if (fails || line.letter != 'M' || (line.number != 104 && line.number != 109)) continue;
    if (line.has_value('T') && int(line['T']) == tool) tool_at_ = i;
  }
}

std::vector<std::string> texts_of(std::span<const GapLine> lines) {
  std::vector<std::string> texts;
  for (const GapLine& line : lines) texts.emplace_back(line.text);
  return texts;
}

std::vector<std::string> notes_of(std::span<const GapLine> lines, const GcodePrint& print) {
  if (const auto found = std::ranges::find_if(lines, &GapLine::is_command); found != lines.end())
    refuse_line(print, found->offset,
                fmt::format("'{}' between two roads: it cannot be moved; take it out of the slicer's custom G-code",
                            shown(trimmed(found->text))));
  return texts_of(lines);
}

}  // namespace cleancolor
