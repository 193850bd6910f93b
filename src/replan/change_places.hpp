// replan/change_places.hpp
//
// Change places: where tools change that leave the print while they idle (IDEX, tool changers, lifted nozzles).
//
//   layer with travel, regions  ->  the same; the old tool drives on until the new one would not hang over other
//   colours
//
// A new tool brings with it what oozed out while it was parked, and leaves it on the first plastic that it comes over.
// It is taken into use where the file says that the carriage is: without this, on what the old one just printed.
#pragma once

#include <vector>

#include "base/polygon.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

/// regions, below: of each extruder, where its plastic lies in the layer, and in the one below. before: the last path
/// of that; none: it is not known where the carriage comes from. Ways that lie over other colours as a whole stay as
/// they are. Cost: 1 us for each 0.25 mm of way until the change.
Layer with_change_places(Layer layer, const std::vector<Polygons>& regions, const std::vector<Polygons>& below,
                         const Path* before);

}  // namespace cleancolor
