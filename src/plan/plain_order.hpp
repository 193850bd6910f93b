// plan/plain_order.hpp
//
// Plain order: what slicers do without colour protection. The nearest path next, straight travel.
//
// A layer begins with the extruder that ended the layer below, so that there is about one tool change a layer; the
// first one with the extruders that are only primed in it. Each extruder prints island by island: perimeters from the
// inside out (or as Path::depth and external_first say), ring by ring (all loops of a hole, then those of the outline),
// then fills; ironing last. It is the baseline that the planner of clean colour is measured against.
//
// print_order = paper, and planner = paper: from the inside out across colours instead (plan/inclusion_order.hpp), with
// as many tool changes as that takes; external_perimeters_first does not count then.
#pragma once

#include "base/polygon.hpp"
#include "model/config.hpp"
#include "plan/seam.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

/// What a layer hands on to the next.
struct OrderState {
  int extruder = 0;  // that printed last
  Vec2 at;           // where it ended
  SeamMemory seams;
};

/// What the walls of a rampart must know of a layer.
struct RampartSite {
  std::vector<int> extruders;  // whose nozzles are still needed
  Polygons part;               // all plastic of the part
};

/// Whether the layer's paths are printed in the paper's order.
inline bool prints_by_inclusion(const Config& config) {
  return config.planner == Planner::paper || config.print_order == PrintOrder::paper;
}

/// The layer's paths in printing order: closed ones begun at their seam, open ones turned round where that is nearer.
/// Paths of no island (Path::island == -1) come first for each extruder, in the order given; walls of the rampart
/// (Role::rampart) by rampart_order, begun where idle nozzles are wiped first (shield/start.hpp).
/// Cost: quadratic in the number of paths of an island and of islands.
void order(Layer& layer, OrderState& state, const Config& config, const RampartSite& site = {});

/// The extruder that begins each layer when each begins with the one that ended the layer below, if it prints there.
/// printing: the extruders that print in each layer, ascending; first: that begins the print.
std::vector<int> first_extruders(const std::vector<std::vector<int>>& printing, int first);

}  // namespace cleancolor
