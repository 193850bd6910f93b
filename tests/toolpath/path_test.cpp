#include "toolpath/path.hpp"

#include <gtest/gtest.h>

namespace cleancolor {
namespace {

/// A 4 x 3 loop whose first two segments are `a` and the others `b`.
Path two_part_loop() {
  Path path;
  path.closed = true;
  path.points = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
  path.stretches = {{0, {.width_mm = 0.4, .area_mm2 = 1}}, {2, {.width_mm = 0.6, .area_mm2 = 10}}};
  return path;
}

/// The area of the road on the segment from p to q, whichever number it has.
double area_on(const Path& path, Vec2 p, Vec2 q) {
  for (std::size_t i = 0; i < path.segments(); ++i) {
    const Vec2 a = path.points[i], b = path.points[(i + 1) % path.points.size()];
    if (!((a == p && b == q) || (a == q && b == p))) continue;
    double area = 0;
    for (const Stretch& s : path.stretches)
      if (s.first_segment <= i) area = s.road.area_mm2;
    return area;
  }
  return -1;
}

void expect_same_roads(const Path& path) {
  EXPECT_EQ(area_on(path, {0, 0}, {4, 0}), 1);
  EXPECT_EQ(area_on(path, {4, 0}, {4, 3}), 1);
  EXPECT_EQ(area_on(path, {4, 3}, {0, 3}), 10);
  EXPECT_EQ(area_on(path, {0, 3}, {0, 0}), 10);
  EXPECT_EQ(path.stretches.front().first_segment, 0u);
  EXPECT_DOUBLE_EQ(length_mm(path), 14);
  EXPECT_DOUBLE_EQ(volume_mm3(path), 7 * 1 + 7 * 10);
}

TEST(Path, LengthAndVolumeCountEveryStretch) {
  expect_same_roads(two_part_loop());
}

TEST(StartedAt, TurnsTheRoadsWithThePoints) {
  for (std::size_t first = 0; first < 4; ++first) {
    SCOPED_TRACE(first);
    const Path turned = started_at(two_part_loop(), first);
    EXPECT_EQ(turned.start(), two_part_loop().points[first]);
    expect_same_roads(turned);
  }
}

TEST(Reversed, KeepsTheRoadOfEverySegment) {
  for (std::size_t first = 0; first < 4; ++first) expect_same_roads(reversed(started_at(two_part_loop(), first)));
  Path open = two_part_loop();
  open.closed = false;
  const Path back = reversed(open);
  EXPECT_EQ(back.start(), open.end());
  EXPECT_EQ(area_on(back, {0, 0}, {4, 0}), 1);
  EXPECT_EQ(area_on(back, {4, 3}, {0, 3}), 10);
}

TEST(StartedOn, SplitsOneSegmentAndBeginsThere) {
  for (std::size_t segment = 0; segment < 4; ++segment) {
    SCOPED_TRACE(segment);
    const Path loop = two_part_loop();
    const Vec2 middle = lerp(loop.points[segment], loop.points[(segment + 1) % 4], 0.5);
    const Path begun = started_on(loop, segment, middle);
    EXPECT_EQ(begun.start(), middle);
    EXPECT_EQ(begun.points.size(), 5u);
    EXPECT_DOUBLE_EQ(length_mm(begun), 14);
    EXPECT_DOUBLE_EQ(volume_mm3(begun), 77);
  }
}

}  // namespace
}  // namespace cleancolor
