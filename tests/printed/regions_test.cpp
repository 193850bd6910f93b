#include "printed/regions.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace cleancolor {
namespace {

constexpr double w = 0.4;
// What the round corners of a wall leave of the square ones.
constexpr double corners_mm2 = (4 - std::numbers::pi) * w / 2 * w / 2;

using Roads = std::vector<LaidRoad>;

void add_line(Roads& roads, std::vector<Vec2> points, Role role, int nozzle = 0) {
  for (std::size_t i = 1; i < points.size(); ++i) roads.push_back({points[i - 1], points[i], w, nozzle, role});
}
void add_square(Roads& roads, Vec2 min, double side, Role role, int nozzle = 0) {
  const Vec2 max = min + Vec2{side, side};
  add_line(roads, {min, {max.x, min.y}, max, {min.x, max.y}, min}, role, nozzle);
}
/// Lines 2 mm apart: most of the square stays empty.
void add_sparse_infill(Roads& roads, Vec2 min, double side, int nozzle = 0) {
  for (double x = min.x + 1; x < min.x + side - 0.5; x += 2)
    add_line(roads, {{x, min.y + 0.3}, {x, min.y + side - 0.3}}, Role::internal_infill, nozzle);
}

TEST(Regions, AStadiumIsARectangleAndACircle) {
  const Polygons one = {stadium({1, 2}, {4, 6}, w)};
  EXPECT_NEAR(area_mm2(one), 5 * w + std::numbers::pi * w * w / 4, 0.03 * std::numbers::pi * w * w / 4);
  EXPECT_GT(area_mm2(one[0]), 0);  // counterclockwise
  EXPECT_NEAR(area_mm2(Polygons{stadium({1, 2}, {1, 2}, w)}), std::numbers::pi * w * w / 4, 0.01);
}

TEST(Regions, AWallWithSparseInfillEnclosesItsRegion) {
  Roads roads;
  add_square(roads, {0, 0}, 20, Role::external_perimeter);
  EXPECT_NEAR(area_mm2(region(roads, 0)), 4 * 20 * w - corners_mm2, 0.02);  // nothing runs inside it
  add_sparse_infill(roads, {0, 0}, 20);
  const Polygons all = region(roads, 0);
  EXPECT_NEAR(area_mm2(all), (20 + w) * (20 + w) - corners_mm2, 0.02);
  EXPECT_EQ(islands(all).size(), 1u);
}

TEST(Regions, HolesStayEmptyAndOtherColoursStayOthers) {
  Roads roads;
  add_square(roads, {0, 0}, 20, Role::external_perimeter);
  add_sparse_infill(roads, {0, 0}, 4);
  add_square(roads, {8, 8}, 6, Role::external_perimeter);           // a hole: its wall lies around 5.6 x 5.6 mm
  add_square(roads, {8.4, 8.4}, 5.2, Role::external_perimeter, 1);  // filled by another colour
  add_sparse_infill(roads, {8.4, 8.4}, 5.2, 1);
  const double hole = (6 - w) * (6 - w);
  EXPECT_NEAR(area_mm2(region(roads, 0)), (20 + w) * (20 + w) - corners_mm2 - hole, 0.02);
  EXPECT_NEAR(area_mm2(region(roads, 1)), (5.2 + w) * (5.2 + w) - corners_mm2, 0.02);
}

TEST(Regions, SeamsAreClosed) {
  Roads roads;
  add_line(roads, {{0, 10}, {0, 0}, {20, 0}, {20, 20}, {0, 20}, {0, 10.8}}, Role::external_perimeter);
  add_sparse_infill(roads, {0, 0}, 20);
  EXPECT_NEAR(area_mm2(region(roads, 0)), (20 + w) * (20 + w) - corners_mm2, 0.02);
}

TEST(Regions, IslandsAreApart) {
  Roads roads;
  for (const double x : {0., 10., 20.}) {
    add_square(roads, {x, 0}, 6, Role::external_perimeter);
    add_sparse_infill(roads, {x, 0}, 6);
  }
  EXPECT_EQ(islands(region(roads, 0)).size(), 3u);
}

TEST(Regions, AuxiliaryPlasticIsNoPartOfThem) {
  Roads roads;
  add_square(roads, {0, 0}, 20, Role::rampart);
  add_square(roads, {5, 5}, 4, Role::wipe_tower);
  EXPECT_TRUE(region(roads, 0).empty());
  EXPECT_FALSE(has_part(roads));
  EXPECT_TRUE(region({}, 0).empty());
}

TEST(Regions, RoadsOfUnknownRoleAreTakenAsTheyLie) {
  Roads roads;
  add_line(roads, {{0, 0}, {10, 0}}, Role::unknown);
  EXPECT_NEAR(area_mm2(region(roads, 0)), 10 * w + std::numbers::pi * w * w / 4, 0.01);
}

TEST(Regions, WhatLiesOutsideOfWallsCountsToo) {
  Roads roads;
  add_square(roads, {0, 0}, 6, Role::external_perimeter);
  add_line(roads, {{20, 0}, {30, 0}}, Role::gap_fill);
  EXPECT_EQ(islands(region(roads, 0)).size(), 2u);
}

TEST(Regions, AreNearlyTheSameWithLessDetail) {
  Roads roads;
  std::vector<Vec2> circle;
  for (int i = 0; i <= 360; ++i) circle.push_back(turned({10, 0}, i * std::numbers::pi / 180));
  add_line(roads, circle, Role::external_perimeter);
  add_line(roads, {{-9, 0}, {9, 0}}, Role::internal_infill);
  const double fine = area_mm2(region(roads, 0)), coarse = area_mm2(region(roads, 0, 0.1));
  EXPECT_NEAR(fine, std::numbers::pi * 10.2 * 10.2, 0.5);
  EXPECT_NEAR(coarse, fine, 0.1 * 2 * std::numbers::pi * 10.2);
}

}  // namespace
}  // namespace cleancolor
