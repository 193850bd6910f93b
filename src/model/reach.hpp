// model/reach.hpp
//
// Reach: where on the bed a nozzle can print.
//
//   printer profile, extruder  ->  region, in model coordinates
//
// A nozzle reaches its extruder_printable_area within bed_shape; where it has no area of its own, all of bed_shape.
// Nozzles on one carriage are taken to reach the whole bed too: bed_shape says where parts can stand, and carriages
// travel further than that by the distance of their nozzles. A printer whose carriage does not says so with
// extruder_printable_area.
#pragma once

#include "base/polygon.hpp"
#include "model/config.hpp"

namespace cleancolor {

/// bed_shape as a region, in whichever direction it is drawn.
Polygons bed_region(const Config& config);

/// What the nozzle of an extruder reaches; empty where its area lies outside the bed.
/// Requires: 0 <= extruder < config.extruders.size().
Polygons reach(const Config& config, int extruder);

}  // namespace cleancolor
