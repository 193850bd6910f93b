#include "replan/worth.hpp"

#include <gtest/gtest.h>

#include "replan/columns.hpp"

namespace cleancolor {
namespace {

const Config usual;

TEST(Worth, ACleanerPrintIsWorthItsTime) {
  EXPECT_TRUE(is_worth_it({1, 1, 1300}, {80, 20, 1000}, usual));
}

TEST(Worth, NothingIsHandedOutThatSmearsOrLacksMoreThanTheFile) {
  EXPECT_FALSE(is_worth_it({5, 3.3, 500}, {5, 3, 1000}, usual));
  EXPECT_FALSE(is_worth_it({5.5, 0, 900}, {5, 0, 1000}, usual));
}

TEST(Worth, HolesWeighAsMuchAsInTheCost) {
  EXPECT_TRUE(is_worth_it({5.5, 0, 1000}, {5, 0.5, 1000}, usual));
  EXPECT_FALSE(is_worth_it({4.5, 0.5, 900}, {5, 0, 1000}, usual));
}

TEST(Worth, ATenthCleanerMayTakeLessThanATenthLonger) {
  EXPECT_TRUE(is_worth_it({9, 0, 8400}, {10, 0, 8000}, usual));
  EXPECT_FALSE(is_worth_it({9, 0, 8900}, {10, 0, 8000}, usual));
}

TEST(Worth, NothingIsHandedOutThatTakesLongForNothing) {
  EXPECT_FALSE(is_worth_it({0, 0, 1100}, {0.01, 0.01, 1000}, usual));
  EXPECT_FALSE(is_worth_it({0, 0.5, 3000}, {0, 1, 1000}, usual));
}

TEST(Worth, SecondsBeyondThreeTenthsMoreCountTenfold) {
  const Cleanness before{0, 0, 1000};
  const double usual_s = print_cost({0, 0, 1300}, before, usual) - print_cost({0, 0, 1200}, before, usual);
  const double late_s = print_cost({0, 0, 1500}, before, usual) - print_cost({0, 0, 1400}, before, usual);
  EXPECT_NEAR(usual_s, 100 * usual.weight_time, 1e-9);
  EXPECT_NEAR(late_s, 10 * usual_s, 1e-9);
}

TEST(Worth, LessRampartIsTriedWhereItTakesLong) {
  using enum RampartExtent;
  EXPECT_EQ(worth_trying({0, 0, 1040}, {50, 10, 1000}, usual), std::vector<RampartExtent>{});
  EXPECT_EQ(worth_trying({1, 1, 1200}, {50, 10, 1000}, usual), std::vector{column});
  EXPECT_EQ(worth_trying({0, 0.5, 1700}, {0, 4, 1000}, usual), (std::vector{column, none}));
}

Ring box_ring(double x, double y, double width) {
  return {to_nm({x, y}), to_nm({x + width, y}), to_nm({x + width, y + width}), to_nm({x, y + width})};
}

Slices towers(const std::vector<Polygons>& layers) {
  Slices slices;
  for (const Polygons& outline : layers) {
    slices.slabs.push_back({.print_z_mm = 0.3 * double(slices.slabs.size() + 1), .height_mm = 0.3});
    slices.regions.push_back(packed(std::vector<Polygons>{outline}));
    slices.outlines.emplace_back(outline);
  }
  return slices;
}

TEST(Columns, WhatIsNearOrAboveEachOtherIsOne) {
  EXPECT_EQ(columns(towers({{box_ring(0, 0, 10), box_ring(12, 0, 10)}}), 3).size(), 1u);
  EXPECT_EQ(columns(towers({{box_ring(0, 0, 10), box_ring(12, 0, 10)}}), 1).size(), 2u);
  EXPECT_EQ(columns(towers({{box_ring(0, 0, 10), box_ring(20, 0, 10)}, {box_ring(9, 2, 12)}}), 1).size(), 1u);
}

TEST(Columns, TheShortestIsOneThatGoesUpAllTheWay) {
  const Slices slices =
      towers({{box_ring(0, 0, 10), box_ring(20, 0, 8), box_ring(40, 0, 2)}, {box_ring(0, 0, 10), box_ring(20, 0, 8)}});
  const auto found = shortest_column(slices, 3);
  ASSERT_TRUE(found);
  for (const PackedPolygons& outline : found->outlines) EXPECT_EQ(Polygons(outline), Polygons{box_ring(20, 0, 8)});
  EXPECT_EQ(found->regions, slices.regions);
  EXPECT_FALSE(shortest_column(towers({{box_ring(0, 0, 10)}}), 3));
}

TEST(Columns, ATowerBesideThePartIsLeftOutUnlessItIsNear) {
  const Polygons part{box_ring(0, 0, 10)}, tower{box_ring(20, 0, 8)};
  const Slices both = towers({{part[0], tower[0]}, {tower[0]}}), alone = towers({part, {}});
  const Slices without = without_columns_beside(both, alone, 3);
  EXPECT_EQ(Polygons(without.outlines[0]), part);
  EXPECT_TRUE(Polygons(without.outlines[1]).empty());
  EXPECT_EQ(without_columns_beside(both, alone, 15).outlines, both.outlines);
}

}  // namespace
}  // namespace cleancolor
