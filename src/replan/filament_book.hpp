// replan/filament_book.hpp
//
// Filament book: what E stands at, and how much filament each tool has drawn back, line by line of a file.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "reader/line.hpp"
#include "reader/print.hpp"

namespace cleancolor {

inline constexpr std::int64_t filament_rounding_e5 = 200;  // of what is drawn back and pushed forward again

inline std::int64_t e5_of(double mm) {
  return std::llround(mm * 1e5);
}

/// In 1e-5 mm of filament.
class FilamentBook {
 public:
  FilamentBook(int tools, bool e_of_each_tool);

  /// Of G0, G1 and G92. relative: their E are lengths.
  void count(const GcodeLine& line, int tool, bool relative);
  void move(const GcodeMove& move);

  /// What a tool pushes forward before its first road, beyond what it has drawn back, it was taken to be drawn back by.
  /// from: the first move that is not in the book yet.
  void take_first_pushes(const GcodePrint& print, std::size_t from);

  /// The layers begin: what is drawn back now and never pushed forward is none of what they draw back.
  void begin_layers() { begin_back_ = back_; }
  /// Of a road: it begins with nothing drawn back. Returns: what was, all the same.
  std::int64_t begin_road(int tool);

  std::int64_t count_of(int tool) const { return count_[of_each_tool_ ? std::size_t(tool) : 0]; }
  std::int64_t back_of(int tool) const { return back_[std::size_t(tool)]; }
  const std::vector<std::int64_t>& counts() const { return count_; }
  const std::vector<std::int64_t>& back() const { return back_; }
  const std::vector<std::int64_t>& begin_back() const { return begin_back_; }

 private:
  bool of_each_tool_;
  std::vector<std::int64_t> count_, back_, begin_back_;
  std::array<bool, max_tools> has_laid_{};  // a road among the layers
};

}  // namespace cleancolor
