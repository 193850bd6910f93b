#include "plan/refill.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "drawn_layer.hpp"

namespace cleancolor {
namespace {

using namespace test;

//   |  wall at x = 2          far away at x = 80: what was printed before
//   |   +-+
//   |   | |  a post of one loop at x = 5
//   |   +-+
struct Post {
  DrawnLayer drawn{{united(rectangle({5, 5}, {7, 7}), rectangle({80, 0}, {90, 10})), rectangle({120, 0}, {121, 1})}};
  std::vector<Path> paths{drawn_path(0, {{2, 0}, {2, 20}}, false, fill_depth, -1, Role::rampart),
                          drawn_path(0, {{82, 2}, {88, 2}}, false, fill_depth, 1),
                          drawn_path(0, {{5.2, 5.2}, {6.8, 5.2}, {6.8, 6.8}, {5.2, 6.8}}, true, 0, 2)};
  OozeModel model;
  RefillOptions options{.hole_mm = 24000 * 4, .hop = {.speed_mm_s = 100, .acceleration_mm_s2 = 1000}};

  std::vector<Path> refilled() const {
    const LayerMap map = drawn.map(std::span(paths).first(1));
    const TravelCost cost(map, {{0, {0, 0}, {}}, {1, {300, 0}, {}}}, {});
    return with_refills(paths, roadmap(paths, cost), cost, model, options);
  }
};

TEST(Refill, PushesWhatIsMissingBesideTheWallBeforeAPostFarAway) {
  const Post post;
  const std::vector<Path> paths = post.refilled();
  ASSERT_EQ(paths.size(), 4U);
  const Path& refill = paths[2];
  EXPECT_EQ(refill.road().role, Role::refill);
  for (const Vec2 p : refill.points) EXPECT_NEAR(p.x, 2, 1e-9);
  // All that came out on some 86 mm: with accelerations of 0.1 s and 0.04 s for drawing back.
  const double way_mm = travel_mm(paths[1].end(), refill);
  EXPECT_NEAR(volume_mm3(refill), 2 * (1 - post.model.left(way_mm / 100 + 0.1 + 0.04)), 1e-9);
  EXPECT_NEAR(way_mm, 86, 6);
  EXPECT_LE(refill.road().speed_mm_s, 120);
  EXPECT_LE(refill.road().area_mm2, 0.0601);
  EXPECT_LT(travel_mm(refill.end(), paths[3]), 8);
}

TEST(Refill, IsNotMadeWhereItBringsNothing) {
  Post no_wall;
  no_wall.paths.erase(no_wall.paths.begin());
  EXPECT_EQ(no_wall.refilled().size(), 2U);
  Post inner;
  inner.paths[2].depth = 1;
  EXPECT_EQ(inner.refilled().size(), 3U) << "what is missing in an inner loop nobody sees";
  Post near;
  near.paths[1].points = {{8, 5}, {8, 6}};
  EXPECT_EQ(near.refilled().size(), 3U) << "nothing is missing yet";
  Post other;
  other.paths[1].extruder = 1;
  EXPECT_EQ(other.refilled().size(), 3U) << "a nozzle begins with its own wall";
}

TEST(Refill, LosesNoPathAndKeepsTheirOrder) {
  const Post post;
  std::vector<Path> paths = post.refilled();
  std::erase_if(paths, [](const Path& p) { return p.road().role == Role::refill; });
  ASSERT_EQ(paths.size(), post.paths.size());
  for (std::size_t k = 0; k < paths.size(); ++k) EXPECT_EQ(paths[k].points, post.paths[k].points);
}

}  // namespace
}  // namespace cleancolor
