// toolpath/bed.hpp
//
// Bed: what is printed around the parts so that the first layer holds and every nozzle is primed: brim, skirt, prime
// lines.
#pragma once

#include <vector>

#include "base/progress.hpp"
#include "model/config.hpp"
#include "slice/slices.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

/// Paths of the bed for the first skirt_height_layers layers (at least one), in printing order.
///
/// Every extruder of `used` is primed in the first layer: it prints its own loops of the skirt, or, where there is no
/// skirt, a prime line at an edge of the bed that the part leaves free. The brim is printed by the lowest extruder of
/// the first layer. What would leave the reach of its nozzle is left out, with a warning. Requires: used ascending, not
/// empty; slices.slabs not empty.
std::vector<std::vector<Path>> bed_paths(const Slices& slices, const std::vector<int>& used, const Config& config,
                                         const Progress& progress = {});

}  // namespace cleancolor
