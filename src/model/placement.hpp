// model/placement.hpp
//
// Placement: where the parts stand on the bed.
#pragma once

#include <optional>
#include <span>

#include "base/progress.hpp"
#include "base/vec.hpp"
#include "model/config.hpp"
#include "model/mesh.hpp"

namespace cleancolor {

struct Placement {
  bool keep = false;              // --no-center: X and Y as in the file
  std::optional<Vec2> center_mm;  // --center: where the middle of the parts' common box goes
  double rotate_deg = 0;          // about +Z, counterclockwise seen from above, before centring
  double scale = 1;
};

/// Turns, scales and centres all parts together and drops them to the bed together, in place.
///
/// Centre: of the area that every needed nozzle reaches (extruder_printable_area within bed_shape), unless placement
/// says otherwise. Every part, grown by xy_size_compensation, must then lie within reach of its nozzle and below
/// max_print_height, else Error with the sizes and what to do.  Requires: every part has an extruder <
/// config.extruders.size().
void place(std::span<Part> parts, const Config& config, const Placement& placement, const Progress& progress = {});

}  // namespace cleancolor
