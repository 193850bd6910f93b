// toolpath/roads.hpp
//
// Roads: how wide, how thick and how fast each kind of path of one extruder is printed in one layer.
//
// The cross-section of a road of width w and height h is a rectangle with half discs at both sides, of area
// h (w - h (1 - pi/4)); two roads side by side are (w - h (1 - pi/4)) apart, so that they fill the plane between them.
// A bridge hangs in the air and is a disc.
#pragma once

#include "model/config.hpp"
#include "slice/slices.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

struct Roads {
  Road external_perimeter, perimeter, overhang_perimeter, internal_infill, solid_infill, top_solid_infill,
      bridge_infill, gap_fill, skirt_brim, prime;
};

/// Cross-section, mm2, and distance of neighbours, mm.  Requires: width > height (1 - pi/4).
double road_area_mm2(double width_mm, double height_mm);
double road_spacing_mm(double width_mm, double height_mm);
double spacing_mm(const Road& road);

/// The same road at another width, as thin walls and gaps need it.
Road with_width(Road road, double width_mm);

/// Widths: the role's own option, else extrusion_width, else 1.125 x nozzle_diameter; in the first layer
/// first_layer_extrusion_width where given. Shares are of the layer height, as in PrusaSlicer.
Roads roads(const Config& config, int extruder, int layer_index, const Slab& slab);

}  // namespace cleancolor
