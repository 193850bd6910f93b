#include "plan/clear_way.hpp"

#include <gtest/gtest.h>

#include <random>

#include "drawn_layer.hpp"
#include "free_way.hpp"

namespace cleancolor {
namespace {

using namespace test;

double length_of(const std::vector<Vec2>& way) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) sum += distance(way[i], way[i + 1]);
  return sum;
}

double cost_of(const TravelCost& cost, const std::vector<Vec2>& way) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) sum += cost.way(way[i], way[i + 1]);
  return sum;
}

TEST(ClearWay, IsFoundWhereAndOnlyWhereTheSlowGridFindsOne) {
  int clear = 0, none = 0;
  for (unsigned seed = 0; seed < 8; ++seed) {
    std::mt19937 random(seed);
    std::vector<Path> paths;
    const DrawnLayer layer = random_drawn_layer(random, 9, 30, paths);
    const LayerMap map = layer.map();
    const TravelCost cost(map, {{0, {0, 0}, {}}, {1, {11, 2}, {}}}, TravelWeights{});
    std::uniform_real_distribution<double> any(-3, 35);
    for (int t = 0; t < 12; ++t) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", way " << t);
      const Vec2 from{any(random), any(random)}, to{any(random), any(random)};
      const std::vector<Vec2> slow = free_way(cost, from, to, {.longest_mm = 120, .visible = 0.05});
      const std::vector<Vec2> way = clear_way(cost, 0, from, to, 120);
      ASSERT_EQ(way.empty(), slow.empty());
      ++(way.empty() ? none : clear);
      if (way.empty()) continue;
      EXPECT_EQ(way.front(), from);
      EXPECT_EQ(way.back(), to);
      EXPECT_LE(foreign_on(cost, way), 0.05);
      EXPECT_FALSE(crosses(cost, way));
      EXPECT_LE(length_of(way), 120);
      // On the coarse grid it may keep a little further away from other colours.
      EXPECT_LE(cost_of(cost, way), 1.1 * cost_of(cost, slow) + 1e-6);
    }
  }
  EXPECT_GT(clear, 20);
  EXPECT_GT(none, 10);
}

// '0' and '1' printed by these extruders, nozzle 1 far away: around the end of the wall, not through it.
//
//     a  1  b
//        1
//        1
TEST(ClearWay, GoesAroundOtherColoursAsFarAsAllowed) {
  const DrawnLayer layer({{}, rectangle({5, 0}, {6, 20})});
  const LayerMap map = layer.map();
  const TravelCost cost(map, {{0, {0, 0}, {}}}, {});
  const std::vector<Vec2> way = clear_way(cost, 0, {0, 15}, {11, 15}, 40);
  ASSERT_FALSE(way.empty());
  EXPECT_LT(length_of(way), 17);
  EXPECT_TRUE(clear_way(cost, 0, {0, 15}, {11, 15}, 14).empty());
}

// A gap so short that both ends lie on one node of the coarse grid.
TEST(ClearWay, OfAHopWithinOneCellHasBothEnds) {
  const DrawnLayer layer({{}, rectangle({5, 0}, {5.2, 1})});
  const LayerMap map = layer.map();
  const TravelCost cost(map, {{0, {0, 0}, {}}}, {});
  const Vec2 from{4.9, 0.9}, to{5.05, 1.1};
  const std::vector<Vec2> way = clear_way(cost, 0, from, to, 40);
  ASSERT_GE(way.size(), 2U);
  EXPECT_EQ(way.front(), from);
  EXPECT_EQ(way.back(), to);
  EXPECT_FALSE(crosses(cost, way));
}

TEST(ClearWay, StaysWhereTheNozzleReaches) {
  const DrawnLayer layer({{}, rectangle({5, 0}, {6, 20})});
  const LayerMap map = layer.map();
  const TravelCost cost(map, {{0, {0, 0}, rectangle({-5, -5}, {15, 18})}}, {});
  const std::vector<Vec2> way = clear_way(cost, 0, {0, 15}, {11, 15}, 60);
  ASSERT_FALSE(way.empty());
  for (const Vec2 p : way) EXPECT_LE(p.y, 18);
}

TEST(ClearWay, OfPlacesInAPocketIsNone) {
  const Polygons ring = difference(rectangle({0, 0}, {10, 10}), rectangle({3, 3}, {7, 7}));
  const DrawnLayer layer({{}, ring});
  const LayerMap map = layer.map();
  const TravelCost cost(map, {{0, {0, 0}, {}}}, {});
  EXPECT_TRUE(clear_way(cost, 0, {5, 5}, {20, 5}, 1000).empty());
  EXPECT_TRUE(clear_way(cost, 0, {20, 5}, {5, 5}, 1000).empty());
  EXPECT_FALSE(clear_way(cost, 0, {5, 5}, {6, 5}, 1000).empty());
}

}  // namespace
}  // namespace cleancolor
