// replan/storeys.hpp
//
// Storeys: the part as slabs that stand on one another, whatever heights the layers of a file have.
//
//   regions and heights of all layers  ->  a stack of slabs; of each layer, the storey that it is or hangs over
//
// Supports have layers of their own between those of the part, and objects on one bed may differ in their heights. A
// layer is a storey where it has something of the part, but for one that would be thinner than 0.09 mm beside another
// object's; of the others those that carry a wall up to where the part begins, above a raft. What another layer's roads
// fill of a storey's height belongs to it as well.
#pragma once

#include <cstddef>
#include <vector>

#include "slice/slices.hpp"

namespace cleancolor {

struct Storeys {
  Slices part;                        // slab on slab, from the bed up
  Slices around;                      // the same with all else but skirts: what a rampart stands around
  std::vector<std::size_t> of_layer;  // each layer is that storey, or hangs over it; the first, where it is below all
  std::vector<bool> is_storey;        // of each layer
};

/// Where all layers have the part, and each stands on the one before, the slices as they are.
/// part, around: of each layer, as high as its roads of the part; around needs only outlines.
Storeys storeys(Slices part, Slices around);

}  // namespace cleancolor
