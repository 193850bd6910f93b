#include "toolpath/bed.hpp"

#include <gtest/gtest.h>

#include <set>

#include "model/meshes.hpp"
#include "toolpath/regions.hpp"

namespace cleancolor {
namespace {

Slices two_colours(Vec2 at = {50, 50}) {
  const Polygons left = rectangle(at, at + Vec2{20, 20}), right = rectangle(at + Vec2{20, 0}, at + Vec2{40, 20});
  return slices_of({{left, right}, {left, right}});
}

std::set<int> extruders(const std::vector<Path>& paths) {
  std::set<int> result;
  for (const Path& path : paths) result.insert(path.extruder);
  return result;
}

TEST(Skirt, GoesAroundEverythingAndEveryNozzlePrintsSome) {
  Config config = plain_config(2);
  config.skirts = 1;
  config.skirt_distance_mm = 6;
  const auto paths = bed_paths(two_colours(), {0, 1}, config);
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_EQ(extruders(paths[0]), (std::set<int>{0, 1}));
  for (const Path& loop : paths[0]) EXPECT_GT(length_mm(loop), 2 * (40 + 20) + 6 * 6.28);  // longer than the hull
}

TEST(Skirt, PushesAsMuchFilamentAsAskedThroughEachNozzle) {
  Config config = plain_config(2);
  config.min_skirt_length_mm = 30;
  double filament[2] = {0, 0};
  const auto paths = bed_paths(two_colours(), {0, 1}, config);
  for (const Path& loop : paths[0]) filament[loop.extruder] += volume_mm3(loop) / (3.14159265 / 4 * 1.75 * 1.75);
  for (const double mm : filament) {
    EXPECT_GE(mm, 30);
    EXPECT_LT(mm, 30 + 8);  // not more than a loop too much
  }
}

TEST(Skirt, AboveTheFirstLayerIsPrintedByAnExtruderOfTheLayer) {
  // Extruder 0 is done after the first layer: its heater may be off.
  const Polygons left = rectangle({50, 50}, {70, 70}), right = rectangle({70, 50}, {90, 70});
  const Slices slices = slices_of({{left, right}, {{}, right}, {{}, right}});
  Config config = plain_config(2);
  config.skirt_height_layers = 3;
  const auto paths = bed_paths(slices, {0, 1}, config);
  ASSERT_EQ(paths.size(), 3u);
  EXPECT_EQ(extruders(paths[0]), (std::set<int>{0, 1}));
  EXPECT_EQ(extruders(paths[1]), (std::set<int>{1}));
  EXPECT_EQ(extruders(paths[2]), (std::set<int>{1}));
}

TEST(Skirt, ThatOnlyOneNozzleCanReachLeavesAPrimeLineToTheOther) {
  Config config = plain_config(2);
  config.extruders[1].extruder_printable_area_mm = {{68, 48}, {200, 48}, {200, 200}, {68, 200}};
  const auto paths = bed_paths(two_colours(), {0, 1}, config);
  int primes_of[2] = {0, 0};
  for (const Path& path : paths[0]) primes_of[path.extruder] += path.road().role == Role::prime;
  EXPECT_EQ(primes_of[0], 0);
  EXPECT_EQ(primes_of[1], 1);
}

TEST(PrimeLines, PrimeEveryNozzleWhereThereIsNoSkirt) {
  Config config = plain_config(2);
  config.skirts = 0;
  const auto paths = bed_paths(two_colours(), {0, 1}, config);
  EXPECT_EQ(extruders(paths[0]), (std::set<int>{0, 1}));
  for (const Path& line : paths[0]) {
    EXPECT_NEAR(length_mm(line), 40, 1e-6);
    EXPECT_LT(line.points[0].y, 10);  // the front edge of the 200 x 200 bed
  }
}

TEST(PrimeLines, TakeAnotherEdgeWhereThePartIsInTheWay) {
  Config config = plain_config(2);
  config.skirts = 0;
  const auto paths = bed_paths(two_colours({80, 2}), {0, 1}, config);
  ASSERT_EQ(paths[0].size(), 2u);
  for (const Path& line : paths[0]) EXPECT_GT(line.points[0].y, 190);
}

TEST(PrimeLines, KeepOutOfTheBrim) {
  Config config = plain_config(1);
  config.skirts = 0;
  config.brim_type = BrimType::outer_only;
  config.brim_width_mm = 14;
  const Polygons cube = rectangle({90, 16}, {110, 36});
  const auto paths = bed_paths(slices_of({{cube}}), {0}, config);
  ASSERT_EQ(paths[0].front().road().role, Role::prime);
  EXPECT_GT(paths[0].front().points[0].y, 190);
}

TEST(PrimeLines, AreShorterWhereNoEdgeIsFreeForWholeOnes) {
  // Bars along all four edges with room for 15 mm between them at the front.
  const Polygons frame = difference(difference(rectangle({1, 1}, {199, 199}), rectangle({20, 20}, {180, 180})),
                                    rectangle({89, 0}, {111, 30}));
  Config config = plain_config(1);
  config.skirts = 0;
  const auto paths = bed_paths(slices_of({{frame}}), {0}, config);
  ASSERT_EQ(paths[0].size(), 1u);
  EXPECT_NEAR(length_mm(paths[0][0]), 10, 1e-6);
}

TEST(PrimeLines, StayWithinReachOfEveryNozzle) {
  Config config = plain_config(2);
  config.skirts = 0;
  config.extruders[1].extruder_printable_area_mm = {{60, 40}, {200, 40}, {200, 200}, {60, 200}};
  const auto paths = bed_paths(two_colours({100, 100}), {0, 1}, config);
  for (const Path& line : paths[0]) EXPECT_GE(line.points[0].y, 40);
}

TEST(Brim, PressesFromOutsideAgainstTheWholeFirstLayer) {
  Config config = plain_config(2);
  config.brim_type = BrimType::outer_only;
  config.brim_width_mm = 4;
  config.skirts = 0;
  config.prime_line_length_mm = 0;
  const auto loops = bed_paths(two_colours(), {0, 1}, config)[0];
  EXPECT_EQ(loops.size(), 12u);  // 4 mm at a spacing of 0.3356
  EXPECT_GT(length_mm(loops.front()), length_mm(loops.back()));
  EXPECT_NEAR(length_mm(loops.back()), 120 + 6.28 * 0.168, 0.1);
}

TEST(BedPaths, ThatANozzleCannotReachAreLeftOutWithAWarning) {
  Config config = plain_config(2);
  config.skirts = 2;
  Warnings warnings;
  const auto paths = bed_paths(two_colours({1, 1}), {0, 1}, config, warnings.progress);
  EXPECT_TRUE(warnings.contain("bed is too small"));
  EXPECT_EQ(extruders(paths[0]), (std::set<int>{0, 1}));  // primed by lines instead
}

}  // namespace
}  // namespace cleancolor
