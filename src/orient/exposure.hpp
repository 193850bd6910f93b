// orient/exposure.hpp
//
// Exposure: how long idle nozzles hover over visible plastic of another colour, each place as visible as it is.
//
//   outlines  ->  cells of each colour; which of them are visible, and for how long a nozzle prints over each
//   E(d) = sum over visible places q, printing i, idle j of another colour than q:
//          visibility(q) x area x seconds that i spends at q - d
//
// Visible is a cell of the part beside the outside of its layer, or with nothing above. Its visibility is the share of
// the open half sphere that reaches the outside within 25 mm; the bed is opaque. Flat walls come out
// some 10 % too dark, as rays along them hit their cells.
#pragma once

#include <cstdint>
#include <vector>

#include "orient/azimuth.hpp"

namespace cleancolor {

class ExposureMap {
 public:
  /// Cells of 0.5 mm in X and Y and 1 mm in Z, larger where there would be more than 20 million.
  /// Cost: some 0.1 ms for each visible cm2 of a level; memory: 2 bytes a cell.
  ExposureMap(const Slices& slices, const std::vector<Pace>& pace, int threads);

  /// Visibility x seconds, while nozzle `printing` works and nozzle `idle` is d_mm beside it.
  /// Cost: about 10 ns for each visible place.
  double seconds(int printing, int idle, Vec2 d_mm) const;

 private:
  struct Place {
    std::int32_t x = 0, y = 0, level = 0;  // cell
    std::uint8_t colour = 0;
    float weight_mm2 = 0;  // visibility x area x layers
  };

  void fill(const Slices& slices, int threads);
  void mark_shells(const std::vector<Pace>& pace, int threads);
  void find_places(int threads);
  float visibility(int x, int y, int level) const;
  std::uint8_t at(int x, int y, int level) const {
    if (x < 0 || y < 0 || level < 0 || x >= columns_ || y >= rows_ || level >= levels_) return none;
    return cells_[(std::size_t(level) * std::size_t(rows_) + std::size_t(y)) * std::size_t(columns_) + std::size_t(x)];
  }

  static constexpr std::uint8_t none = 0x7F, shell = 0x80;  // a cell: its extruder, and whether perimeters lie there
  Box<Vec2> box_;
  double cell_mm_ = 0.5, level_mm_ = 1, layers_per_level_ = 1;
  int columns_ = 0, rows_ = 0, levels_ = 0;
  std::vector<std::uint8_t> cells_;
  std::vector<Place> places_;
  std::vector<Pace> pace_;
};

}  // namespace cleancolor
