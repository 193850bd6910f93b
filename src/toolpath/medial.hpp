// toolpath/medial.hpp
//
// Medial roads: single lines of varying width through regions too narrow for loops or infill.
#pragma once

#include "base/polygon.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

/// Lines along the medial axis of a region between min_width_mm and max_width_mm wide.
///
/// Each line is an open or closed path of `road`, with stretches of the local width, and ends where the region ends.
/// Spurs into corners are left out. Lines shorter than the region is wide are dropped.
/// Cost: a Voronoi diagram of the region's edges, n log n.
std::vector<Path> medial_roads(const Polygons& region, const Road& road, double min_width_mm, double max_width_mm);

}  // namespace cleancolor
