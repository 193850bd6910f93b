// replan/closed_runs.hpp
//
// Closed runs: roads that come back to where they began are a loop, whose seam may be anywhere on it.
#pragma once

#include "toolpath/path.hpp"

namespace cleancolor {

/// Slicers leave a gap where a loop ends: at most 0.6 widths, and an eighth of the way around.
inline bool comes_back(double gap_mm, double length_mm, double width_mm) {
  return gap_mm <= 0.6 * width_mm && length_mm > 8 * gap_mm;
}

/// The path as a loop, if it is one.
inline Path closed_where_it_comes_back(Path path) {
  const double gap = distance(path.points.front(), path.points.back());
  if (path.closed || path.points.size() < 4 || !comes_back(gap, length_mm(path), path.road().width_mm)) return path;
  path.closed = true;
  if (gap == 0) path.points.pop_back();
  return path;
}

}  // namespace cleancolor
