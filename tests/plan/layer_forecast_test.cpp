#include "plan/layer_forecast.hpp"

#include <gtest/gtest.h>

#include "drawn_layer.hpp"

namespace cleancolor {
namespace {

using namespace test;

// A line of colour 0, 10 mm below a block of it; nozzle 1 is 10 mm above the line.
struct Scene {
  DrawnLayer drawn{{rectangle({5, 10}, {10, 15}), rectangle({0, 0}, {1, 1})}};
  std::vector<Path> walls{drawn_path(0, {{3, 5}, {3, 20}}, false, fill_depth, -1, Role::rampart)};
  LayerMap map = drawn.map(walls);
  TravelCost cost{map, {{0, {0, 0}, {}}, {1, {0, 10}, {}}}, {}};
  OozeModel model;
  HopTime hop;

  LayerForecast of(const std::vector<Path>& paths) const { return layer_forecast(paths, cost, model, hop); }
};

TEST(LayerForecast, IsWhatOozesOutUntilTheFirstTouch) {
  const Scene scene;
  // 6 mm at 40 mm/s to the edge of the block, begun after as long a run before.
  const std::vector<Path> paths{drawn_path(0, {{-1, 2}, {8, 2}}, false)};
  const double run_s = 9 / 40.;
  const double carried = scene.model.volume_mm3 * scene.model.left(run_s) * (1 - scene.model.left(6 / 40.));
  EXPECT_NEAR(scene.of(paths).smear_mm3, carried, 0.01);
  EXPECT_NEAR(scene.of(paths).seconds, run_s, 1e-9);
}

TEST(LayerForecast, WallsWipeOnceTheyStand) {
  const Scene scene;
  const Path line = drawn_path(0, {{-1, 2}, {8, 2}}, false);
  const double unwiped = scene.of({line, scene.walls.front()}).smear_mm3;
  const double wiped = scene.of({scene.walls.front(), line}).smear_mm3;
  EXPECT_LT(wiped, unwiped);
  EXPECT_GT(wiped, 0) << "it oozes on from the wall to the block";
}

TEST(LayerForecast, CountsWhatIsMissingAfterTravelOnlyWhereAnOuterWallBegins) {
  const Scene scene;
  const Path far = drawn_path(0, {{-40, 2}, {-39, 2}}, false);
  Path wall = drawn_path(0, to_mm(rectangle({5.2, 10.2}, {9.8, 14.8}).front()), true, 0, 0, Role::external_perimeter);
  const double hop_s = scene.hop.seconds(distance(far.end(), wall.start()));
  const double missing = scene.model.volume_mm3 * (1 - scene.model.left(hop_s));
  EXPECT_NEAR(scene.of({far, wall}).hole_mm3, missing * visibility_ahead(wall, 0, wall.start(), scene.map), 1e-9);
  wall.depth = 1;
  EXPECT_EQ(scene.of({far, wall}).hole_mm3, 0);
}

TEST(TravelWeights, AreTheOptionsDefaults) {
  EXPECT_EQ(travel_weights(Config{}), TravelWeights{});
}

TEST(Touches, OfAJoinedLoopAreThoseOfBothLoopsOneAfterTheOther) {
  const Scene scene;
  Path outer = drawn_path(0, to_mm(rectangle({0, 0}, {12, 6}).front()), true, 0, 0, Role::external_perimeter);
  const Path inner = drawn_path(0, to_mm(rectangle({0.4, 0.4}, {11.6, 5.6}).front()), true, 1);
  for (const Vec2 offset : {Vec2{0, 10}, Vec2{0, -30}, Vec2{3, 9}}) {
    for (const std::uint64_t walls : {0U, 1U}) {
      outer.inner = {inner};
      const TouchTrack both(outer, offset, 1, scene.map, walls);
      outer.inner.clear();
      IdleState joined{0.9, 0.05}, apart = joined;
      const double smear = both.forwards(scene.model).apply(joined, scene.model);
      double expected = TouchTrack(inner, offset, 1, scene.map, walls).forwards(scene.model).apply(apart, scene.model);
      expected += TouchTrack(outer, offset, 1, scene.map, walls).forwards(scene.model).apply(apart, scene.model);
      EXPECT_NEAR(smear, expected, 1e-12);
      EXPECT_NEAR(joined.carried_mm3, apart.carried_mm3, 1e-12);
      EXPECT_NEAR(joined.left, apart.left, 1e-12);
    }
  }
}

}  // namespace
}  // namespace cleancolor
