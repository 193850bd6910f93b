#include "replan/leads.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace cleancolor {
namespace {

Path ring_wall(double half_mm, bool counterclockwise = true) {
  Path path;
  path.island = 0;
  path.depth = 0;
  path.closed = true;
  path.source = 0;
  path.points = {{-half_mm, -half_mm}, {half_mm, -half_mm}, {half_mm, half_mm}, {-half_mm, half_mm}, {-half_mm, 0}};
  if (!counterclockwise) std::ranges::reverse(path.points);
  path.stretches = {{0, {Role::external_perimeter, 0.4, 0.3, 0.12, 30}}};
  return path;
}

Path far_fill() {
  Path path;
  path.island = 0;
  path.points = {{29, 0}, {30, 0}};
  path.stretches = {{0, {Role::internal_infill, 0.4, 0.3, 0.12, 60}}};
  return path;
}

Polygons square(double half_mm) {
  return {
      {to_nm({-half_mm, -half_mm}), to_nm({half_mm, -half_mm}), to_nm({half_mm, half_mm}), to_nm({-half_mm, half_mm})}};
}

const LeadOptions plain_hops{.ooze = {}, .hop = {HopTime{}}};

Layer layer_of(std::vector<Path> paths) {
  Layer layer;
  layer.paths = std::move(paths);
  return layer;
}

TEST(Leads, ASingleWallIsComeToFromInsideWithWhatIsMissing) {
  for (const bool counterclockwise : {true, false}) {
    const Path fill = far_fill(), wall = started_at(ring_wall(5, counterclockwise), counterclockwise ? 4 : 0);
    const Layer led = with_leads(layer_of({wall}), {square(5.2)}, &fill, plain_hops);
    ASSERT_EQ(led.paths.size(), 2u);
    const Path& lead = led.paths.front();
    EXPECT_EQ(lead.road().role, Role::refill);
    EXPECT_EQ(lead.island, wall.island);
    EXPECT_EQ(lead.end(), wall.start());
    EXPECT_NEAR(lead.start().x, -5 + 0.75 * 0.4, 1e-6);
    EXPECT_NEAR(lead.start().y, wall.start().y, 1e-6);
    EXPECT_EQ(led.paths.back().points, wall.points);
    const double missing_mm3 = 2 * (1 - OozeModel{}.left(HopTime{}.seconds(distance(fill.end(), wall.start()))));
    EXPECT_NEAR(volume_mm3(lead), std::min(missing_mm3, 0.3 * 0.12), 1e-6);
  }
}

TEST(Leads, TakeTheWayThatWasPlannedToTheWall) {
  const Path fill = far_fill();
  Path wall = started_at(ring_wall(5), 4);
  wall.travel = {{20, 20}, {-20, 20}};
  const Layer led = with_leads(layer_of({wall}), {square(5.2)}, &fill, plain_hops);
  ASSERT_EQ(led.paths.size(), 2u);
  EXPECT_EQ(led.paths.front().travel, wall.travel);
  EXPECT_TRUE(led.paths.back().travel.empty());
}

TEST(Leads, AHoleIsComeToFromThePlasticAroundIt) {
  Polygons region = square(9);
  region.push_back(square(4.8).front());
  std::ranges::reverse(region.back());
  const Path fill = far_fill(), hole = started_at(ring_wall(5), 4);
  const Layer led = with_leads(layer_of({hole}), {region}, &fill, plain_hops);
  ASSERT_EQ(led.paths.size(), 2u);
  EXPECT_LT(led.paths.front().start().x, -5);
}

TEST(Leads, AnInnerLoopGoesOverFromWhereItEnds) {
  const Path inner = started_at(ring_wall(4.6), 4), outer = started_at(ring_wall(5), 4);
  const auto over = stroke_between(inner, 0.06, outer, plain_hops);
  ASSERT_TRUE(over);
  EXPECT_EQ(over->road().role, Role::refill);
  EXPECT_EQ(over->island, outer.island);
  EXPECT_NEAR(distance(over->start(), inner.start()), 0.06, 1e-9);
  EXPECT_NEAR(over->start().y, 0.06, 1e-9);  // the ring comes down to its start
  EXPECT_EQ(over->end(), outer.start());
  EXPECT_NEAR(volume_mm3(*over), 2 * (1 - OozeModel{}.left(HopTime{}.seconds(length_mm(*over)))), 1e-6);
  EXPECT_FALSE(stroke_between(outer, 0, outer, plain_hops));
}

TEST(Leads, WallsThatLackNothingHaveNone) {
  Path near = far_fill();
  near.points = {{-4, 0}, {-4.9, 0}};
  const Path wall = started_at(ring_wall(5), 4);
  EXPECT_EQ(with_leads(layer_of({wall}), {square(5.2)}, &near, plain_hops).paths.size(), 1u);
  EXPECT_EQ(with_leads(layer_of({wall}), {square(5.2)}, nullptr, plain_hops).paths.size(), 1u);
  Path after_loop = wall;
  after_loop.inner_source = 3;
  const Path fill = far_fill();
  EXPECT_EQ(with_leads(layer_of({after_loop}), {square(5.2)}, &fill, plain_hops).paths.size(), 1u);
}

}  // namespace
}  // namespace cleancolor
