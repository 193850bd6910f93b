// gcode/text.hpp
//
// Text: the file as it grows. Lines are formatted by hand into a buffer: this is the serial part of the program.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace cleancolor {

/// Where the bytes of a file go, in order; patch() replaces some that were written before.
struct Sink {
  std::function<void(std::string_view bytes)> write;
  std::function<void(std::uint64_t offset, std::string_view bytes)> patch;
};

/// Writes value / 10^decimals at p and returns the end: no trailing zeros, no zero before the point, no "-0".
/// 203200 with 3 decimals: "203.2"; 350: ".35"; 0: "0".  Needs up to 22 bytes.
template <int decimals>
inline char* put_fixed(char* p, std::int64_t value) {
  constexpr auto power = [] {
    std::uint64_t n = 1;
    for (int i = 0; i < decimals; ++i) n *= 10;
    return n;
  }();
  if (value < 0) *p++ = '-';
  std::uint64_t rest = value < 0 ? 0 - std::uint64_t(value) : std::uint64_t(value);
  std::uint64_t whole = rest / power;
  std::uint64_t fraction = rest % power;
  if (whole != 0 || fraction == 0) {
    char digits[20];
    int n = 0;
    do {
      digits[n++] = char('0' + whole % 10);
      whole /= 10;
    } while (whole != 0);
    while (n > 0) *p++ = digits[--n];
  }
  if (fraction == 0) return p;
  *p++ = '.';
  for (int i = decimals - 1; i >= 0; --i) {
    p[i] = char('0' + fraction % 10);
    fraction /= 10;
  }
  p += decimals;
  while (p[-1] == '0') --p;
  return p;
}

class Text {
 public:
  explicit Text(Sink sink) : sink_(std::move(sink)), buffer_(capacity) {}

  /// Space for at least 512 bytes; what was written there is handed in by advance_to().
  char* room() {
    if (used_ + line_limit > capacity) flush();
    return buffer_.data() + used_;
  }
  void advance_to(const char* end) { used_ = std::size_t(end - buffer_.data()); }

  void put(std::string_view text);
  void line(std::string_view text) {
    put(text);
    put("\n");
  }

  std::uint64_t offset() const { return flushed_ + used_; }  // of the next byte in the file

  void flush();
  void patch(std::uint64_t offset, std::string_view bytes) {
    flush();
    sink_.patch(offset, bytes);
  }

 private:
  static constexpr std::size_t capacity = 1 << 16;
  static constexpr std::size_t line_limit = 512;

  Sink sink_;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
  std::uint64_t flushed_ = 0;
};

}  // namespace cleancolor
