// toolpath/fill.hpp
//
// Fill: a region covered with lines of one pattern, joined into long paths.
#pragma once

#include <vector>

#include "base/polygon.hpp"
#include "model/config.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

struct Fill {
  FillPattern pattern = FillPattern::rectilinear;
  double density = 1;       // share of the plane that plastic covers, in (0, 1]
  double angle_rad = 0;     // of rectilinear lines, counterclockwise from +X
  double z_mm = 0;          // gyroid changes with height
  double spacing_mm = 0.4;  // of roads side by side; 0 < spacing
  double max_link_mm = 50;  // longest arc along the border between two lines
};

/// Lines that cover the region.
///
/// Lines go 0.15 of their spacing over the place where their outer edge touches the border, to bond with what lies
/// beyond. At density 1 the lines of each island are spread evenly over its width; below, they lie at the same places
/// in every layer. grid takes half the density in each of two directions. Cost: region points x lines that each edge
/// crosses; gyroid and concentric one or more Clipper operations.
std::vector<Path> filled(const Polygons& region, const Fill& fill, const Road& road);

/// The angle of a rectilinear fill in a layer: fill_angle, turned by 90 degrees in every other layer.
double fill_angle_rad(const Config& config, int layer_index);

}  // namespace cleancolor
