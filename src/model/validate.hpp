// model/validate.hpp
//
// What concerns more than one option: do they go together?
#pragma once

#include "model/config.hpp"

namespace cleancolor {

/// Throws Error with the names and values of the first options that do not go together.
///
/// After it: 1 to max_extruders extruders; bed_shape and every extruder_printable_area are polygons with area within
/// +-1000 mm; nozzle 0 is at 0,0, and nozzles that hover together are not at one place; layers are no higher than any
/// nozzle is wide; every extrusion width is above the layer height and at most 4 nozzle diameters; colours are #RRGGBB;
/// thumbnails are sizes, view_direction is one.  Ranges of single options: model/options.hpp checks them when they are
/// set.
void validate(const Config& config);

}  // namespace cleancolor
