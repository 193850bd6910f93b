// replan/closed_runs.hpp
//
// Closed runs: roads that come back to where they began are a loop, whose seam may be anywhere on it.
#pragma once

namespace cleancolor {

/// Slicers leave a gap where a loop ends: at most 0.6 widths, and an eighth of the way around.
inline bool comes_back(double gap_mm, double length_mm, double width_mm) {
  return gap_mm <= 0.6 * width_mm && length_mm > 8 * gap_mm;
}

}  // namespace cleancolor
