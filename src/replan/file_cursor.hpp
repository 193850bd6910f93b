// replan/file_cursor.hpp
//
// File cursor: line by line through a file's text, with the moves that each line makes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "reader/line.hpp"
#include "reader/print.hpp"

namespace cleancolor {

class FileCursor {
 public:
  /// Requires: the print has its text.
  explicit FileCursor(const GcodePrint& print) : print_(print), text_(*print.text) {}

  /// The next line. Throws Error where it is none of G-code.
  void read();

  std::size_t at() const { return at_; }      // the line's place in the text, bytes,
  std::size_t next() const { return next_; }  // and that of the one behind it
  std::string_view raw() const { return raw_; }
  const GcodeLine& line() const { return line_; }

  // Its moves, indices into GcodePrint::moves.
  std::size_t first_move() const { return first_move_; }
  std::size_t behind_moves() const { return behind_moves_; }
  bool moves() const { return first_move_ < behind_moves_; }

  /// Its move, where it makes one. Throws Error where it makes several.
  std::optional<std::size_t> move() const;

  /// The first move that lays plastic, of the line or behind it; else how many moves there are.
  std::size_t next_plastic();

  /// Throws Error("file:line: ...").
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  const GcodePrint& print_;
  std::string_view text_;
  std::size_t at_ = 0, next_ = 0, first_move_ = 0, behind_moves_ = 0, plastic_ = 0;
  std::string_view raw_;
  GcodeLine line_;
};

}  // namespace cleancolor
