#include "plan/wipe.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "drawn_layer.hpp"
#include "plan/clear_way.hpp"
#include "plan/planner.hpp"
#include "sanitized.hpp"

namespace cleancolor {
namespace {

using namespace test;

// '|' a wall that stands, '0' a block printed by nozzle 0, '1' one printed by nozzle 1; nozzle 1 hangs 40 mm above
// nozzle 0. While line b is printed, it hovers over the block of nozzle 0; all that oozes out beside line a hangs on
// it.
//
//       y = 40     |   000000
//                  |
//       y = 0   aaaaaaa  bbbbb          11
//                                       11
struct Scene {
  DrawnLayer drawn{{rectangle({10, 38}, {20, 42}), rectangle({60, 0}, {64, 4})}};
  std::vector<Path> paths{drawn_path(0, {{5, 30}, {5, 50}}, false, fill_depth, -1, Role::rampart),
                          drawn_path(0, {{-40, 0}, {2, 0}}, false), drawn_path(0, {{9, 0}, {19, 0}}, false)};
  LayerMap map = drawn.map(std::span(paths).first(1));
  TravelCost cost{map, {{0, {0, 0}, {}}, {1, {0, 40}, {}}}, {}};
  OozeModel model;
  WipeOptions options{.hop = {.speed_mm_s = 100, .acceleration_mm_s2 = 1000}};

  /// The same line a, but nozzle 1 goes around the wall on the way to b.
  void go_around_the_wall() { paths[2].travel = {{2, -20}, {9, -20}}; }

  std::vector<Path> wiped() const { return with_wipes(paths, roadmap(paths, cost), cost, model, options); }
  LayerForecast forecast(const std::vector<Path>& of) const { return layer_forecast(of, cost, model, options.hop); }
};

/// Positions of the carriage on the way to path k.
std::vector<Vec2> way_to(const std::vector<Path>& paths, std::size_t k, const TravelCost& cost) {
  const auto offset = [&](const Path& path) {
    return std::ranges::find(cost.nozzles(), path.extruder, &TravelCost::Nozzle::extruder)->offset_mm;
  };
  std::vector<Vec2> way{paths[k - 1].end() - offset(paths[k - 1])};
  for (const Vec2 p : paths[k].travel) way.push_back(p - offset(paths[k]));
  way.push_back(paths[k].start() - offset(paths[k]));
  return way;
}

/// Whether everything but the ways is the same.
void expect_same_roads(const std::vector<Path>& a, const std::vector<Path>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].points, b[k].points);
    EXPECT_EQ(a[k].extruder, b[k].extruder);
    EXPECT_EQ(a[k].closed, b[k].closed);
  }
}

void expect_same_ways(const std::vector<Path>& a, const std::vector<Path>& b) {
  expect_same_roads(a, b);
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].travel, b[k].travel);
}

/// Mm of foreign plastic that can be seen, in steps, below any nozzle.
double foreign_mm(const TravelCost& cost, const std::vector<Vec2>& way) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const int steps = int(distance(way[i], way[i + 1]) / 0.02) + 1;
    for (int k = 0; k < steps; ++k)
      if (cost.crosses(lerp(way[i], way[i + 1], (k + 0.3) / steps), lerp(way[i], way[i + 1], (k + 0.3) / steps), 0.05))
        sum += distance(way[i], way[i + 1]) / steps;
  }
  return sum;
}

TEST(Wipe, CrossesAStandingWallBeforeAnIdleNozzleSmears) {
  Scene scene;
  scene.go_around_the_wall();
  const std::vector<Path> wiped = scene.wiped();
  expect_same_roads(wiped, scene.paths);
  EXPECT_NE(wiped[2].travel, scene.paths[2].travel);
  // The centre of nozzle 1 is on both sides of the wall's road, between its ends.
  const std::vector<Vec2> way = way_to(wiped, 2, scene.cost);
  double left = 1e9, right = -1e9;
  for (const Vec2 c : way) {
    const Vec2 p = c + Vec2{0, 40};
    if (p.y > 30 && p.y < 50) left = std::min(left, p.x - 5), right = std::max(right, p.x - 5);
  }
  EXPECT_LT(left, -0.3);
  EXPECT_GT(right, 0.3);
  EXPECT_LT(scene.forecast(wiped).smear_mm3, scene.forecast(scene.paths).smear_mm3 / 2);
}

TEST(Wipe, IsNotMadeWhereNothingWouldBeSmearedOrTheWayWipesAnyhow) {
  const Scene across;
  expect_same_ways(across.wiped(), across.paths);
  Scene elsewhere;
  elsewhere.go_around_the_wall();
  elsewhere.paths[2].points = {{9, -10}, {19, -10}};
  expect_same_ways(elsewhere.wiped(), elsewhere.paths);
}

TEST(Wipe, IsNotMadeWhereNoWallStands) {
  Scene none;
  none.go_around_the_wall();
  std::ranges::rotate(none.paths, none.paths.begin() + 1);
  none.paths.back().travel = {{-20, 20}};
  none.paths[1].travel = {{2, -20}, {9, -20}};
  const std::vector<Path> wiped = none.wiped();
  EXPECT_EQ(wiped[1].travel, none.paths[1].travel) << "the wall is printed afterwards";
  none.paths.pop_back();
  none.map = none.drawn.map();
  expect_same_ways(none.wiped(), none.paths);
}

