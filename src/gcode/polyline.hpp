// gcode/polyline.hpp
//
// Polyline: a path as it is driven: simplified, and with the gap at the seam of a closed one.
#pragma once

#include <vector>

#include "toolpath/path.hpp"

namespace cleancolor {

struct Polyline {
  std::vector<Vec2> points;        // open: a closed path comes back to where it began, or to just before
  std::vector<Stretch> stretches;  // of its segments
};

/// Fills line (its memory is reused) with the path's points, as few as keep within tolerance_mm of the others, and
/// gap_mm cut off the end of a closed path, but at most a quarter of its length. Where a stretch begins the point
/// stays. Method: simplified() of base/polygon.hpp.  Cost: about n log n.
void lay_out(const Path& path, double tolerance_mm, double gap_mm, Polyline& line);

}  // namespace cleancolor
