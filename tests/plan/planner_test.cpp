#include "plan/planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "drawn_layer.hpp"
#include "plan/ooze_forecast.hpp"
#include "plan/precedence.hpp"

namespace cleancolor {
namespace {

using namespace test;

Config two_nozzles() {
  Config config;
  config.extruders.resize(2);
  config.extruders[1].nozzle_offset_mm = {14, 3};
  return config;
}

/// Rectangles of both colours with two loops and two fill lines each.
Layer random_layer(std::mt19937& random, DrawnLayer& drawn) {
  std::vector<Path> outer;
  drawn = random_drawn_layer(random, 9, 40, outer);
  Layer layer{.index = 3, .print_z_mm = 45, .height_mm = 1, .paths = {}, .fan_by_extruder = {}};
  for (const Path& path : outer) {
    Path inner = path;
    inner.depth = 1;
    inner.points = to_mm(offset({[&] {
                                  Ring ring;
                                  for (const Vec2 p : path.points) ring.push_back(to_nm(p));
                                  return ring;
                                }()},
                                -0.4)
                             .front());
    const Vec2 a = inner.points[0], b = inner.points[2];
    layer.paths.push_back(inner);
    layer.paths.push_back(path);
    layer.paths.push_back(drawn_path(path.extruder, {a, b}, false, fill_depth, path.island));
    layer.paths.push_back(drawn_path(path.extruder, {lerp(a, b, 0.4), b}, false, fill_depth, path.island));
  }
  return layer;
}

PlanScene scene_of(const DrawnLayer& drawn, std::vector<int> hanging) {
  return {.part = {drawn.regions, drawn.outline, drawn.above, 45, 0.4},
          .site = {{0, 1}, drawn.outline},
          .hanging = std::move(hanging),
          .reach = {}};
}

/// What a path lays, whichever way and from wherever it is walked.
std::tuple<int, int, int, long> laid(const Path& path) {
  return {path.extruder, path.island, path.depth, std::lround(1000 * length_mm(path))};
}

TEST(PlannedLayer, PrintsEveryPathOnceAndInnerOnesFirst) {
  std::mt19937 random(11);
  for (const bool same_height : {true, false})
    for (int t = 0; t < 6; ++t) {
      SCOPED_TRACE(t);
      DrawnLayer drawn({{}, {}});
      const Layer layer = random_layer(random, drawn);
      Config config = two_nozzles();
      config.join_perimeters = false;
      OrderState state;
      PlannedLayer planned(layer, state, config, scene_of(drawn, same_height ? std::vector{0, 1} : std::vector<int>{}),
                           drawn.visibility);
      const std::vector<Path>& paths = planned.layer().paths;
      std::vector<std::tuple<int, int, int, long>> before, after;
      for (const Path& p : layer.paths) before.push_back(laid(p));
      for (const Path& p : paths) after.push_back(laid(p));
      std::map<std::pair<int, int>, std::vector<int>> depths;  // of each island, in printing order
      for (const Path& p : paths) depths[{p.extruder, p.island}].push_back(p.depth);
      for (const auto& [island, order] : depths) {
        ASSERT_EQ(order.size(), 4U);
        EXPECT_EQ(order[0], 1);
        EXPECT_EQ(order[1], 0);
      }
      std::ranges::sort(before);
      std::ranges::sort(after);
      EXPECT_EQ(before, after);
      // One colour after the other.
      int changes = 0;
      for (std::size_t i = 1; i < paths.size(); ++i) changes += paths[i].extruder != paths[i - 1].extruder;
      EXPECT_LE(changes, 1);
    }
}

TEST(PlannedLayer, TravelsInTheFrameOfTheNozzleThatPrintsNext) {
  std::mt19937 random(12);
  DrawnLayer drawn({{}, {}});
  const Layer layer = random_layer(random, drawn);
  Config config = two_nozzles();
  config.join_perimeters = false;
  OrderState state;
  PlannedLayer planned(layer, state, config, scene_of(drawn, {0, 1}), drawn.visibility);
  Layer below = layer;
  below.paths = {drawn_path(0, {{-30, -30}, {-20, -30}}, false)};
  planned.arrive_from(below);
  const LayerMap map = drawn.map();
  const TravelCost cost(map, {{0, {0, 0}, {}}, {1, {14, 3}, {}}}, {});
  const auto offset = [&](int e) { return config.extruders[std::size_t(e)].nozzle_offset_mm; };
  Vec2 carriage = Vec2{-20, -30} - offset(0);
  double planned_cost = 0, straight_cost = 0;
  for (const Path& path : planned.layer().paths) {
    std::vector<Vec2> way{carriage};
    for (const Vec2 p : path.travel) way.push_back(p - offset(path.extruder));
    way.push_back(path.start() - offset(path.extruder));
    for (std::size_t i = 0; i + 1 < way.size(); ++i) planned_cost += cost.way(way[i], way[i + 1]);
    straight_cost += cost.way(way.front(), way.back());
    carriage = path.end() - offset(path.extruder);
  }
  EXPECT_LT(planned_cost, straight_cost / 2) << "in any other frame it would cost about as much";
}

TEST(PlannedLayer, BeginsWhereItSuitsTheLayerBelow) {
  // One colour, no rampart. Wherever the layer below ends: the same paths, and no worse than the start that was best
  // without it.
  std::mt19937 random(13);
  int moved = 0;
  double chosen_cost = 0, planned_cost = 0;
  for (int t = 0; t < 8; ++t) {
    SCOPED_TRACE(t);
    DrawnLayer both({{}, {}});
    Layer layer = random_layer(random, both);
    for (Path& path : layer.paths) path.extruder = 0;
    const DrawnLayer drawn({both.outline, {}});
    Config config;
    config.join_perimeters = false;
    const LayerMap map = drawn.map();
    const TravelCost cost(map, {{0, {0, 0}, {}}}, {});
    const auto cost_of = [&](Vec2 from, const Path& path) {
      double sum = cost.seam(path.start()) + cost.seam(path.end());
      if (begins_outer_wall(path))
        sum += cost.hole(visibility_ahead(path, 0, path.start(), map), travel_mm(from, path));
      for (const Vec2 p : path.travel) sum += cost.way(from, p), from = p;
      return sum + cost.way(from, path.start());
    };
    for (const Vec2 end : {Vec2{-5, -5}, {50, -5}, {50, 50}, {-5, 50}}) {
      OrderState state;
      PlannedLayer planned(layer, state, config, scene_of(drawn, {0}), drawn.visibility);
      const std::vector<Path> before = planned.layer().paths;
      Layer below = layer;
      below.paths = {drawn_path(0, {{0, 0}, end}, false)};
      planned.arrive_from(below);
      const std::vector<Path>& after = planned.layer().paths;
      ASSERT_EQ(after.size(), before.size());
      double mm3_before = 0, mm3_after = 0;
      for (std::size_t k = 0; k < after.size(); ++k) {
        EXPECT_EQ(after[k].island, before[k].island);
        mm3_before += volume_mm3(before[k]), mm3_after += volume_mm3(after[k]);
        planned_cost += cost_of(k > 0 ? before[k - 1].end() : end, before[k]);
        chosen_cost += cost_of(k > 0 ? after[k - 1].end() : end, after[k]);
      }
      EXPECT_NEAR(mm3_after, mm3_before, 0.02 * mm3_before);
      moved += after.front().start() != before.front().start();
    }
  }
  EXPECT_GT(moved, 5);
  EXPECT_LT(chosen_cost, planned_cost);
}

// Whether a wall that is still to come takes what hangs over its place is not sure; one that stands does.
TEST(PlannedLayer, BeginsWallsSoThatIdleNozzlesComeOverWhatIsStillToCome) {
  // Nozzle 1 comes over the right half of the ring while the left half is printed.
  const DrawnLayer drawn({rectangle({0, 0}, {20, 20}), {}});
  Config config = two_nozzles();
  config.extruders[1].nozzle_offset_mm = {10, 0};
  config.join_perimeters = false;
  Layer layer{.index = 3, .print_z_mm = 45, .height_mm = 1, .paths = {}, .fan_by_extruder = {}};
  layer.paths = {drawn_path(0, {{-4, 21}, {4, 21}}, false, fill_depth, -1, Role::skirt_brim),
                 drawn_path(0, {{0.2, 0.2}, {19.8, 0.2}, {19.8, 19.8}, {0.2, 19.8}}, true, 0)};
  OrderState state;
  const std::vector<Path> paths =
      PlannedLayer(layer, state, config, scene_of(drawn, {0, 1}), drawn.visibility).layer().paths;
  ASSERT_EQ(paths.size(), 2U);
  const LayerMap map = drawn.map();
  const LaidWalls walls(paths);
  double smeared[2];
  for (const int weight : {0, 1}) {
    IdleState full{1, 0.5};
    const TouchTrack track(paths[1], {10, 0}, 1, map, 0, {&walls, 1, double(weight)});
    smeared[weight] = track.forwards({}).apply(full, {});
  }
  EXPECT_GT(smeared[0], 0.5);
  EXPECT_LT(smeared[1] - smeared[0], 0.02) << "of it on what stands";
}

TEST(PlannedLayer, OfNothingIsNothing) {
  const DrawnLayer drawn({{}, {}});
  const Config config = two_nozzles();
  OrderState state;
  PlannedLayer planned({}, state, config, scene_of(drawn, {0, 1}), drawn.visibility);
  planned.arrive_from({});
  EXPECT_TRUE(std::move(planned).release().paths.empty());
}

}  // namespace
}  // namespace cleancolor
