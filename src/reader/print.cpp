#include "reader/print.hpp"

#include <algorithm>

namespace cleancolor {

std::size_t line_number(std::string_view text, std::size_t offset) {
  const auto end = text.begin() + std::ptrdiff_t(std::min(offset, text.size()));
  return std::size_t(std::count(text.begin(), end, '\n')) + 1;
}

std::string_view line_at(std::string_view text, std::size_t offset) {
  if (offset > text.size()) return {};
  const std::size_t before = offset == 0 ? std::string_view::npos : text.rfind('\n', offset - 1);
  const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
  std::string_view line = text.substr(begin, text.find('\n', begin) - begin);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

}  // namespace cleancolor
