// plan/laid_walls.hpp
//
// Laid walls: which path lays the outer wall at a place, and when, so that what is there already can be told from what
// is still to come.
//
//   paths  ->  cells
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

class LaidWalls {
 public:
  struct Cell {
    std::int32_t path = -1;  // of those given; -1: no outer wall
    float at_s = 0;          // from the path's first point, without its inner loops and accelerations
  };

  LaidWalls() = default;
  /// Cost: about 0.1 ms for 1 m of outer walls.
  explicit LaidWalls(std::span<const Path> paths);

  Cell at(Vec2 p_mm) const {
    const int x = int((p_mm.x - origin_.x) * per_mm_), y = int((p_mm.y - origin_.y) * per_mm_);
    if (p_mm.x < origin_.x || p_mm.y < origin_.y || x >= columns_ || y >= rows_) return {};
    return cells_[std::size_t(y) * std::size_t(columns_) + std::size_t(x)];
  }

 private:
  void draw(const Path& path, int index);

  double per_mm_ = 5;  // cells; fewer where there would be millions
  Vec2 origin_;
  int columns_ = 0, rows_ = 0;
  std::vector<Cell> cells_;
};

/// What lies there when one of the paths is printed, as many as were given in the order in which they are printed.
struct LaidSoFar {
  const LaidWalls* walls = nullptr;
  int path = 0;       // that is printed
  double weight = 0;  // what is smeared on walls that are there already counts 1 + weight
};

}  // namespace cleancolor
