// base/bit_grid.hpp
//
// Bit grids: cells as one long string of bits, 64 to a word, so that one instruction works on 64 cells.
//
// Cell (x, y, z) is bit x + row_bits * y + plane_bits * z. Going from a cell to its neighbour in any direction is a
// shift of the whole string. Rows and planes end in cells that stay empty, so that what is shifted beyond the end of a
// row meets nothing on the next.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.hpp"

namespace cleancolor {

using BitWords = std::vector<std::uint64_t>;

inline bool bit(std::span<const std::uint64_t> words, std::int64_t i) {
  return words[std::size_t(i >> 6)] >> (i & 63) & 1;
}

/// Sets or clears bits [first, last].
void fill_bits(std::span<std::uint64_t> words, std::int64_t first, std::int64_t last, bool value);

/// A straight road in units of cells: cell (x, y) is the square [x, x + 1] x [y, y + 1].
struct CellRoad {
  Vec2 a, b;
  double half_width = 0;
};

/// Cells [first, last] of row y; none where first > last.
struct CellSpan {
  int y = 0, first = 0, last = -1;
};

/// The cells of a road, row by row, appended to spans: those whose centre lies within half its width of its line, and
/// those that the line runs through, begun and ended half a width early and late.
///
/// So the outline stays where it is in the mean, and a wall of one line is closed however thin it is. Clipped to
/// columns x rows.  Requires: finite.  Cost: about 10 ns a row.
void cells_of_road(const CellRoad& road, int columns, int rows, std::vector<CellSpan>& spans);

/// Grows `reached` through cells that are not in `solid`, from neighbour to neighbour (4 in a plane, 2 across planes),
/// until nothing changes.
///
/// Requires: both as long; whole planes (a grid of one plane: plane_bits = 0); row_bits >= 1.
/// Cost: about 15 ns for 64 cells that are reached; at worst, in a maze, 32 times as much.
void flood(std::span<std::uint64_t> reached, std::span<const std::uint64_t> solid, std::int64_t row_bits,
           std::int64_t plane_bits);

/// The word w of the string whose bit i is bit i + shift of `words`; zeros beyond both ends.
inline std::uint64_t shifted_word(std::span<const std::uint64_t> words, std::int64_t w, std::int64_t shift) {
  const std::int64_t i = w + (shift >> 6);
  const int r = int(shift & 63);
  const auto at = [&](std::int64_t k) { return k >= 0 && k < std::int64_t(words.size()) ? words[std::size_t(k)] : 0; };
  return r == 0 ? at(i) : at(i) >> r | at(i + 1) << (64 - r);
}

}  // namespace cleancolor
