// No travel of the finished G-code crosses another colour where it can be seen and a fine grid finds a way without: in
// every eighth layer, or in all where CLEANCOLOR_ALL_LAYERS is set (a minute).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <span>

#include "model/placement.hpp"
#include "model/reach.hpp"
#include "model/settings.hpp"
#include "plan/cost.hpp"
#include "plan/free_way.hpp"
#include "protection.hpp"
#include "replay.hpp"
#include "sanitized.hpp"
#include "slicing.hpp"
#include "toolpath/roads.hpp"

namespace cleancolor {
namespace {

using namespace test;

constexpr double visible = 0.05;
constexpr double file_mm = 0.001;  // to which places are written

/// From the end of one road to the beginning of the next, where nothing is laid.
struct Hop {
  int layer = 0;  // of the road after it
  int tool = 0;
  std::vector<Vec2> carriage_mm;
};

std::vector<Hop> hops_of(const Printed& printed, const Config& config) {
  std::vector<Hop> hops;
  std::size_t t = 0;
  const auto offset = [&](int tool) { return config.extruders[std::size_t(tool)].nozzle_offset_mm; };
  for (std::size_t r = 0; r < printed.roads.size(); ++r) {
    const PrintedRoad& road = printed.roads[r];
    Hop hop{.layer = road.layer, .tool = road.tool, .carriage_mm = {}};
    if (r > 0) hop.carriage_mm.push_back(printed.roads[r - 1].to - offset(printed.roads[r - 1].tool));
    for (; t < printed.travels.size() && printed.travels[t].before_road == r; ++t)
      hop.carriage_mm.push_back(printed.travels[t].to - offset(printed.travels[t].tool));
    if (r > 0 && hop.carriage_mm.size() > 1) hops.push_back(std::move(hop));
  }
  return hops;
}

/// The layers of the model as they were printed, and what can be seen of them.
class Scene {
 public:
  Scene(const Model& model, const Config& config, double azimuth_deg)
      : config_(config),
        slices_(sliced_parts(model, config, azimuth_deg)),
        use_(slices_),
        rampart_(slices_, use_, config, 1) {
    std::vector<double> height_mm;
    for (const Slab& slab : slices_.slabs) height_mm.push_back(slab.height_mm);
    visibility_.emplace(slices_.outlines, height_mm, SurfaceVisibilityOptions{});
  }

  LayerMap map(int layer) const {
    const auto k = std::size_t(layer);
    const Polygons above = k + 1 < slices_.outlines.size() ? Polygons(slices_.outlines[k + 1]) : Polygons{};
    const double width_mm = roads(config_, use_.extruders.front(), layer, slices_.slabs[k]).external_perimeter.width_mm;
    std::vector<Path> walls = rampart_.paths(layer);
    std::erase_if(walls, [](const Path& path) { return path.road().role != Role::rampart; });
    return LayerMap({unpacked(slices_.regions[k]), slices_.outlines[k], above, slices_.slabs[k].print_z_mm, width_mm},
                    walls, *visibility_);
  }

  std::vector<TravelCost::Nozzle> nozzles(int layer) const {
    std::vector<TravelCost::Nozzle> result;
    for (const int e : use_.hot(layer, config_))
      result.push_back({e, config_.extruders[std::size_t(e)].nozzle_offset_mm, reach(config_, e)});
    return result;
  }

  double extent_mm(int layer) const {
    const Vec2 size = bounds_mm(slices_.outlines[std::size_t(layer)]).size();
    return std::max(size.x, size.y);
  }
  int layers() const { return int(slices_.slabs.size()); }

 private:
  static Slices sliced_parts(const Model& model, const Config& config, double azimuth_deg) {
    std::vector<Part> parts = placed_parts(model, config);
    if (azimuth_deg != 0) place(parts, config, {.rotate_deg = azimuth_deg});
    return slices(parts, {.extruders = int(config.extruders.size()),
                          .first_layer_height_mm = config.first_layer_height_mm,
                          .layer_height_mm = config.layer_height_mm,
                          .resolution_mm = config.resolution_mm,
                          .closing_radius_mm = config.slice_closing_radius_mm,
                          .xy_size_compensation_mm = config.xy_size_compensation_mm,
                          .elefant_foot_compensation_mm = config.elefant_foot_compensation_mm});
  }

