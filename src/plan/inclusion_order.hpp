// plan/inclusion_order.hpp
//
// Inclusion order: the paths of a layer, of all colours together, from the inside out.
//
//   paths of a layer  ->  the same in the order of the inclusion tree
//
// Closed paths divide the layer into zones; the tree has a zone's loops as its children and a loop's inside as its
// zone. It is walked in post-order: first all that lies inside a loop, then the loop. So no nozzle has to go back into
// a region whose border is done.
//
//   +--A-----------------+
//   |  +--B----+  +-C-+  |    loops of a zone: longer ones first, where a lack of plastic shows less;
//   |  | +-D-+ |  +---+  |    then what fills the zone, together; then the loop around it:
//   |  | +---+ |  F  F   |
//   |  +-------+         |    D, B, C, F, F, A
//   +--------------------+
//
// Source: Hergel and Lefebvre, Clean color, section 6.3.
// Differs: the tree is found by containment of polygons instead of a flood fill. What fills a zone comes after the
// loops inside it, not by its length among them.
#pragma once

#include <span>
#include <vector>

#include "toolpath/path.hpp"

namespace cleancolor {

/// Indices of the paths in their order. Of equal loops in a zone the first given comes first. What fills a zone (fills,
/// and whatever is open) comes extruder by extruder, longer ones first.
/// Requires: closed paths do not cross.  Cost: one containment test for each pair of loops whose boxes lie in each
/// other.
std::vector<int> inclusion_order(std::span<const Path> paths);

}  // namespace cleancolor
