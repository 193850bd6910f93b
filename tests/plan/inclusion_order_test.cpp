#include "plan/inclusion_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "drawn_layer.hpp"

namespace cleancolor {
namespace {

using namespace test;

Path box(int extruder, Vec2 low, Vec2 high, int island = 0, int depth = 0) {
  return drawn_path(extruder, to_mm(rectangle(low, high).front()), true, depth, island);
}

Path fill(int extruder, Vec2 a, Vec2 b, int island = 0) {
  return drawn_path(extruder, {a, b}, false, fill_depth, island);
}

/// The names of the paths, in their order.
std::string order_of(const std::vector<std::pair<char, Path>>& named) {
  std::vector<Path> paths;
  for (const auto& [name, path] : named) paths.push_back(path);
  std::string result;
  for (const int i : inclusion_order(paths)) result += named[std::size_t(i)].first;
  return result;
}

// The paper's figure 10, its inner colours different:
//   +--A-----------------+
//   |  +--B----+  +-C-+  |
//   |  | +-D-+ |  +---+  |
//   |  | +---+g|  f  e   |
//   |  +-------+         |
//   +--------------------+
const Path a = box(0, {0, 0}, {30, 20}), b = box(1, {3, 3}, {13, 15}), c = box(0, {18, 10}, {24, 16}),
           d = box(0, {5, 7}, {9, 11}), e = fill(0, {20, 1}, {20, 6}), f = fill(0, {18, 1}, {18, 8}),
           g = fill(1, {11, 4}, {11, 9});

TEST(InclusionOrder, GoesFromTheInsideOutAcrossColours) {
  EXPECT_EQ(order_of({{'A', a}, {'B', b}, {'C', c}, {'D', d}, {'e', e}, {'f', f}, {'g', g}}), "DgBCfeA");
  EXPECT_EQ(order_of({{'g', g}, {'f', f}, {'e', e}, {'D', d}, {'C', c}, {'B', b}, {'A', a}}), "DgBCfeA");
}

TEST(InclusionOrder, PrintsInnerLoopsBeforeOuterOnes) {
  EXPECT_EQ(order_of({{'A', a}, {'D', d}, {'B', b}}), "DBA");
}

TEST(InclusionOrder, PrintsTheLongerLoopsOfAZoneFirst) {
  EXPECT_EQ(order_of({{'C', c}, {'B', b}}), "BC");
  EXPECT_EQ(order_of({{'B', b}, {'C', c}, {'A', a}}), "BCA");
  // Of equal ones the first given.
  const Path twin = box(1, {30, 0}, {36, 6});
  EXPECT_EQ(order_of({{'C', c}, {'T', twin}}), "CT");
  EXPECT_EQ(order_of({{'T', twin}, {'C', c}}), "TC");
}

TEST(InclusionOrder, KeepsWhatFillsAZoneTogetherAfterTheLoopsInside) {
  EXPECT_EQ(order_of({{'f', f}, {'C', c}, {'e', e}, {'A', a}}), "CfeA");
  // Longer than any loop, and of another colour.
  const Path other = fill(1, {26, -500}, {26, 500});
  EXPECT_EQ(order_of({{'o', other}, {'f', f}, {'C', c}, {'e', e}}), "Cfeo");
}

TEST(InclusionOrder, TakesFillsThatEndOnALoopForTheInsideOfIt) {
  EXPECT_EQ(order_of({{'A', a}, {'f', fill(0, {0, 5}, {30, 5})}}), "fA");
}

TEST(InclusionOrder, TakesClosedFillsForFills) {
  Path ring = box(0, {14, 1}, {17, 8});
  ring.depth = fill_depth;
  EXPECT_EQ(order_of({{'r', ring}, {'A', a}, {'B', b}}), "BrA");
}

TEST(InclusionOrder, OfTwoLoopsAtOnePlaceHasBothOnce) {
  EXPECT_EQ(order_of({{'A', a}, {'B', a}}), "AB");
}

TEST(InclusionOrder, OfNothingIsNothing) {
  EXPECT_TRUE(inclusion_order({}).empty());
}

}  // namespace
}  // namespace cleancolor
