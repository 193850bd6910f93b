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

/// Whether the number behind the '*' is the XOR of all bytes before it, as it has to be where a line has a number.
bool checksum_holds(const char* p, const char* star, const char* end) {
  unsigned char sum = 0;
  for (; p < star; ++p) sum = static_cast<unsigned char>(sum ^ static_cast<unsigned char>(*p));
  double told = -1;
  const char* rest = decimal(star + 1, end, told);
  while (rest != nullptr && rest < end && is_blank(*rest)) ++rest;
  return rest == end && told == sum;
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

/// The line without its checksum, in front of or behind the comment; a checksum in front of it has to hold. A '*' in a
/// comment may be one of its words.
std::string_view without_checksum(std::string_view numbered, std::optional<std::string_view>& fault) {
  const std::size_t star = numbered.rfind('*');
  if (star == numbered.npos) return numbered;
  const char* const begin = numbered.data();
  if (checksum_holds(begin, begin + star, begin + numbered.size())) return numbered.substr(0, star);
  if (star > numbered.find(';')) return numbered;
  fault = "the checksum is wrong";
  return numbered.substr(0, star);
}

/// Letters of a line that goes on with the command before: "X10 Y20" behind a line with G1.
constexpr bool is_modal(char letter) {
  return std::string_view("XYZEFIJRAB").find(letter) != std::string_view::npos;
}

/// "G92", "G92.1", "T0", "T-1" or "SET_FOO"; returns where its arguments begin.
const char* command(const char* p, const char* end, GcodeLine& line) {
  const char* const first = p;
  const char letter = upper(*p++);
  if (p < end && !is_letter(*p) && *p != '_' && is_modal(letter)) return first;
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
  // Whatever else it is ("SET_FOO", "@pause", "<html>"), it ends at the next blank.
  while (p < end && !is_blank(*p) && *p != ';') ++p;
  line.word = {first, std::size_t(p - first)};
  return p;
}

/// One parameter, from its letter on; returns what follows it.
const char* parameter(const char* p, const char* end, GcodeLine& line, std::optional<std::string_view>& fault) {
  const char letter = upper(*p++);
  const auto bit = std::uint32_t{1} << (letter - 'A');
  line.present |= bit;
  const char* at = p;
  while (at < end && (*at == ' ' || *at == '=')) ++at;  // "X 10", "P=1" as some write it
  double value = 0;
  const char* const after = decimal(at, end, value);
  if (after == nullptr) return p;
  line.valued |= bit;
  line.value[std::size_t(letter - 'A')] = value;
  if (after < end && (*after == '.' || *after == '-' || *after == '+')) fault = "this is no number";
  return after;
}

void parameters(const char* p, const char* end, GcodeLine& line, std::optional<std::string_view>& fault) {
  const char* const arguments = p;
  const bool in_words = !line.word.empty();
  while (p < end && *p != ';') {
    if (*p == '(') {
      p = past_parenthesis(p, end);
    } else if (*p == '"') {
      p = past_quotes(p, end);
    } else if (is_letter(*p) && !in_words) {
      p = parameter(p, end, line, fault);
    } else {
      ++p;  // blanks, and ':' between the values of a list
    }
  }
  line.arguments = {arguments, std::size_t(p - arguments)};
  if (p == end) return;
  line.has_comment = true;
  line.comment = {p + 1, std::size_t(end - p - 1)};
}

}  // namespace

std::optional<std::string_view> parse_line(std::string_view text, GcodeLine& line) {
  line.letter = 0, line.number = -1, line.fraction = 0;
  line.word = line.arguments = line.comment = {};
  line.has_comment = false;
  line.present = line.valued = 0;
  std::optional<std::string_view> fault;

  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  if (text.ends_with('\r')) text.remove_suffix(1);
  const bool numbered = text.size() > 1 && upper(text[0]) == 'N' && is_digit(text[1]);
  if (numbered) text = without_checksum(text, fault);
  const char* p = text.data();
  const char* const end = p + text.size();
  if (numbered) {
    for (++p; p < end && is_digit(*p);) ++p;
  }
  while (p < end && (is_blank(*p) || *p == '(')) p = *p == '(' ? past_parenthesis(p, end) : p + 1;
  if (p == end || *p == '%') return fault;  // "%": begin or end of a tape
  std::optional<std::string_view> odd_number;
  if (*p != ';') p = command(p, end, line);
  parameters(p, end, line, odd_number);
  // Text behind M117 and its like may look like a number that is none.
  return !fault && line.letter != 'M' ? odd_number : fault;
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
