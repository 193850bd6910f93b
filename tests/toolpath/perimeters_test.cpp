#include "toolpath/perimeters.hpp"

#include <gtest/gtest.h>

#include "toolpath/regions.hpp"

namespace cleancolor {
namespace {

std::vector<Path> loops_of(const Polygons& region, int count, bool external_first = false) {
  std::vector<Path> loops;
  for (const Island& island : islands(region)) {
    Shell shell =
        perimeters(island, {}, plain_roads(),
                   {.count = count, .external_first = external_first, .thin_walls = false, .gap_fill = false});
    for (Path& path : shell.paths) loops.push_back(std::move(path));
  }
  return loops;
}

std::vector<bool> external(const std::vector<Path>& loops) {
  std::vector<bool> result;
  for (const Path& loop : loops) result.push_back(loop.road().role == Role::external_perimeter);
  return result;
}

TEST(Perimeters, OfASquareAreOneLoopEachTheExternalOneLast) {
  EXPECT_EQ(external(loops_of(nested_squares({100}), 3)), (std::vector<bool>{false, false, true}));
  EXPECT_EQ(external(loops_of(nested_squares({100}), 3, true)), (std::vector<bool>{true, false, false}));
}

TEST(Perimeters, GoAroundHolesToo) {
  const auto loops = loops_of(nested_squares({100, 20}), 3);
  EXPECT_EQ(loops.size(), 6u);
  EXPECT_EQ(external(loops), (std::vector<bool>{false, false, false, false, true, true}));
  EXPECT_EQ(loops_of(nested_squares({100, 80, 60, 40}), 3).size(), 12u);  // two rings, one in the other
  Polygons five_holes = nested_squares({50});
  for (const Vec2 c : {Vec2{10, 10}, Vec2{10, 40}, Vec2{40, 10}, Vec2{40, 40}, Vec2{25, 25}})
    five_holes = difference(five_holes, rectangle(c - Vec2{2, 2}, c + Vec2{2, 2}));
  EXPECT_EQ(loops_of(five_holes, 2).size(), 12u);
}

TEST(Perimeters, RunHalfAWidthInsideAndASpacingApart) {
  const auto loops = loops_of(nested_squares({20}), 2);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_NEAR(length_mm(loops[1]), 4 * 19.6, 1e-3);
  EXPECT_NEAR(length_mm(loops[0]), 4 * (19.6 - 0.6712), 1e-3);  // spacing 0.4 - 0.3 (1 - pi/4)
}

TEST(Perimeters, OutlinesRunCounterclockwise) {
  for (const Path& loop : loops_of(nested_squares({100, 20}), 2)) {
    Ring ring;
    for (const Vec2 p : loop.points) ring.push_back(to_nm(p));
    const bool around_hole = length_mm(loop) < 120;
    EXPECT_EQ(ClipperLib::Orientation(ring), !around_hole);
  }
}

TEST(Perimeters, LeaveTheInfillARegionThatReachesUnderTheInnermostLoop) {
  const Shell shell =
      perimeters(square_island(20), {}, plain_roads(), {.count = 2, .thin_walls = false, .gap_fill = false});
  // Half a spacing inside the inner loop's line, less a quarter of a spacing of overlap.
  const double side = 20 - 2 * (0.2 + 0.3356 + 0.3356 / 4);
  EXPECT_NEAR(area_mm2(shell.fill), side * side, 0.01);
}

TEST(Perimeters, KeepInfillInsideHoweverMuchOverlapIsAskedFor) {
  for (const int count : {1, 2}) {
    const Shell shell =
        perimeters(square_island(20), {}, plain_roads(),
                   {.count = count, .thin_walls = false, .gap_fill = false, .infill_overlap = {10, false}});
    EXPECT_NEAR(area_mm2(shell.fill), 19.6 * 19.6, 0.01);
  }
}

TEST(Perimeters, OfNoneLeaveEverythingToTheInfill) {
  const Shell shell = perimeters(square_island(20), {}, plain_roads(), {.count = 0});
  EXPECT_TRUE(shell.paths.empty());
  EXPECT_NEAR(area_mm2(shell.fill), 400, 1e-6);
}

TEST(Perimeters, SmallLoopsAreSlower) {
  const PerimeterOptions options{.count = 1, .small_perimeter_speed = {0.5, true}};
  const double slow = perimeters(square_island(5), {}, plain_roads(), options).paths[0].road().speed_mm_s;
  const double fast = perimeters(square_island(50), {}, plain_roads(), options).paths[0].road().speed_mm_s;
  EXPECT_DOUBLE_EQ(slow, fast / 2);
}

TEST(Perimeters, PrintAThinWallAsOneRoadOfItsOwnWidth) {
  const Island wall = islands(rectangle({0, 0}, {20, 0.5})).front();
  const Shell without = perimeters(wall, {}, plain_roads(), {.count = 2, .thin_walls = false, .gap_fill = false});
  const Shell with = perimeters(wall, {}, plain_roads(), {.count = 2, .thin_walls = true, .gap_fill = true});
  ASSERT_EQ(with.paths.size(), 1u);
  EXPECT_FALSE(with.paths[0].closed);
  EXPECT_NEAR(with.paths[0].road().width_mm, 0.5, 0.01);
  EXPECT_NEAR(length_mm(with.paths[0]), 19.5, 0.3);
  EXPECT_EQ(with.paths[0].road().role, Role::external_perimeter);
  EXPECT_EQ(without.paths.size(), 1u);  // a loop that lies on its own other side
}

TEST(Perimeters, FillTheGapBetweenTwoLoops) {
  // 1.1 mm: two outer loops leave 0.3 mm in the middle, too little for two more.
  const Island wall = islands(rectangle({0, 0}, {20, 1.1})).front();
  const Shell shell = perimeters(wall, {}, plain_roads(), {.count = 3, .thin_walls = true, .gap_fill = true});
  ASSERT_EQ(shell.paths.size(), 2u);
  EXPECT_EQ(shell.paths[1].road().role, Role::gap_fill);
  // All of the wall but the rounded edges of its two sides: half of 0.3 (1 - pi/4) each.
  EXPECT_NEAR(total_volume_mm3(shell.paths), 20 * (1.1 - 0.0644) * 0.3, 0.2);
}

TEST(MarkOverhangs, KeepsOneLoopAndTellsWhichPartHangs) {
  Path loop = loops_of(nested_squares({20}), 1).front();
  const double length = length_mm(loop);
  mark_overhangs(loop, rectangle({10, -1}, {30, 30}), plain_roads().overhang_perimeter);
  EXPECT_NEAR(length_mm(loop), length, 1e-6);
  double hanging = 0;
  for (std::size_t s = 0; s < loop.stretches.size(); ++s) {
    const std::size_t last = s + 1 < loop.stretches.size() ? loop.stretches[s + 1].first_segment : loop.segments();
    for (std::size_t i = loop.stretches[s].first_segment; i < last; ++i)
      if (loop.stretches[s].road.role == Role::overhang_perimeter)
        hanging += distance(loop.points[i], loop.points[(i + 1) % loop.points.size()]);
  }
  EXPECT_NEAR(hanging, 2 * 9.8 + 19.6, 1e-6);
}

}  // namespace
}  // namespace cleancolor
