#include "base/polygon.hpp"

#include <gtest/gtest.h>

namespace cleancolor {
namespace {

Polygons square(double side) {
  return rectangle({0, 0}, {side, side});
}

Polygons with_hole(double side, double hole) {
  const double a = (side - hole) / 2;
  return difference(square(side), rectangle({a, a}, {a + hole, a + hole}));
}

TEST(Offset, OfASquareKeepsMitredCorners) {
  EXPECT_NEAR(area_mm2(offset(square(20), 1)), 22 * 22, 1e-6);
  EXPECT_NEAR(area_mm2(offset(square(20), -1)), 18 * 18, 1e-6);
}

TEST(Offset, GrowsIntoHolesAndOutOfOutlines) {
  EXPECT_NEAR(area_mm2(offset(with_hole(20, 10), 1)), 22 * 22 - 8 * 8, 1e-6);
  EXPECT_NEAR(area_mm2(offset(with_hole(20, 10), -1)), 18 * 18 - 12 * 12, 1e-6);
}

TEST(Offset, RoundCornersAreRoundWithinFiveMicrometres) {
  EXPECT_NEAR(area_mm2(offset(square(20), 2, Corners::round)), 20 * 20 + 4 * 20 * 2 + 3.14159265 * 4, 0.07);
}

TEST(Opened, DropsWhatADiscCannotEnter) {
  const Polygons strip = united(square(10), rectangle({10, 4}, {20, 4.3}));
  EXPECT_NEAR(area_mm2(opened(strip, 0.2)), 100, 1e-6);
  EXPECT_GT(area_mm2(opened(strip, 0.1)), 102.9);
}

TEST(Closed, FillsANarrowGap) {
  const Polygons two = united(rectangle({0, 0}, {5, 10}), rectangle({5.1, 0}, {10, 10}));
  EXPECT_EQ(closed(two, 0.1).size(), 1u);
  EXPECT_EQ(closed(two, 0.04).size(), 2u);
}

TEST(Islands, HaveTheirOwnHolesAndIslandsInHolesAreIslands) {
  const Polygons rings = united(with_hole(100, 80), united(rectangle({30, 30}, {70, 70})));
  const Polygons nested = difference(rings, rectangle({40, 40}, {60, 60}));
  const std::vector<Island> pieces = islands(nested);
  ASSERT_EQ(pieces.size(), 2u);
  for (const Island& piece : pieces) EXPECT_EQ(piece.holes.size(), 1u);
  EXPECT_NEAR(area_mm2(polygons(pieces[0])) + area_mm2(polygons(pieces[1])), 3600 + 1200, 1e-6);
}

TEST(Islands, OfNothingAreNone) {
  EXPECT_TRUE(islands({}).empty());
}

TEST(Simplified, KeepsWithinTheToleranceAndDropsTheRest) {
  Ring circle;
  for (int i = 0; i < 1000; ++i)
    circle.push_back(to_nm({10 * std::cos(i * 0.0062831853), 10 * std::sin(i * 0.0062831853)}));
  const Polygons thin = simplified(Polygons{circle}, 0.02);
  ASSERT_EQ(thin.size(), 1u);
  EXPECT_LT(thin[0].size(), 80u);  // a chord of sagitta 0.02 spans 7.2 degrees
  for (const Point& p : thin[0]) EXPECT_NEAR(length(to_mm(p)), 10, 1e-5);
  EXPECT_GT(area_mm2(thin), area_mm2(circle) * 0.995);
}

TEST(Simplified, LineKeepsBothEndsAndCorners) {
  const std::vector<Vec2> line = {{0, 0}, {1, 0.001}, {2, 0}, {2, 1}, {2, 2}};
  EXPECT_EQ(simplified(line, 0.01), (std::vector<Vec2>{{0, 0}, {2, 0}, {2, 2}}));
}

TEST(Contains, CountsTheBorderInAndHolesOut) {
  const Polygons ring = with_hole(20, 10);
  EXPECT_TRUE(contains(ring, to_nm({0, 0})));
  EXPECT_TRUE(contains(ring, to_nm({2, 2})));
  EXPECT_FALSE(contains(ring, to_nm({10, 10})));
  EXPECT_FALSE(contains(ring, to_nm({21, 10})));
}

TEST(ConvexHull, OfAnLIsItsFiveCorners) {
  const Polygons l = united(rectangle({0, 0}, {10, 2}), rectangle({0, 0}, {2, 10}));
  const Ring hull = convex_hull(l);
  EXPECT_EQ(hull.size(), 5u);
  EXPECT_NEAR(area_mm2(hull), 100 - 32, 1e-6);
}

TEST(Polygon, BorderIsAsFarFromInsideAsFromOutside) {
  const Polygons region = {{to_nm({0, 0}), to_nm({10, 0}), to_nm({10, 10}), to_nm({0, 10})}};
  EXPECT_NEAR(border_distance_mm(region, {5, 3}), 3, 1e-9);
  EXPECT_NEAR(border_distance_mm(region, {13, 14}), 5, 1e-9);
  EXPECT_EQ(border_distance_mm(region, {10, 7}), 0);
  EXPECT_EQ(border_distance_mm({}, {0, 0}), INFINITY);
}

TEST(Booleans, OfDisjointBoxesSkipClipperAndStayRight) {
  const Polygons a = square(1), b = rectangle({5, 5}, {6, 6});
  EXPECT_TRUE(intersection(a, b).empty());
  EXPECT_NEAR(area_mm2(difference(a, b)), 1, 1e-9);
  EXPECT_NEAR(area_mm2(united(a, b)), 2, 1e-9);
}

}  // namespace
}  // namespace cleancolor
