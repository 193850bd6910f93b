#include "replan/gap.hpp"

namespace cleancolor {

std::vector<std::string> texts_of(std::span<const GapLine> lines) {
  std::vector<std::string> texts;
  for (const GapLine& line : lines) texts.emplace_back(line.text);
  return texts;
}

}  // namespace cleancolor
