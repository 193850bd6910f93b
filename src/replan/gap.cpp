#include "replan/gap.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/text_scan.hpp"
#include "replan/file_parts.hpp"

namespace cleancolor {

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
