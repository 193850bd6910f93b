// toolpath/medial.hpp
//
// Medial roads: single lines of varying width through regions too narrow for loops or infill.
#pragma once

#include "base/polygon.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

struct MedialOptions {
  double min_width_mm = 0.1;  // of the region, where a line is worth printing
  double max_width_mm = 0.8;  // from here on, loops or infill fit
  double extra_mm = 0;        // roads are this much wider than the region: for gaps, which end where roads touch
};

/// Lines along the medial axis of the narrow parts of a region.
///
/// Each line is an open or closed path of `road`, with stretches of the local width, and ends where the region ends.
/// Spurs into corners are left out. Lines shorter than the region is wide are dropped.
/// Cost: a Voronoi diagram of the region's edges, n log n.
std::vector<Path> medial_roads(const Polygons& region, const Road& road, const MedialOptions& options);

}  // namespace cleancolor
