// plan/layer_map.hpp
//
// Layer map: what lies where in one layer, and how plainly it can be seen.
//
//   regions and outline of the layer, outline above, visibility  ->  cells
//
// Visible is what a nozzle can spoil for the eye: the outer walls, as wide as their road, what no layer covers, and
// below both what translucent plastic lets through.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/polygon.hpp"
#include "toolpath/path.hpp"
#include "visibility/visibility.hpp"

namespace cleancolor {

/// One layer of the part.
struct LayerScene {
  std::vector<Polygons> regions;                 // of each extruder
  Polygons outline;                              // of all
  Polygons above;                                // the outline of the layer above; empty for the last
  double z_mm = 0;                               // its top
  double wall_width_mm = 0.4;                    // of the outermost road
  std::span<const double> translucency_mm = {};  // of each extruder's plastic, 0: opaque; empty: all opaque
};

class LayerMap {
 public:
  static constexpr std::uint8_t air = 0xFF;
  struct Cell {
    std::uint8_t extruder = air;
    std::uint8_t visibility = 0;  // x 255; 0: hidden
    std::uint8_t wall = 0;        // of the rampart: its index + 1; 0: none
  };

  /// Cells of cell_mm, larger where there would be more than 4 million.
  /// Cost: about 1 ms for 100 000 cells.
  LayerMap(const LayerScene& scene, std::span<const Path> walls, const SurfaceVisibility& visibility,
           double cell_mm = 0.125);

  Cell at(Vec2 p_mm) const {
    const int x = int((p_mm.x - origin_.x) * per_mm_), y = int((p_mm.y - origin_.y) * per_mm_);
    if (p_mm.x < origin_.x || p_mm.y < origin_.y || x >= columns_ || y >= rows_) return {};
    return cells_[std::size_t(y) * std::size_t(columns_) + std::size_t(x)];
  }

  /// Whether the visitor says so of any cell that the straight way from a to b passes.
  template <class Visit>
  bool any_along(Vec2 a, Vec2 b, Visit visit) const {
    // Shares of the way from border to border, in X and in Y.
    const auto step = [&](double d) { return d != 0 ? 1 / (std::abs(d) * per_mm_) : INFINITY; };
    const auto first = [&](double at, double d) {
      const double u = at * per_mm_;
      return d > 0 ? (std::floor(u) + 1 - u) * step(d) : d < 0 ? (u - std::ceil(u) + 1) * step(d) : INFINITY;
    };
    const Vec2 way = b - a, from = a - origin_;
    Vec2 next{first(from.x, way.x), first(from.y, way.y)};
    for (double t = 0;;) {
      const double end = std::min({1., next.x, next.y});
      if (visit(at(lerp(a, b, (t + end) / 2)))) return true;
      if (end >= 1) return false;
      (next.x <= next.y ? next.x : next.y) += step(next.x <= next.y ? way.x : way.y);
      t = end;
    }
  }

  double cell_mm() const { return 1 / per_mm_; }
  const Box<Vec2>& box_mm() const { return box_; }

 private:
  void draw(const Path& wall, std::uint8_t index);
  void see(const LayerScene& scene, const SurfaceVisibility& visibility, const std::vector<char>& covered);

  Box<Vec2> box_;
  Vec2 origin_;
  double per_mm_ = 8;
  int columns_ = 0, rows_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace cleancolor
