#include "toolpath/bridges.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace cleancolor {
namespace {

double degrees(double rad) {
  return rad * 180 / std::numbers::pi;
}

Polygons turned(const Polygons& region, double angle_rad) {
  Polygons result = region;
  for (Ring& ring : result)
    for (Point& p : ring) {
      const Vec2 v = to_mm(p);
      p = to_nm({v.x * std::cos(angle_rad) - v.y * std::sin(angle_rad),
                 v.x * std::sin(angle_rad) + v.y * std::cos(angle_rad)});
    }
  return result;
}

//  ####......####     the gap between two piers: lines must run from pier to pier
TEST(BridgeAngle, CrossesTheGapFromPierToPier) {
  const Polygons piers = united(rectangle({-20, -10}, {-8, 10}), rectangle({8, -10}, {20, 10}));
  const Polygons gap = rectangle({-8, -10}, {8, 10});
  for (int turn = 0; turn < 180; turn += 20) {
    SCOPED_TRACE(turn);
    const double rad = turn * std::numbers::pi / 180;
    const auto angle = bridge_angle_rad(turned(gap, rad), turned(piers, rad));
    ASSERT_TRUE(angle.has_value());
    EXPECT_NEAR(std::remainder(degrees(*angle) - turn, 180), 0, 5.1);
  }
}

TEST(BridgeAngle, TakesTheShortWayOverAHoleInAPlate) {
  const Polygons gap = rectangle({-20, -4}, {20, 4});
  const Polygons plate = difference(rectangle({-30, -14}, {30, 14}), gap);
  const auto angle = bridge_angle_rad(gap, plate);
  ASSERT_TRUE(angle.has_value());
  EXPECT_NEAR(degrees(*angle), 90, 5.1);
}

TEST(BridgeAngle, IsNoneForABalcony) {
  EXPECT_FALSE(bridge_angle_rad(rectangle({0, 0}, {10, 10}), {}).has_value());
}

}  // namespace
}  // namespace cleancolor
