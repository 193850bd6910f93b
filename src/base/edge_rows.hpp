// base/edge_rows.hpp
//
// Edge rows: the edges of a region sorted into rows of Y, so that questions about a place look only at what is near.
#pragma once

#include <cstdint>
#include <vector>

#include "base/polygon.hpp"

namespace cleancolor {

class EdgeRows {
 public:
  struct Edge {
    Vec2 a, b;                // mm
    int ring = 0;             // of the region
    std::uint32_t index = 0;  // of a in its ring
  };

  explicit EdgeRows(const std::vector<std::vector<Vec2>>& rings);
  explicit EdgeRows(const Polygons& region);

  /// Shares of the way from a to b, ascending, in (0, 1), where the segment crosses an edge.
  void crossings(Vec2 a, Vec2 b, std::vector<double>& at) const;

  /// Whether p lies inside, by counting edges to its right.
  bool contains(Vec2 p) const;

  /// The edge nearest to p among those within within_mm above or below it; nullptr where there is none.
  const Edge* nearest(Vec2 p, double within_mm) const;

  /// The parts of an open line that lie inside, in order.
  std::vector<std::vector<Vec2>> clipped(const std::vector<Vec2>& line) const;

 private:
  int row(double y) const;
  void sort_into_rows();

  std::vector<Edge> edges_;
  double y0_ = 0;
  double height_mm_ = 1;              // of a row
  std::vector<std::uint32_t> first_;  // in_row_[first_[r] .. first_[r + 1]) touch row r
  std::vector<std::uint32_t> in_row_;
};

}  // namespace cleancolor
