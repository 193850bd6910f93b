#include "plan/planner.hpp"

#include "plan/tour.hpp"

namespace cleancolor {

void plan(Layer& layer, OrderState& state, const Config& config, const RampartSite& site, const LayerScene& scene,
          const SurfaceVisibility& visibility, const PlanOptions& options) {
  order(layer, state, config, site);
  if (layer.paths.empty()) return;
  const LayerMap map(scene, visibility);
  std::vector<TravelCost::Nozzle> nozzles;
  for (const int e : options.hanging) nozzles.push_back({e, config.extruders[std::size_t(e)].nozzle_offset_mm});
  const TravelCost cost(map, std::move(nozzles), {});
  const Roadmap roads = roadmap(layer.paths, cost);
  const std::vector<Visit> visits = tour(roads, layer.paths, cost, {.from_mm = options.from_mm});
  for (std::size_t k = 0; k < layer.paths.size(); ++k) {
    Path& path = layer.paths[k];
    path = begun(std::move(path), roads, k, visits[k].entry);
    // The carriage's places are where nozzle 0 is; the path's nozzle is beside it.
    path.travel.clear();
    for (const Vec2 c : visits[k].travel_mm)
      path.travel.push_back(c + config.extruders[std::size_t(path.extruder)].nozzle_offset_mm);
  }
}

}  // namespace cleancolor
