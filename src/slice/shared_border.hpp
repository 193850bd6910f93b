// slice/shared_border.hpp
//
// Shared borders: thinning out the contours of several colours so that neighbours still touch.
#pragma once

#include <vector>

#include "base/polygon.hpp"

namespace cleancolor {

/// The regions of one layer, each with as few points as keep within tolerance_mm of the dropped ones.
///
/// Where two regions run along the same points, the same points stay in both: rings are cut where a shared run begins
/// or ends, and each run is thinned out by itself, always from its lexicographically smaller end.  Cost: n log n.
std::vector<Polygons> simplified_together(const std::vector<Polygons>& regions, double tolerance_mm);

}  // namespace cleancolor
