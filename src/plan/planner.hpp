// plan/planner.hpp
//
// Planner: the order of a layer's paths, where each begins, and the carriage's way between them, so that no nozzle
// hangs over another colour where that can be helped.
//
//   paths of a layer, what lies where  ->  the same paths in order, begun at their starts, with Path::travel
//
// order (plan/plain_order.hpp), loops joined (joined_loops.hpp), the way through them on a roadmap of the layer
// (roadmap.hpp, tour.hpp), a cleaner order and its tour (cleaner_tour.hpp), hops found again that still cross another
// colour (clear_way.hpp), passes that wipe and fill nozzles (wipe.hpp, refill.hpp). Layers are planned on their own;
// the way from one to the next, and the start that suits it, are found when both are known. Takes regions and paths,
// and never asks where they come from.
//
// Source: Hergel and Lefebvre, Clean color, section 6.
#pragma once

#include <memory>
#include <vector>

#include "plan/layer_forecast.hpp"
#include "plan/layer_map.hpp"
#include "plan/plain_order.hpp"

namespace cleancolor {

/// What the planner must know of a layer beside its paths.
struct PlanScene {
  LayerScene part;
  RampartSite site;
  std::vector<int> hanging;         // extruders whose idle nozzles stay at print height, ascending
  std::span<const Polygons> reach;  // where each extruder's nozzle can go, convex; empty: anywhere
};

/// A planned layer, and what the way to it is found on.
class PlannedLayer {
 public:
  /// state: what the layer below handed on; its extruder and seams are used.
  /// Cost: 5 to 15 ms for a layer of 1 m of paths.
  PlannedLayer(Layer layer, OrderState& state, const Config& config, const PlanScene& scene,
               const SurfaceVisibility& visibility);
  ~PlannedLayer();
  PlannedLayer(PlannedLayer&&) noexcept;
  PlannedLayer& operator=(PlannedLayer&&) noexcept;

  const Layer& layer() const { return layer_; }

  /// The way to the first path from where the layer below ended; where that path can be begun anywhere, it and those
  /// after it are begun anew where the way and all that follows cost least (plan/tour.hpp).
  void arrive_from(const Layer& below);

  /// The places between of a way of that nozzle on which none hangs over another colour, if there is one; all where the
  /// nozzle's plastic would lie.  Requires: not released.
  std::vector<Vec2> way(int extruder, Vec2 from_mm, Vec2 to_mm) const;

  /// What the layer as planned is predicted to spoil, the way to its first path aside.  Requires: not released; idle
  /// nozzles stay at print height.
  LayerForecast forecast() const;

  /// The layer, and frees the rest.
  Layer release() &&;

 private:
  struct Run;
  std::size_t begin_at(std::uint32_t entry);  // how many paths are begun anew
  Vec2 offset_mm(const Path& path) const;
  /// before: the path that ends where the first begins; none: not known yet.
  std::vector<Path> planned(std::vector<Path> paths, const std::vector<int>& nozzles, const PlanScene& scene,
                            const Path* before);
  Vec2 stop_mm(const Path& path) const;  // of the carriage

  /// Joined loops and leads begin and end beside the places through which the tour was found, so that the ways there
  /// may graze another colour: these, and any other that crosses one, are found again.
  void find_clear_ways(std::span<Path> paths, const Run& run, const Path* before = nullptr) const;

  Layer layer_;
  const Config* config_;
  std::unique_ptr<LayerMap> map_;
  std::unique_ptr<Run> first_;  // the roadmap of the first run
};

}  // namespace cleancolor
