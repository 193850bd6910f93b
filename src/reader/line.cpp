#include "reader/line.hpp"

#include <cstddef>

#include "model/text_scan.hpp"

namespace cleancolor {
namespace {

constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
constexpr bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}
constexpr char upper(char c) {
  return c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c;
}
constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

constexpr std::array<double, 19> powers_of_ten = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8, 1e9,
                                                  1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18};

/// A plain decimal at p; nullptr where there is none. Exact for up to 15 digits, and close beyond.
const char* decimal(const char* p, const char* end, double& value) {
  const bool negative = p < end && *p == '-';
  if (p < end && (*p == '-' || *p == '+')) ++p;
  std::uint64_t mantissa = 0;
  int digits = 0, skipped = 0, decimals = 0;
  const char* const first = p;
  for (; p < end && is_digit(*p); ++p) {
    if (digits < 18) {
      mantissa = mantissa * 10 + std::uint64_t(*p - '0');
      digits += mantissa != 0;
    } else {
      ++skipped;
    }
  }
  bool any = p > first;
  if (p < end && *p == '.') {
    const char* const point = p++;
    for (; p < end && is_digit(*p); ++p) {
      if (digits < 18 && decimals < 18) {
        mantissa = mantissa * 10 + std::uint64_t(*p - '0');
        digits += mantissa != 0;
        ++decimals;
      }
    }
    any = any || p > point + 1;
  }
  if (!any) return nullptr;
  value = double(mantissa) / powers_of_ten[std::size_t(decimals)];
  for (; skipped > 0 && value < 1e300; --skipped) value *= 10;
  if (negative) value = -value;
  return p;
}

/// The XOR of all bytes before the '*'.
int checksum(const char* p, const char* star) {
  unsigned char sum = 0;
  for (; p < star; ++p) sum = static_cast<unsigned char>(sum ^ static_cast<unsigned char>(*p));
  return sum;
}

/// Past a comment in parentheses, or to the end of the line.
const char* past_parenthesis(const char* p, const char* end) {
  while (p < end && *p != ')') ++p;
  return p < end ? p + 1 : end;
}

/// Past a quoted text; "" inside stands for one quote.
const char* past_quotes(const char* p, const char* end) {
  for (++p; p < end; ++p) {
    if (*p != '"') continue;
    if (p + 1 < end && p[1] == '"') {
      ++p;
    } else {
      return p + 1;
    }
  }
  return end;
}

/// "G92", "G92.1", "T0", "T-1" or "SET_FOO"; returns where its arguments begin.
const char* command(const char* p, const char* end, GcodeLine& line) {
  const char* const first = p;
  const char letter = upper(*p++);
  if (p < end && is_digit(*p)) {
    line.letter = letter;
    line.number = 0;
    for (; p < end && is_digit(*p); ++p)
      if (line.number < 100000) line.number = line.number * 10 + (*p - '0');
    if (p < end && *p == '.') {
      for (++p; p < end && is_digit(*p); ++p)
        if (line.fraction < 1000) line.fraction = line.fraction * 10 + (*p - '0');
    }
    return p;
  }
  if (letter == 'T' && (p == end || !(is_letter(*p) || *p == '_'))) {  // "T", "T-1", "T?": no tool, or one to be found
    line.letter = letter;
    return p;
  }
  while (p < end && (is_letter(*p) || is_digit(*p) || *p == '_' || *p == '.')) ++p;
  line.word = {first, std::size_t(p - first)};
  return p;
}

}  // namespace

std::optional<std::string_view> parse_line(std::string_view text, GcodeLine& line) {
  line.letter = 0, line.number = -1, line.fraction = 0;
  line.word = line.arguments = line.comment = {};
  line.has_comment = false;
  line.present = line.valued = 0;
  std::optional<std::string_view> fault;

  const char* p = text.data();
  const char* end = p + text.size();
  const char* const begin = p;
  while (p < end && is_blank(*p)) ++p;
  if (p < end && upper(*p) == 'N' && p + 1 < end && is_digit(p[1])) {
    for (++p; p < end && is_digit(*p);) ++p;
    while (p < end && is_blank(*p)) ++p;
  }
  while (p < end && *p == '(') {
    p = past_parenthesis(p, end);
    while (p < end && is_blank(*p)) ++p;
  }
  if (p < end && *p == '%') return fault;  // begin or end of a tape
  if (p < end && is_letter(*p)) {
    p = command(p, end, line);
  } else if (p < end && *p != ';') {
    return "a command begins with a letter";
  }
  const char* const arguments = p;
  const char* arguments_end = end;
  const bool free_text = !line.word.empty();
  while (p < end) {
    const char c = *p;
    if (is_blank(c)) {
      ++p;
    } else if (c == ';') {
      arguments_end = p;
      line.has_comment = true;
      line.comment = {p + 1, std::size_t(end - p - 1)};
      if (line.comment.ends_with('\r')) line.comment.remove_suffix(1);
      break;
    } else if (c == '*') {
      arguments_end = p;
      double told = -1;
      const char* after = decimal(p + 1, end, told);
      if (after != nullptr && *begin != ';' && told != checksum(begin, p) && !free_text)
        fault = "the checksum is wrong";
      p = after != nullptr ? after : p + 1;
    } else if (c == '(') {
      p = past_parenthesis(p, end);
    } else if (c == '"') {
      p = past_quotes(p, end);
    } else if (is_letter(c) && !free_text) {
      const auto bit = std::uint32_t{1} << (upper(c) - 'A');
      line.present |= bit;
      double value = 0;
      const char* after = decimal(p + 1, end, value);
      if (after == nullptr && p + 1 < end && (p[1] == ' ' || p[1] == '=')) {  // "X 10", "P=1" as some write it
        const char* q = p + 1;
        while (q < end && (*q == ' ' || *q == '=')) ++q;
        if (q < end && (is_digit(*q) || *q == '-' || *q == '+' || *q == '.')) after = decimal(q, end, value);
      }
      if (after != nullptr) {
        line.valued |= bit;
        line.value[std::size_t(upper(c) - 'A')] = value;
        p = after;
        if (p < end && *p == '.' && line.letter == 'G' && !fault) fault = "a number has two decimal points";
      } else {
        ++p;
      }
    } else {
      ++p;  // ':' of lists and whatever else; known to the command alone
    }
  }
  line.arguments = {arguments, std::size_t(arguments_end - arguments)};
  return fault;
}

std::optional<double> word_argument(std::string_view arguments, std::string_view key) {
  for (std::size_t at = 0; at < arguments.size();) {
    while (at < arguments.size() && (is_blank(arguments[at]))) ++at;
    std::size_t stop = at;
    while (stop < arguments.size() && !is_blank(arguments[stop])) ++stop;
    const std::string_view word = arguments.substr(at, stop - at);
    if (word.size() > key.size() && word[key.size()] == '=') {
      bool same = true;
      for (std::size_t k = 0; k < key.size(); ++k) same = same && upper(word[k]) == key[k];
      if (same) return number<double>(word.substr(key.size() + 1));
    }
    at = stop;
  }
  return std::nullopt;
}

}  // namespace cleancolor
