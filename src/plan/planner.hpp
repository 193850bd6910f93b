// plan/planner.hpp
//
// Planner: the order of a layer's paths, where each begins, and the carriage's way between them, so that no nozzle
// hangs over another colour where that can be helped.
//
//   paths of a layer, what lies where  ->  the same paths in order, begun at their starts, with Path::travel
//
// order (plan/plain_order.hpp), then the way through it on a roadmap of the layer (roadmap.hpp, tour.hpp).
// Takes regions and paths, and never asks where they come from.
// Source: Hergel and Lefebvre, Clean color, section 6.
#pragma once

#include <optional>
#include <vector>

#include "plan/layer_map.hpp"
#include "plan/plain_order.hpp"

namespace cleancolor {

/// What hangs over the layer, and what is known of the way before it.
struct PlanOptions {
  std::vector<int> hanging;     // extruders whose nozzles are at print height, ascending
  std::optional<Vec2> from_mm;  // where the carriage is; nothing: not known
};

/// Plans one layer. state: what the layer below handed on; only its extruder and seams are used.
/// Cost: 5 to 15 ms for a layer of 1 m of paths.
void plan(Layer& layer, OrderState& state, const Config& config, const RampartSite& site, const LayerScene& scene,
          const SurfaceVisibility& visibility, const PlanOptions& options);

}  // namespace cleancolor
