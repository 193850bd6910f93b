#include "plan/joined_loops.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "drawn_layer.hpp"

namespace cleancolor {
namespace {

using namespace test;

/// An outer wall along the ring and the loop 0.4 mm inside it.
std::vector<Path> two_loops(const Ring& ring) {
  Path inner = drawn_path(0, to_mm(offset({ring}, -0.4).front()), true, 1);
  Path outer = drawn_path(0, to_mm(ring), true, 0, 0, Role::external_perimeter);
  outer.stretches.front().road.area_mm2 = 0.09;
  return {inner, outer};
}

/// A ring that bulges in and out, counterclockwise.
Ring bulging(std::mt19937& random) {
  const int lobes = 2 + int(random() % 4);
  Ring ring;
  for (int i = 0; i < 90; ++i) {
    const double angle = 2 * std::numbers::pi * i / 90;
    const double radius = 8 + 1.5 * std::sin(lobes * angle);
    ring.push_back(to_nm(Vec2{std::cos(angle), std::sin(angle)} * radius));
  }
  return ring;
}

double length_of(const Path& path, Role role) {
  double sum = 0;
  for (std::size_t s = 0; s < path.stretches.size(); ++s) {
    const std::size_t end = s + 1 < path.stretches.size() ? path.stretches[s + 1].first_segment : path.segments();
    if (path.stretches[s].road.role != role) continue;
    for (std::size_t i = path.stretches[s].first_segment; i < end; ++i)
      sum += distance(path.points[i], path.points[(i + 1) % path.points.size()]);
  }
  return sum;
}

double distance_mm(const Path& loop, Vec2 p) {
  double least = INFINITY;
  for (std::size_t i = 0; i < loop.points.size(); ++i)
    least =
        std::min(least, distance(p, nearest_on_segment(loop.points[i], loop.points[(i + 1) % loop.points.size()], p)));
  return least;
}

TEST(JoinedLoops, AreOnePathThatBeginsAndEndsInsideAndTakesAsMuchPlastic) {
  std::mt19937 random(5);
  for (int t = 0; t < 50; ++t) {
    SCOPED_TRACE(t);
    const std::vector<Path> loops = two_loops(bulging(random));
    const Path& outer = loops[1];
    std::vector<Path> paths = with_inner_loops(loops, true);
    ASSERT_EQ(paths.size(), 1U);
    paths[0] = started_at(std::move(paths[0]), random() % outer.points.size());
    const Path path = joined(paths[0]);
    EXPECT_FALSE(path.closed);
    EXPECT_NEAR(length_of(path, Role::external_perimeter), length_mm(outer), 1e-6);
    EXPECT_NEAR(volume_mm3(path), volume_mm3(loops[0]) + volume_mm3(outer), 0.02);
    for (const Vec2 end : {path.start(), path.end()}) EXPECT_GT(distance_mm(outer, end), 0.15);
    // Wherever the inner loop went its line is covered, but for the gap at the joint.
    for (const Vec2 p : loops[0].points)
      if (distance(p, paths[0].start()) > 1) EXPECT_LT(distance_mm(path, p), 1e-6);
  }
}

TEST(JoinedLoops, KnowTheirSourcesAndWhereTheOuterOneBegins) {
  std::vector<Path> loops = two_loops(rectangle({0, 0}, {10, 6}).front());
  loops[0].source = 7;
  loops[1].source = 3;
  const Path outer = started_at(with_inner_loops(loops, true).front(), 2);
  const Path path = joined(outer);
  EXPECT_EQ(path.source, 3);
  EXPECT_EQ(path.inner_source, 7);
  EXPECT_EQ(path.points[path.outer_from], outer.start());
}

TEST(JoinedLoops, KeepTheRoadsOfTheirStretches) {
  std::vector<Path> loops = two_loops(rectangle({0, 0}, {10, 6}).front());
  Road bridge = drawn_road;
  bridge.role = Role::overhang_perimeter;
  loops[1].stretches.push_back({2, bridge});
  Path path = with_inner_loops(loops, true).front();
  const double bridged = length_of(path, Role::overhang_perimeter);
  path = started_on(std::move(path), 0, lerp(path.points[0], path.points[1], 0.4));
  EXPECT_NEAR(length_of(joined(path), Role::overhang_perimeter), bridged, 1e-9);
  EXPECT_NEAR(length_of(joined(path), Role::external_perimeter), 32 - bridged, 1e-9);
}

TEST(JoinedLoops, NeedTheInnerLoopNearby) {
  std::vector<Path> loops = two_loops(rectangle({0, 0}, {10, 6}).front());
  loops[0].points = to_mm(rectangle({3, 2}, {7, 4}).front());
  EXPECT_EQ(with_inner_loops(loops, true).size(), 2U);
  // Near one corner it can be joined there, but not where the seam was put.
  loops[0].points = to_mm(rectangle({0.4, 0.4}, {7, 4}).front());
  loops[1] = started_at(std::move(loops[1]), 2);
  if (loops[1].start() == Vec2{0, 0}) loops[1] = started_at(std::move(loops[1]), 2);
  EXPECT_EQ(with_inner_loops(loops, false).size(), 2U);
  EXPECT_EQ(with_inner_loops(loops, true).size(), 1U);
}

TEST(JoinedLoops, CanBeEnteredWhereverTheInnerOneIsThin) {
  const DrawnLayer layer({rectangle({0, 0}, {10, 6}), {}});
  const LayerMap map = layer.map();
  const TravelCost cost(map, {{0, {}, {}}}, {});
  const std::vector<Path> loops = two_loops(rectangle({0, 0}, {10, 6}).front());
  for (std::size_t thin = 0; thin < 4; ++thin)
    for (std::size_t start = 0; start < 4; ++start) {
      Path inner = started_at(loops[0], thin);
      inner.stretches.push_back({1, inner.road()});
      inner.stretches.front().road.width_mm = 0.02;
      const std::vector<Path> paths = with_inner_loops({started_at(inner, start), loops[1]}, true);
      for (const std::vector<Entry>& entries : roadmap(paths, cost).entries)
        EXPECT_FALSE(entries.empty()) << thin << ", " << start;
    }
}

TEST(JoinedLoops, LeaveTheOtherPathsInTheirOrder) {
  std::vector<Path> loops = two_loops(rectangle({0, 0}, {10, 6}).front());
  const Path fill = drawn_path(0, {{2, 2}, {8, 4}}, false), wall = drawn_path(0, {{-5, 0}, {-5, 9}}, false, 0, -1);
  const std::vector<Path> paths = with_inner_loops({wall, loops[0], loops[1], fill}, true);
  ASSERT_EQ(paths.size(), 3U);
  EXPECT_EQ(paths[0].points, wall.points);
  EXPECT_EQ(paths[1].inner.size(), 1U);
  EXPECT_EQ(paths[2].points, fill.points);
}

TEST(Lead, GoesHalfTheWayToTheOtherSide) {
  const Path wall = drawn_path(0, to_mm(rectangle({0, 0}, {10, 0.5}).front()), true, 0, 0, Role::external_perimeter);
  const Path* const all[] = {&wall};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 middle = lerp(wall.points[i], wall.points[(i + 1) % 4], 0.5);
    const double lead = lead_mm(wall, i, middle, all);
    const bool is_long_side = distance(wall.points[i], wall.points[(i + 1) % 4]) > 5;
    EXPECT_NEAR(lead, is_long_side ? 0.25 : 0.3, 1e-9);
    const Path path = led_inside(started_on(wall, i, middle), lead);
    EXPECT_NEAR(distance_mm(wall, path.start()), 0.25, 1e-9);
    EXPECT_EQ(path.start(), path.end());
    EXPECT_NEAR(length_of(path, Role::external_perimeter), 21, 1e-9);
    EXPECT_NEAR(volume_mm3(path), (21 + 1.5 * lead) * 0.08, 1e-9);
  }
}

TEST(Lead, IsNoneWhereThereIsNoRoom) {
  const Path wall = drawn_path(0, to_mm(rectangle({0, 0}, {10, 0.15}).front()), true, 0, 0, Role::external_perimeter);
  const Path* const all[] = {&wall};
  EXPECT_EQ(lead_mm(wall, 0, lerp(wall.points[0], wall.points[1], 0.5), all) > 0,
            std::abs(wall.points[0].x - wall.points[1].x) < 1);
  EXPECT_TRUE(led_inside(wall, 0).closed);
}

TEST(Lead, OfAHolePointsIntoThePlastic) {
  Path hole = drawn_path(0, {{0, 0}, {0, 4}, {4, 4}, {4, 0}}, true, 0, 0, Role::external_perimeter);  // clockwise
  const Path* const all[] = {&hole};
  const Vec2 middle{0, 2};
  const double lead = lead_mm(hole, 0, middle, all);
  EXPECT_NEAR(lead, 0.3, 1e-9);
  EXPECT_NEAR(led_inside(started_on(hole, 0, middle), lead).start().x, -0.3, 1e-9);
}

}  // namespace
}  // namespace cleancolor
