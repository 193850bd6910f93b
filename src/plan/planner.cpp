#include "plan/planner.hpp"

#include <array>
#include <functional>
#include <span>

#include "plan/tour.hpp"
#include "shield/start.hpp"

namespace cleancolor {

/// Paths that are planned together.
struct PlannedLayer::Run {
  TravelCost cost;
  Roadmap roads;
  std::uint32_t first_node = 0;
};

namespace {

constexpr double exposure_weight = 50;  // mm of way that a mm of an unwiped nozzle over the part is worth

/// Open walls are walked from the end from which idle nozzles are wiped first.
std::function<double(std::size_t, std::uint32_t)> wall_cost(std::span<const Path> paths, const TravelCost& cost,
                                                            const Polygons& part) {
  std::vector<std::array<double, 2>> of_path(paths.size());
  WallScene scene{.idle_mm = {}, .part = part, .standing = {}};
  for (std::size_t k = 0; k < paths.size(); ++k) {
    if (paths[k].road().role != Role::rampart) continue;
    if (!paths[k].closed) {
      Vec2 own;
      for (const auto& n : cost.nozzles())
        if (n.extruder == paths[k].extruder) own = n.offset_mm;
      scene.idle_mm.clear();
      for (const auto& n : cost.nozzles())
        if (n.extruder != paths[k].extruder) scene.idle_mm.push_back(n.offset_mm - own);
      for (const bool backwards : {false, true})
        of_path[k][backwards] = exposure_weight * exposure_mm(paths[k], scene, backwards);
    }
    scene.standing.push_back(paths[k]);
  }
  return [of_path](std::size_t path, std::uint32_t entry) { return entry < 2 ? of_path[path][entry] : 0; };
}

}  // namespace

PlannedLayer::PlannedLayer(Layer layer, OrderState& state, const Config& config, const PlanScene& scene,
                           const SurfaceVisibility& visibility)
    : layer_(std::move(layer)), config_(&config) {
  order(layer_, state, config, scene.site);
  if (layer_.paths.empty()) return;
  map_ = std::make_unique<LayerMap>(scene.part, visibility);
  // Nozzles that leave the print while they idle are planned for one after the other.
  const std::vector<Path>& paths = layer_.paths;
  for (std::size_t first = 0, last = 0; first < paths.size(); first = last) {
    std::vector<int> nozzles = scene.hanging;
    if (nozzles.empty()) {
      while (last < paths.size() && paths[last].extruder == paths[first].extruder) ++last;
      nozzles = {paths[first].extruder};
    } else {
      last = paths.size();
    }
    plan_run(first, last, std::move(nozzles), scene);
  }
}

PlannedLayer::~PlannedLayer() = default;
PlannedLayer::PlannedLayer(PlannedLayer&&) noexcept = default;
PlannedLayer& PlannedLayer::operator=(PlannedLayer&&) noexcept = default;

void PlannedLayer::plan_run(std::size_t first, std::size_t last, std::vector<int> nozzles, const PlanScene& scene) {
  std::vector<TravelCost::Nozzle> hanging;
  for (const int e : nozzles) {
    Polygons reach = e < int(scene.reach.size()) ? scene.reach[std::size_t(e)] : Polygons{};
    hanging.push_back({e, config_->extruders[std::size_t(e)].nozzle_offset_mm, std::move(reach)});
  }
  const std::span<Path> paths = std::span(layer_.paths).subspan(first, last - first);
  Run run{.cost = TravelCost(*map_, std::move(hanging), {}), .roads = {}};
  run.roads = roadmap(paths, run.cost, {.fixed_seams = config_->seam_position != SeamPosition::hidden});
  const std::vector<Visit> visits =
      tour(run.roads, paths, run.cost, {.entry_cost = wall_cost(paths, run.cost, scene.site.part)});
  run.first_node = run.roads.entries[0][visits[0].entry].node;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    paths[k] = begun(std::move(paths[k]), run.roads, k, visits[k].entry);
    // The carriage is where nozzle 0 is; the path's own nozzle is beside it.
    paths[k].travel.clear();
    for (const Vec2 c : visits[k].travel_mm)
      paths[k].travel.push_back(c + config_->extruders[std::size_t(paths[k].extruder)].nozzle_offset_mm);
  }
  if (first == 0) first_ = std::make_unique<Run>(std::move(run));
}

void PlannedLayer::arrive_from(const Layer& below) {
  if (!first_ || below.paths.empty()) return;
  const auto offset = [&](const Path& path) { return config_->extruders[std::size_t(path.extruder)].nozzle_offset_mm; };
  Path& path = layer_.paths.front();
  const Vec2 from = below.paths.back().end() - offset(below.paths.back());
  path.travel = way_in(first_->roads, first_->cost, path.extruder, from, first_->first_node);
  for (Vec2& p : path.travel) p = p + offset(path);
}

Layer PlannedLayer::release() && {
  map_.reset();
  first_.reset();
  return std::move(layer_);
}

}  // namespace cleancolor
