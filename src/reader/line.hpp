// reader/line.hpp
//
// Line: one line of G-code taken apart into command, parameters and comment. No copies.
//
//   "N17 G1 X1.5 E.2 ; to the left*71"  ->  command "G1", X = 1.5, E = 0.2, comment " to the left"
//
// Understood: line numbers and checksums (the checksum is verified), lower case, no blanks between words ("G1X1Y2"),
// comments behind ";" and in "( )", quoted strings (RepRapFirmware), commands in words (Klipper: "SET_VELOCITY_LIMIT
// ACCEL=1000"), lines that go on with the command before ("X10 Y20"). A number is what firmware reads: "1", "-.5",
// "1.", "+2"; never "nan", "inf" or an exponent: "X1E5" is X1 and E5.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace cleancolor {

struct GcodeLine {
  char letter = 0;             // 'G', 'M', 'T' ...; 0: no command, one in words, or parameters alone
  int number = -1;             // 92 of "G92"
  int fraction = 0;            // 1 of "G92.1"
  std::string_view word;       // "SET_VELOCITY_LIMIT": a command in words, else empty
  std::string_view arguments;  // all that stands behind the command and before the comment
  std::string_view comment;    // behind the first ';', not trimmed; empty where there is none
  bool has_comment = false;

  std::uint32_t present = 0;          // bit k: the parameter 'A' + k is there
  std::uint32_t valued = 0;           // and has a number
  std::array<double, 26> value = {};  // valid where the bit of `valued` is set

  bool has(char parameter) const { return present >> (parameter - 'A') & 1; }
  bool has_value(char parameter) const { return valued >> (parameter - 'A') & 1; }
  double operator[](char parameter) const { return value[std::size_t(parameter - 'A')]; }
  double value_or(char parameter, double otherwise) const {
    return has_value(parameter) ? (*this)[parameter] : otherwise;
  }
};

/// Takes a line apart. A fault (a number that is none, but for M commands, which may speak of anything; a wrong
/// checksum) is told in words: the caller knows file and line.
///
/// Fills `line` anew; value[] is written only where a parameter is there.
/// Cost: about 10 ns and 12 ns a parameter.  Returns: nothing, or what is wrong.
std::optional<std::string_view> parse_line(std::string_view text, GcodeLine& line);

/// The number behind KEY= in the arguments of a command in words ("ACCEL=1000"), or nothing.
std::optional<double> word_argument(std::string_view arguments, std::string_view key);

}  // namespace cleancolor
