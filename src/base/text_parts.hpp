// base/text_parts.hpp
//
// The parts of short texts that people type: numbers, and lists.
#pragma once

#include <charconv>
#include <string_view>
#include <system_error>
#include <vector>

namespace cleancolor {

/// Whether the whole text is one number.
template <class T>
bool parse_whole(std::string_view text, T& value) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  return fault == std::errc() && end == text.data() + text.size();
}

/// The pieces between the letters `at`; one where there is none.
std::vector<std::string_view> split(std::string_view text, char at);

}  // namespace cleancolor
