#include "replan/file_cursor.hpp"

#include <algorithm>

#include "replan/file_parts.hpp"

namespace cleancolor {

void FileCursor::read() {
  at_ = next_;
  const std::size_t stop = std::min(text_.find('\n', at_), text_.size());
  raw_ = text_.substr(at_, stop - at_);
  next_ = std::min(stop + 1, text_.size());
  first_move_ = behind_moves_;
  while (behind_moves_ < print_.moves.size() && print_.moves[behind_moves_].offset < next_) ++behind_moves_;
  if (const auto fault = parse_line(raw_, line_)) refuse(std::string(*fault));
}

std::optional<std::size_t> FileCursor::move() const {
  if (!moves()) return std::nullopt;
  if (first_move_ + 1 < behind_moves_) refuse("this line makes several moves");
  return first_move_;
}

std::size_t FileCursor::next_plastic() {
  plastic_ = std::max(plastic_, first_move_);
  while (plastic_ < print_.moves.size() && !lays_plastic(print_, plastic_)) ++plastic_;
  return plastic_;
}

void FileCursor::refuse(const std::string& what) const {
  refuse_line(print_, at_, what);
}

}  // namespace cleancolor
