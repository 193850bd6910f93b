#include "toolpath/medial.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "toolpath/regions.hpp"

namespace cleancolor {
namespace {

std::vector<Path> roads_through(const Polygons& region, double min = 0.1, double max = 0.8) {
  return medial_roads(region, plain_roads().external_perimeter, {min, max});
}

TEST(MedialRoads, FollowAStripFromEndToEnd) {
  const auto paths = roads_through(rectangle({0, 0}, {20, 0.6}));
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_NEAR(length_mm(paths[0]), 20 - 0.6, 0.1);  // the road's round ends reach the strip's ends
  for (const Vec2 p : paths[0].points) EXPECT_NEAR(p.y, 0.3, 0.01);
  for (const Stretch& s : paths[0].stretches) EXPECT_NEAR(s.road.width_mm, 0.6, 0.02);
}

TEST(MedialRoads, CloseAroundARing) {
  const auto circle = [](double r) {
    Ring ring;
    for (int i = 0; i < 180; ++i)
      ring.push_back(to_nm({r * std::cos(i * std::numbers::pi / 90), r * std::sin(i * std::numbers::pi / 90)}));
    return Polygons{ring};
  };
  const auto paths = roads_through(difference(circle(10.3), circle(9.7)));
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_TRUE(paths[0].closed);
  EXPECT_NEAR(length_mm(paths[0]), 2 * std::numbers::pi * 10, 0.5);
  for (const Vec2 p : paths[0].points) EXPECT_NEAR(length(p), 10, 0.03);
}

TEST(MedialRoads, WidenWithTheRegion) {
  Ring wedge = {to_nm({0, 0}), to_nm({20, -0.35}), to_nm({20, 0.35})};
  const auto paths = roads_through({wedge});
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_GT(paths[0].stretches.size(), 5u);
  for (std::size_t s = 0; s < paths[0].stretches.size(); ++s) {
    const Vec2 at = paths[0].points[paths[0].stretches[s].first_segment];
    EXPECT_NEAR(paths[0].stretches[s].road.width_mm, 0.7 * at.x / 20, 0.08);
  }
  EXPECT_NEAR(volume_mm3(paths[0]), 0.5 * 20 * 0.7 * 0.3, 0.6);
}

TEST(MedialRoads, MeetWhereStripsCross) {
  const auto paths = roads_through(united(rectangle({-10, -0.25}, {10, 0.25}), rectangle({-0.25, -10}, {0.25, 10})));
  EXPECT_GE(paths.size(), 2u);
  EXPECT_LE(paths.size(), 5u);
  EXPECT_NEAR(total_length_mm(paths), 40, 2.5);
}

TEST(MedialRoads, AreNoneWhereNothingIsNarrow) {
  EXPECT_TRUE(roads_through(rectangle({0, 0}, {10, 10})).empty());
  EXPECT_TRUE(roads_through(rectangle({0, 0}, {10, 0.05})).empty());
  EXPECT_TRUE(roads_through({}).empty());
}

}  // namespace
}  // namespace cleancolor
