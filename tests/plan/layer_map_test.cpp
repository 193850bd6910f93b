#include "plan/layer_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "drawn_layer.hpp"

namespace cleancolor {
namespace {

using namespace test;

//   0 mm        10 mm       20 mm
//   +-----------+-----------+
//   |  colour 0 | colour 1  |   10 mm deep; the layer above ends at x = 15
//   +-----------+-----------+
DrawnLayer two_halves() {
  DrawnLayer layer({rectangle({0, 0}, {10, 10}), rectangle({10, 0}, {20, 10})});
  layer.above = rectangle({0, 0}, {15, 10});
  return layer;
}

TEST(LayerMap, KnowsWhosePlasticLiesWhere) {
  const LayerMap map = two_halves().map();
  EXPECT_EQ(map.at({5, 5}).extruder, 0);
  EXPECT_EQ(map.at({12, 5}).extruder, 1);
  for (const Vec2 p : {Vec2{-0.2, 5}, Vec2{5, 10.2}, Vec2{500, 5}, Vec2{5, -500}})
    EXPECT_EQ(map.at(p).extruder, LayerMap::air) << p.x << ", " << p.y;
}

TEST(LayerMap, ShowsOuterWallsAndOpenTopsAndNothingElse) {
  const LayerMap map = two_halves().map();
  EXPECT_GT(map.at({0.2, 5}).visibility, 200) << "a wall";
  EXPECT_GT(map.at({12, 0.2}).visibility, 200);
  EXPECT_EQ(map.at({1, 5}).visibility, 0) << "behind the wall";
  EXPECT_EQ(map.at({9.9, 5}).visibility, 0) << "where both colours touch";
  EXPECT_EQ(map.at({10.1, 5}).visibility, 0);
  EXPECT_EQ(map.at({13, 5}).visibility, 0) << "below the next layer";
  const DrawnLayer open = two_halves();
  const std::vector<PackedPolygons> layers{open.outline, open.above};
  const SurfaceVisibility sky(layers, std::vector<double>{5., 5.});
  const LayerMap step({open.regions, open.outline, open.above, 5, 0.4}, {}, sky);
  EXPECT_GT(step.at({18, 5}).visibility, 100) << "no layer above";
}

TEST(LayerMap, KnowsTheWallsOfTheRampart) {
  const std::vector<Path> walls{drawn_path(0, {{-2, -2}, {22, -2}}, false, fill_depth, -1, Role::rampart),
                                drawn_path(1, {{22, -2}, {22, 12}}, false, fill_depth, -1, Role::rampart)};
  const LayerMap map = two_halves().map(walls);
  EXPECT_EQ(map.at({7.3, -2.05}).wall, 1);
  EXPECT_EQ(map.at({22.05, 7.7}).wall, 2);
  EXPECT_EQ(map.at({7.3, -1.5}).wall, 0);
  EXPECT_EQ(map.at({5, 5}).wall, 0);
}

TEST(LayerMap, OfNothingIsAir) {
  const DrawnLayer nothing({{}, {}});
  EXPECT_EQ(nothing.map().at({0, 0}).extruder, LayerMap::air);
}

TEST(LayerMap, ShowsWhatLiesInsideTranslucentPlastic) {
  const DrawnLayer layer = two_halves();
  const std::vector<PackedPolygons> outlines(60, layer.outline), opaque(60, layer.regions[1]);
  const SurfaceVisibility visibility(outlines, std::vector<double>(60, 1.), {.view = {}, .opaque = opaque});
  const std::vector<double> translucency_mm{2, 0};
  const LayerMap map({layer.regions, layer.outline, layer.above, 45, 0.4, translucency_mm}, {}, visibility);
  const double wall = map.at({0.2, 5}).visibility;
  for (const double d : {1., 2., 3.})
    EXPECT_NEAR(map.at({d, 5}).visibility, wall * std::exp(-d / 2), 0.25 * wall * std::exp(-d / 2) + 2) << d;
  EXPECT_EQ(map.at({15, 5}).visibility, 0) << "opaque";
  // Where both colours touch, 5 mm from the walls in front and behind.
  EXPECT_NEAR(map.at({9.9, 5}).visibility, wall * std::exp(-2.5), 5);
  // All opaque: as without.
  const LayerMap before = layer.map(), none({layer.regions, layer.outline, layer.above, 45, 0.4}, {}, visibility);
  for (double x = -1; x < 21; x += 0.1)
    for (double y = -1; y < 11; y += 0.1) EXPECT_EQ(none.at({x, y}).visibility, before.at({x, y}).visibility);
}

TEST(LayerMap, FindsEveryCellOnAWay) {
  std::mt19937 random(6);
  std::vector<Path> paths;
  const DrawnLayer layer = random_drawn_layer(random, 6, 20, paths);
  const LayerMap map = layer.map();
  std::uniform_real_distribution<double> any(-2, 25);
  const auto is_seen = [](LayerMap::Cell cell) { return cell.visibility > 128; };
  int found = 0;
  for (int t = 0; t < 3000; ++t) {
    Vec2 a{any(random), any(random)}, b{any(random) / 5 + a.x - 2, any(random) / 5 + a.y - 2};
    if (t % 3 == 0) b.x = a.x;
    if (t % 5 == 0) b.y = a.y;
    bool by_steps = false;
    for (int i = 0; i < 2000; ++i) by_steps = by_steps || is_seen(map.at(lerp(a, b, (i + 0.5) / 2000)));
    const bool along = map.any_along(a, b, is_seen);
    EXPECT_TRUE(along || !by_steps) << t;
    found += along - by_steps;
    EXPECT_EQ(along, map.any_along(b, a, is_seen)) << t;
  }
  EXPECT_LE(found, 3) << "corners that the steps leapt over";
}

}  // namespace
}  // namespace cleancolor