  const Config& config_;
  Slices slices_;
  Use use_;
  PrintedRampart rampart_;
  std::optional<SurfaceVisibility> visibility_;
};

bool hangs_over(const TravelCost& cost, Vec2 p) {
  for (const double x : {-file_mm, 0., file_mm})
    for (const double y : {-file_mm, 0., file_mm})
      if (cost.is_barred(p + Vec2{x, y}, visible)) return true;
  return false;
}

struct Crossings {
  int all = 0;
  std::vector<std::string> avoidable;  // in words
};

/// Of one layer's hops.
Crossings crossings(std::span<const Hop> hops, const Scene& scene) {
  Crossings result;
  const int layer = hops.front().layer;
  const LayerMap map = scene.map(layer);
  const TravelCost cost(map, scene.nozzles(layer), TravelWeights{});
  for (const Hop& hop : hops) {
    const Vec2 from = hop.carriage_mm.front(), to = hop.carriage_mm.back();
    if (foreign_on(cost, hop.carriage_mm, file_mm) <= visible) continue;
    ++result.all;
    const auto nozzle = std::ranges::find(cost.nozzles(), hop.tool, &TravelCost::Nozzle::extruder);
    const FreeWay wanted{
        .longest_mm = 4 * scene.extent_mm(layer), .visible = visible, .nozzle = int(nozzle - cost.nozzles().begin())};
    // A nozzle that hangs over another colour where the hop begins or ends, give or take what the file rounds, cannot
    // help it; nor can a hop within one cell of the grid.
    if (hangs_over(cost, from) || hangs_over(cost, to)) continue;
    const std::vector<Vec2> free = free_way(cost, from, to, wanted);
    if (free.empty() || foreign_on(cost, free) > visible) continue;
    result.avoidable.push_back(fmt::format("layer {}, T{}: from X {:.3f} Y {:.3f} to X {:.3f} Y {:.3f} of the carriage",
                                           layer, hop.tool, from.x, from.y, to.x, to.y));
  }
  return result;
}

class TravelOfModel : public testing::TestWithParam<const char*> {};

TEST_P(TravelOfModel, CrossesVisibleForeignPlasticOnlyWhereAFineGridFindsNoWay) {
  if (!shared_models_are_there()) GTEST_SKIP() << "needs the models of " << CLEANCOLOR_SHARED;
  SKIP_LARGE_WHERE_SANITIZED(GetParam());
  const Model& model = model_named(GetParam());
  const TestFolder folder;
  SliceRequest request = request_for(model, config_of({.printer = "replicator-dual"}), folder.path("out.gcode"));
  request.azimuth_deg.reset();
  const Sliced result = sliced(request);
  const Scene scene(model, request.config, result.summary.protection.azimuth_deg);
  const std::vector<Hop> hops = hops_of(replayed(result.text, request.config), request.config);
  const int every = std::getenv("CLEANCOLOR_ALL_LAYERS") ? 1 : 8;
  int all_hops = 0, crossing = 0;
  for (std::size_t first = 0, last = 0; first < hops.size(); first = last) {
    while (last < hops.size() && hops[last].layer == hops[first].layer) ++last;
    if (hops[first].layer % every != 0) continue;
    const Crossings here = crossings(std::span(hops).subspan(first, last - first), scene);
    EXPECT_EQ(here.avoidable, std::vector<std::string>{});
    all_hops += int(last - first);
    crossing += here.all;
  }
  EXPECT_GT(all_hops, 100);
  RecordProperty("hops", all_hops);
  RecordProperty("crossing", crossing);
}

INSTANTIATE_TEST_SUITE_P(Paper, TravelOfModel,
                         testing::Values("4-cones", "crystal", "dragon-heart", "robot-ice", "rose", "spot-cow",
                                         "two-color-world-50mm"),
                         [](const auto& of) {
                           std::string name = of.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace cleancolor
