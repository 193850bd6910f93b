#include "shield/walls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

using namespace cleancolor;

namespace {

const Road road{.role = Role::rampart, .width_mm = 0.4, .height_mm = 0.2, .area_mm2 = 0.08, .speed_mm_s = 120};
const std::array<WallPrinter, 2> printers{{{0, road}, {1, road}}};

double length_of(const std::vector<Path>& paths, int extruder) {
  double sum = 0;
  for (const Path& p : paths)
    if (p.extruder == extruder) sum += length_mm(p);
  return sum;
}

Box<Vec2> box_of(const std::vector<Path>& paths, int extruder) {
  Box<Vec2> box;
  for (const Path& path : paths)
    if (path.extruder == extruder)
      for (const Vec2 p : path.points) box.add(p);
  return box;
}

}  // namespace

TEST(Walls, AreClosedPathsOfTheirOwnExtruders) {
  const std::vector<Polygons> walls{rectangle({0, 0}, {10, 10}), rectangle({-4, -4}, {14, 14})};
  const std::vector<Path> paths = wall_paths(walls, printers);
  ASSERT_EQ(paths.size(), 2U);
  for (int e : {0, 1}) {
    EXPECT_TRUE(paths[std::size_t(e)].closed);
    EXPECT_EQ(paths[std::size_t(e)].extruder, e);
    EXPECT_EQ(paths[std::size_t(e)].island, -1);
    EXPECT_EQ(paths[std::size_t(e)].road().role, Role::rampart);
  }
  EXPECT_NEAR(length_mm(paths[1]), 4 * 18, 1e-9);
}

TEST(HalfWalls, EachNozzlePrintsTheHalfOnTheFarSideOfTheOther) {
  // Nozzle 1 is on the right: while nozzle 0 prints the right half, nozzle 1 is further right still.
  const std::vector<Path> paths = half_wall_paths(rectangle({0, 0}, {20, 10}), printers, {33, 0});
  ASSERT_EQ(paths.size(), 2U);
  EXPECT_EQ(box_of(paths, 0).max.x, 20);
  EXPECT_EQ(box_of(paths, 0).min.x, 9.5);
  EXPECT_EQ(box_of(paths, 1).min.x, 0);
  EXPECT_EQ(box_of(paths, 1).max.x, 10.5);
  // Together the whole ring, and an overlap of 1 mm at both joints.
  EXPECT_NEAR(length_of(paths, 0) + length_of(paths, 1), 60 + 2, 1e-9);
  for (const Path& path : paths) EXPECT_FALSE(path.closed);
}

TEST(HalfWalls, AreSplitAlongTheNozzlesWhereverThoseLie) {
  const std::vector<Path> paths = half_wall_paths(rectangle({0, 0}, {20, 10}), printers, {0, -25});
  EXPECT_EQ(box_of(paths, 0).max.y, 5.5);
  EXPECT_EQ(box_of(paths, 0).min.y, 0);
  EXPECT_EQ(box_of(paths, 1).min.y, 4.5);
}

TEST(HalfWalls, ARingThatWindsAcrossTheMiddleIsCutWhereverItCrosses) {
  // Both arms of this C reach over the middle: an outer and an inner piece on its left, the ends on its right.
  const Polygons comb = difference(rectangle({0, 0}, {20, 12}), rectangle({5, 3}, {21, 9}));
  const std::vector<Path> paths = half_wall_paths(comb, printers, {33, 0});
  EXPECT_EQ(std::ranges::count(paths, 0, &Path::extruder), 2);
  EXPECT_EQ(std::ranges::count(paths, 1, &Path::extruder), 2);
  EXPECT_NEAR(length_of(paths, 0) + length_of(paths, 1), length_mm(comb) + 4, 1e-6);
}

TEST(HalfWalls, EachRingIsSplitAtItsOwnMiddle) {
  const Polygons both = united(rectangle({0, 0}, {6, 6}), rectangle({30, 0}, {36, 6}));
  const std::vector<Path> paths = half_wall_paths(both, printers, {33, 0});
  ASSERT_EQ(paths.size(), 4U);
  EXPECT_NEAR(length_of(paths, 0), length_of(paths, 1), 1e-9);
  EXPECT_EQ(box_of(paths, 0).min.x, 2.5);
  EXPECT_EQ(box_of(paths, 1).max.x, 33.5);
  // One so small that its halves would lie upon each other is not printed twice.
  const std::vector<Path> small = half_wall_paths(rectangle({16.7, 0}, {17.3, 1}), printers, {33, 0});
  ASSERT_EQ(small.size(), 1U);
  EXPECT_TRUE(small[0].closed);
}

TEST(WallBrims, StayApartFromTheNextWall) {
  const std::vector<Polygons> walls{rectangle({0, 0}, {10, 10}), rectangle({-2, -2}, {12, 12})};
  const std::vector<Path> loops = wall_brims(walls, printers, 5, 2, 0.5);
  EXPECT_LE(box_of(loops, 0).max.x, 11.5 - 0.5 + 1e-6) << "half a road away from the middle between both";
  EXPECT_NEAR(box_of(loops, 1).max.x, 17, 1e-6);
}

TEST(WallBrims, SurroundEachWallFromTheInsideOut) {
  const std::vector<Polygons> walls{rectangle({0, 0}, {10, 10})};
  const std::vector<Path> loops = wall_brims(walls, printers, 2, 4, 0.5);
  ASSERT_EQ(loops.size(), 4U);
  for (std::size_t i = 1; i < loops.size(); ++i) EXPECT_GT(length_mm(loops[i]), length_mm(loops[i - 1]));
  EXPECT_NEAR(box_of(loops, 0).max.x, 12, 1e-6);
  EXPECT_TRUE(wall_brims(walls, printers, 0, 4, 0.5).empty());
}

TEST(HalfWallBrims, LeaveTheIdleNozzleBesideThePart) {
  // Closer together than the ring is wide: beside a whole loop the second nozzle would hang over the part.
  const Polygons wall = rectangle({0, 0}, {20, 10});
  const std::vector<Path> loops = half_wall_brims(wall, printers, 2, 0.5, {15, 0});
  ASSERT_EQ(loops.size(), 8U) << "two halves of four loops";
  EXPECT_NEAR(box_of(loops, 0).min.x, 9.5, 1e-6);
  EXPECT_NEAR(box_of(loops, 0).max.x, 22, 1e-6);
  EXPECT_NEAR(box_of(loops, 1).min.x, -2, 1e-6);
  EXPECT_NEAR(box_of(loops, 1).max.x, 10.5, 1e-6);
  double whole = 0;
  for (const Path& loop : wall_brims(std::array{wall}, printers, 2, 4, 0.5)) whole += length_mm(loop);
  EXPECT_NEAR(length_of(loops, 0) + length_of(loops, 1), whole + 4 * 2, 1e-6);
}
