// model/text_scan.hpp
//
// Scanner: the words of a text file one after another, and the line they stand on, for the strict readers.
//
// Blanks, tabs, CR, LF and CRLF separate words, so line ends of every system read alike. Views into the text, no
// copies.
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

namespace cleancolor {

/// The number that the whole word spells, or nothing: "1e3", "+2.5", "-0". Words like "nan" and "inf" are no numbers.
template <class Number>
std::optional<Number> number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  if (word.starts_with('+') || word.empty()) return std::nullopt;
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>)
    if (!std::isfinite(value)) return std::nullopt;
  return value;
}

/// Whether the word is this lower-case keyword, in any case.
inline bool is_keyword(std::string_view word, std::string_view keyword) {
  if (word.size() != keyword.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char c = word[i];
    if ((c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c) != keyword[i]) return false;
  }
  return true;
}

/// The text without the blanks and line ends around it.
inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == text.npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  /// The next word; empty at the end of the text.
  std::string_view word() {
    while (at_ < text_.size() && (is_blank(text_[at_]) || is_line_end(text_[at_]))) ++at_;
    return rest_of_word();
  }

  /// The next word on this line; empty where the line ends.
  std::string_view word_on_line() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    return rest_of_word();
  }

  /// What is left of this line, without its end; the next word is then on the next line.
  std::string_view rest_of_line() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    const std::size_t from = at_;
    while (at_ < text_.size() && !is_line_end(text_[at_])) ++at_;
    const std::string_view line = text_.substr(from, at_ - from);
    if (at_ < text_.size()) at_ += text_.substr(at_).starts_with("\r\n") ? 2 : 1;
    return line;
  }

  bool done() const { return at_ >= text_.size(); }

  /// 1-based line of the word read last; counted only when asked, for messages.
  std::size_t line() const {
    std::size_t lines = 1;
    for (std::size_t i = 0; i < at_; ++i)
      lines += text_[i] == '\n' || (text_[i] == '\r' && (i + 1 == text_.size() || text_[i + 1] != '\n')) ? 1 : 0;
    return lines;
  }

  std::size_t position() const { return at_; }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\0'; }
  static bool is_line_end(char c) { return c == '\n' || c == '\r'; }

  std::string_view rest_of_word() {
    const std::size_t from = at_;
    while (at_ < text_.size() && !is_blank(text_[at_]) && !is_line_end(text_[at_])) ++at_;
    return text_.substr(from, at_ - from);
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// A word as a message may show it: at most 40 characters, nothing unprintable.
inline std::string shown(std::string_view word) {
  std::string text;
  for (const char c : word.substr(0, 40)) text += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return word.size() > 40 ? text + "..." : text;
}

}  // namespace cleancolor
