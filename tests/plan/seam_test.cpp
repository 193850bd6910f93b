#include "plan/seam.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace cleancolor {
namespace {

Path loop_of(std::vector<Vec2> points) {
  Path path;
  path.closed = true;
  path.points = std::move(points);
  path.stretches = {{0, {}}};
  return path;
}

Path circle(Vec2 c, double r, int sides = 90) {
  std::vector<Vec2> points;
  for (int i = 0; i < sides; ++i) {
    const double a = 2 * std::numbers::pi * i / sides;
    points.push_back(c + Vec2{r * std::cos(a), r * std::sin(a)});
  }
  return loop_of(points);
}

const Path square = loop_of({{0, 0}, {20, 0}, {20, 20}, {0, 20}});

Vec2 seam(const Path& loop, SeamPosition position, Vec2 from = {}, std::uint32_t seed = 0) {
  SeamMemory memory;
  return seamed(loop, position, from, memory, seed).start();
}

TEST(Seam, NearestIsTheCornerNextToTheNozzle) {
  EXPECT_EQ(seam(square, SeamPosition::nearest, {25, 22}), (Vec2{20, 20}));
  EXPECT_EQ(seam(square, SeamPosition::nearest, {-5, 18}), (Vec2{0, 20}));
}

TEST(Seam, NearestPrefersAnInnerCornerToAFlatSpot) {
  //  a notch in the upper side, its bottom corner at (10, 15), and a point on the flat at (4, 20)
  const Path notched = loop_of({{0, 0}, {20, 0}, {20, 20}, {12, 20}, {10, 15}, {8, 20}, {4, 20}, {0, 20}});
  EXPECT_EQ(seam(notched, SeamPosition::nearest, {7, 17}), (Vec2{10, 15}));
}

TEST(Seam, RearIsTheLargestY) {
  EXPECT_NEAR(seam(circle({5, 5}, 10), SeamPosition::rear).y, 15, 0.03);
}

TEST(Seam, AlignedStaysInOneLineUpACylinder) {
  SeamMemory memory;
  Vec2 first;
  for (int layer = 0; layer < 40; ++layer) {
    // Each layer's polygon is turned a little, as after simplification: no two have the same corners.
    Path loop = circle({0, 0}, 10, 60 + layer % 7);
    const Vec2 here = seamed(loop, SeamPosition::aligned, {}, memory, 0).start();
    if (layer == 0) first = here;
    EXPECT_LT(distance(here, first), 1.0) << layer;
    memory.next_layer();
  }
}

TEST(Seam, AlignedTakesTheSharpestCornerWhereNothingIsBelow) {
  const Path wedge = loop_of({{0, 0}, {20, 9}, {20, 11}, {0, 20}, {-30, 10}});
  const Vec2 at = seam(wedge, SeamPosition::aligned);
  EXPECT_EQ(at, (Vec2{-30, 10}));
}

TEST(Seam, RandomIsSpreadOverTheLoopAndTheSameInEveryRun) {
  int quadrants[4] = {0, 0, 0, 0};
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    const Vec2 p = seam(circle({0, 0}, 10), SeamPosition::random, {}, seed);
    EXPECT_EQ(p, seam(circle({0, 0}, 10), SeamPosition::random, {}, seed));
    ++quadrants[(p.x < 0 ? 1 : 0) + (p.y < 0 ? 2 : 0)];
  }
  for (const int n : quadrants) EXPECT_NEAR(n, 100, 40);
}

TEST(Seam, NeverChangesTheLoopItself) {
  for (const SeamPosition position :
       {SeamPosition::nearest, SeamPosition::aligned, SeamPosition::rear, SeamPosition::random}) {
    SeamMemory memory;
    memory.below = {{{10, 0.1}}};  // on the middle of a side: aligned puts a new point there
    const Path turned = seamed(square, position, {3, 3}, memory, 5);
    EXPECT_NEAR(length_mm(turned), 80, 1e-9);
  }
}

}  // namespace
}  // namespace cleancolor
