#include "replan/filament_book.hpp"

#include <algorithm>
#include <utility>

namespace cleancolor {
FilamentBook::FilamentBook(int tools, bool e_of_each_tool)
    : of_each_tool_(e_of_each_tool), count_(max_tools, 0), back_(std::size_t(std::max<int>(tools, max_tools)), 0) {}

void FilamentBook::count(const GcodeLine& line, int tool, bool relative) {
  const bool sets = line.letter == 'G' && line.number == 92;
  const bool moves = line.letter == 'G' && line.number <= 3;
  if (!sets && (!moves || relative)) return;
  const auto take = [&](char letter, std::size_t index) {
    if (line.has_value(letter)) count_[index] = e5_of(line[letter]);
  };
  take('E', of_each_tool_ ? std::size_t(tool) : 0);
  if (of_each_tool_) take('A', 0), take('B', 1);
}

void FilamentBook::move(const GcodeMove& move) {
  std::int64_t& back = back_[move.feeds];
  back = std::max<std::int64_t>(0, back - e5_of(move.filament_mm));
}

void FilamentBook::take_first_pushes(const GcodePrint& print, std::size_t from) {
  std::vector<char> has_printed(back_.size(), 0);
  std::vector<std::int64_t> back = back_;
  for (std::size_t i = from; i < print.moves.size(); ++i) {
    const GcodeMove& move = print.moves[i];
    if (has_printed[move.feeds] != 0) continue;
    if (lays_plastic(print, i)) {
      has_printed[move.feeds] = 1;
      back_[move.feeds] += std::max<std::int64_t>(0, -back[move.feeds]);
    } else {
      back[move.feeds] -= e5_of(move.filament_mm);
    }
  }
}

std::int64_t FilamentBook::begin_road(int tool) {
  const auto t = std::size_t(tool);
  if (!std::exchange(has_laid_[t], true)) {
    const std::int64_t left = std::min(back_[t], begin_back_[t]);
    begin_back_[t] -= left;
    back_[t] -= left;
  }
  return std::exchange(back_[t], 0);
}

}  // namespace cleancolor
