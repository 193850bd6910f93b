// toolpath/link.hpp
//
// Link: infill lines joined into long paths along the border of their region.
//
// Each end of each line lies on the border. Two ends that follow each other on a ring of it can be joined by the arc
// between them; the joined lines are one path, printed without a stop. Fewer starts and stops leave fewer blobs, and
// the planner that comes later has fewer paths to visit.
#pragma once

#include <vector>

#include "base/polygon.hpp"

namespace cleancolor {

/// The border of a region, with the distance along each ring.
class Border {
 public:
  explicit Border(const std::vector<std::vector<Vec2>>& rings);

  struct Place {
    int ring = 0;
    double along_mm = 0;  // from the ring's first point, in [0, perimeter)
  };

  /// The place at which a point of edge `edge` (from point `edge` to the next) of the ring lies.
  Place place(int ring, std::size_t edge, Vec2 on_edge) const;

  double perimeter_mm(int ring) const { return along_[std::size_t(ring)].back(); }

  /// Corners passed on the way forwards (in the ring's direction) from a to b, both left out.
  std::vector<Vec2> between(int ring, double from_mm, double to_mm) const;

 private:
  const std::vector<std::vector<Vec2>>& rings_;
  std::vector<std::vector<double>> along_;  // along_[r][i]: to point i; one more for the whole perimeter
};

/// A line of infill; both ends lie on the border.
struct BorderLine {
  std::vector<Vec2> points;
  Border::Place first, last;
  int row = 0;  // neighbouring lines have neighbouring rows: joined in zigzag where possible
};

/// Lines joined where the arc between two neighbouring ends is at most max_link_mm long and no ring would close.
/// Zigzag from row to row first, then by increasing length of arc; of equals, by place.
std::vector<std::vector<Vec2>> linked(std::vector<BorderLine> lines, const Border& border, double max_link_mm);

}  // namespace cleancolor
