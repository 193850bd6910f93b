#include "cli/words.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"

namespace cleancolor {

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> pieces;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.size(), text.find(at, begin));
    pieces.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return pieces;
}

void require_ending(const std::filesystem::path& path, std::string_view option, std::string_view ending,
                    std::string_view hint) {
  if (!path.empty() && path.extension() != ending)
    throw Error(fmt::format("{} {}: the file's name must end in {}; {}", option, path.string(), ending, hint));
}

}  // namespace cleancolor
