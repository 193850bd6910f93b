#include "plan/laid_walls.hpp"

#include <gtest/gtest.h>

#include "drawn_layer.hpp"
#include "plan/ooze_forecast.hpp"

namespace cleancolor {
namespace {

using namespace test;

TEST(LaidWalls, KnowWhichPathLaysAPlaceAndWhen) {
  const std::vector<Path> paths{drawn_path(0, {{1, 1}, {9, 1}}, false),
                                drawn_path(0, {{0, 0}, {10, 0}, {10, 10}, {0, 10}}, true, 0)};
  const LaidWalls walls(paths);
  EXPECT_EQ(walls.at({5, 1}).path, -1) << "a fill";
  EXPECT_EQ(walls.at({5, 5}).path, -1);
  EXPECT_EQ(walls.at({-50, 5}).path, -1);
  for (const double beside : {-0.15, 0., 0.15}) {
    EXPECT_EQ(walls.at({4, beside}).path, 1);
    EXPECT_NEAR(walls.at({4, beside}).at_s, 4 / drawn_road.speed_mm_s, 0.01);
    EXPECT_NEAR(walls.at({beside, 4}).at_s, 36 / drawn_road.speed_mm_s, 0.01);
  }
  EXPECT_EQ(LaidWalls(std::span(paths).first(1)).at({5, 1}).path, -1);
}

TEST(LaidWalls, KnowPlacesTenMetresApart) {
  std::vector<Path> paths;
  for (const double at : {-10000., 10000.})
    paths.push_back(drawn_path(0, {{at, at}, {at + 10, at}, {at + 10, at + 10}, {at, at + 10}}, true, 0));
  const LaidWalls walls(paths);
  EXPECT_EQ(walls.at({-9995, -10000}).path, 0);
  EXPECT_EQ(walls.at({10005, 10000}).path, 1);
  EXPECT_EQ(walls.at({0, 0}).path, -1);
}

/// A square of colour 0, and what nozzle 1, 10 mm to the right and by far full, leaves on it beside a path.
class Square : public testing::Test {
 protected:
  const DrawnLayer layer_{{rectangle({0, 0}, {20, 20}), rectangle({40, 0}, {41, 1})}};
  const LayerMap map_ = layer_.map();
  const OozeModel model_;
  std::vector<Path> paths_{drawn_path(0, {{0.2, 0.2}, {19.8, 0.2}, {19.8, 19.8}, {0.2, 19.8}}, true, 0)};

  double smear(const Path& path, int number, double weight, double from_s = 0) const {
    const LaidWalls walls(paths_);
    IdleState state{1, 0.5};
    return TouchTrack(path, {10, 0}, 1, map_, 0, {&walls, number, weight})
        .forwards(model_, from_s)
        .apply(state, model_);
  }
};

TEST_F(Square, WallsCountMoreOnceTheyAreLaid) {
  const Path fill = drawn_path(0, {{5, 10}, {12, 10}}, false);  // nozzle 1 goes over the right wall
  EXPECT_GT(smear(fill, 0, 0), 0.4);
  EXPECT_NEAR(smear(fill, 0, 1), smear(fill, 0, 0), 1e-9) << "the wall is printed after it";
  EXPECT_NEAR(smear(fill, 1, 1), 2 * smear(fill, 1, 0), 1e-9);
}

TEST_F(Square, OfThePathItselfOnlyWhatLiesBehindItCountsMore) {
  // Nozzle 1 comes over the right halves of the lower and of the upper edge while their left halves are printed.
  const Path& ring = paths_.front();
  const double edge_s = 19.6 / ring.road().speed_mm_s;
  const auto more = [&](double from_s) { return smear(ring, 0, 1, from_s) - smear(ring, 0, 0, from_s); };
  EXPECT_GT(more(0), 0.1) << "the right half of the upper edge is there before";
  EXPECT_NEAR(more(2.5 * edge_s), 0, 1e-9) << "begun in the middle of the upper edge neither is";
}

TEST_F(Square, BackwardsIsThePathReversed) {
  Path& wall = paths_.front();
  wall.closed = false;
  const auto more = [&](const Path& path, bool backwards) {
    const std::vector<Path> paths{path};
    const LaidWalls walls(paths);
    double smeared[2];
    for (const int weight : {0, 1}) {
      IdleState state{1, 0.5};
      const TouchTrack track(path, {10, 0}, 1, map_, 0, {&walls, 0, double(weight)});
      smeared[weight] = (backwards ? track.backwards(model_) : track.forwards(model_)).apply(state, model_);
    }
    return smeared[1] - smeared[0];
  };
  EXPECT_GT(more(wall, true), 0.01);
  EXPECT_NEAR(more(wall, true), more(reversed(wall), false), 0.02 * more(wall, true));
}

TEST_F(Square, AroundLoopsInsideTheWallIsStillToCome) {
  const Path inner = drawn_path(0, {{0.6, 0.6}, {19.4, 0.6}, {19.4, 19.4}, {0.6, 19.4}}, true, 1);
  const Path outer = paths_.front();
  Path joined = outer;
  joined.inner = {inner};
  const LaidWalls walls(paths_);
  IdleState apart{1, 0.5};
  double expected = TouchTrack(inner, {10, 0}, 1, map_, 0).forwards(model_).apply(apart, model_);
  expected += TouchTrack(outer, {10, 0}, 1, map_, 0, {&walls, 0, 1}).forwards(model_).apply(apart, model_);
  EXPECT_NEAR(smear(joined, 0, 1), expected, 1e-9);
}

}  // namespace
}  // namespace cleancolor