TEST(Wipe, IsNotMadeWhereTimeCountsMore) {
  Scene dear;
  dear.go_around_the_wall();
  // The detour by the wall must be longer than the way as it is.
  dear.paths[2].travel.clear();
  dear.paths[1].points.back() = {6.5, 0};
  const LayerForecast before = dear.forecast(dear.paths);
  const std::vector<Path> wiped = dear.wiped();
  EXPECT_LT(dear.forecast(wiped).smear_mm3, before.smear_mm3);
  EXPECT_GT(dear.forecast(wiped).seconds, before.seconds);
  dear.options.s_mm3 = 1000;
  expect_same_ways(dear.wiped(), dear.paths);
}

// Nozzle 0 prints a, and must cross the wall of the box of nozzle 1 on the way to b inside; what comes out on the way
// is left on a standing wall just before.
//
//              |  1111111
//     aaa      |  1  b  1
//              |  1111111
TEST(Wipe, IsMadeJustBeforeACrossingThatMustBe) {
  const Polygons box = difference(rectangle({30, 0}, {50, 20}), rectangle({31, 1}, {49, 19}));
  const DrawnLayer drawn({rectangle({-40, 0}, {-30, 20}), box});
  const std::vector<Path> paths{drawn_path(0, {{27, 2}, {27, 13}}, false, fill_depth, -1, Role::rampart),
                                drawn_path(0, {{-39, 16}, {-31, 16}}, false),
                                drawn_path(0, {{40, 15}, {41, 15}}, false)};
  const LayerMap map = drawn.map(std::span(paths).first(1));
  const TravelCost cost(map, {{0, {0, 0}, {}}, {1, {300, 0}, {}}}, {});
  const HopTime hop{.speed_mm_s = 100, .acceleration_mm_s2 = 1000};
  const std::vector<Path> wiped = with_wipes(paths, roadmap(paths, cost), cost, {}, {.hop = hop});
  expect_same_roads(wiped, paths);
  EXPECT_LT(layer_forecast(wiped, cost, {}, hop).smear_mm3, layer_forecast(paths, cost, {}, hop).smear_mm3 / 3);
  EXPECT_NEAR(foreign_mm(cost, way_to(wiped, 2, cost)), foreign_mm(cost, way_to(paths, 2, cost)), 0.1);
}

TEST(Wipe, OfRandomLayersNeverSpoilsMoreNorCrossesMore) {
  std::mt19937 random(11);
  int changed = 0;
  for (int t = 0; t < trials(40); ++t) {
    SCOPED_TRACE(t);
    std::vector<Path> paths;
    const DrawnLayer drawn = random_drawn_layer(random, 10, 40, paths);
    const Box<Vec2> box = bounds_mm(drawn.outline);
    paths.insert(paths.begin(), drawn_path(0, to_mm(rectangle(box.min - Vec2{3, 3}, box.max + Vec2{3, 3}).front()),
                                           true, fill_depth, -1, Role::rampart));
    const LayerMap map = drawn.map(std::span(paths).first(1));
    const TravelCost cost(map, {{0, {0, 0}, {}}, {1, {33, 0}, {}}}, {});
    const Roadmap roads = roadmap(paths, cost);
    const WipeOptions options;
    const std::vector<Path> wiped = with_wipes(paths, roads, cost, {}, options);
    expect_same_roads(wiped, paths);
    expect_same_ways(wiped, with_wipes(paths, roads, cost, {}, options));
    for (std::size_t k = 1; k < paths.size(); ++k) {
      if (wiped[k].travel == paths[k].travel) continue;
      ++changed;
      const std::vector<Vec2> before = way_to(paths, k, cost), after = way_to(wiped, k, cost);
      EXPECT_LE(foreign_mm(cost, after), foreign_mm(cost, before) + 0.1);
      EXPECT_TRUE(!crosses(cost, after) || crosses(cost, before));
    }
    const LayerForecast before = layer_forecast(paths, cost, {}, options.hop);
    const LayerForecast after = layer_forecast(wiped, cost, {}, options.hop);
    const auto spoilt = [&](const LayerForecast& f) {
      return f.smear_mm3 + options.hole_weight * f.hole_mm3 + options.s_mm3 * f.seconds;
    };
    EXPECT_LE(spoilt(after), spoilt(before) + 0.01);
  }
  if (!sanitized) EXPECT_GT(changed, 8);
}

TEST(Wipe, IsPartOfThePlanUnlessSwitchedOff) {
  const Scene scene;
  Config config;
  config.extruders.resize(2);
  config.extruders[1].nozzle_offset_mm = {0, 40};
  double smear_mm3[2];
  for (const bool on : {false, true}) {
    config.wipe_passes = on;
    OrderState state;
    const PlannedLayer planned(
        {.index = 5, .print_z_mm = 45, .height_mm = 0.2, .paths = scene.paths, .fan_by_extruder = {}}, state, config,
        {.part = {scene.drawn.regions, scene.drawn.outline, scene.drawn.above, 45, 0.4},
         .site = {{0}, scene.drawn.outline},
         .hanging = {0, 1},
         .reach = {}},
        scene.drawn.visibility);
    EXPECT_EQ(planned.layer().paths.size(), scene.paths.size());
    smear_mm3[on] = planned.forecast().smear_mm3;
  }
  EXPECT_LE(smear_mm3[1], smear_mm3[0]);
}

}  // namespace
}  // namespace cleancolor
