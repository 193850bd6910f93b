#include "replan/pieces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cleancolor {
namespace {

constexpr double quarter_um = std::numbers::pi / 2 * 10'000;

/// Counterclockwise from (10, 0) to (0, 10) mm about the origin.
Piece quarter() {
  return {.from = {10'000, 0}, .to = {0, 10'000}, .filament_e5 = 9'000, .arc = RoadArc{{0, 0}, false}};
}
double radius_um(FilePoint p) {
  return std::hypot(double(p.x_um), double(p.y_um));
}

TEST(Pieces, OfAnArcAreArcsThatTogetherAreTheWhole) {
  for (const double share : {0.01, 0.3, 0.5, 0.99}) {
    SCOPED_TRACE(share);
    const FilePoint at = at_share(quarter(), share);
    EXPECT_NEAR(radius_um(at), 10'000, 1);
    const auto [first, second] = cut(quarter(), at);
    EXPECT_EQ(first.to, second.from);
    ASSERT_TRUE(first.arc && second.arc);
    EXPECT_EQ(second.arc->center, quarter().arc->center);
    EXPECT_NEAR(length_um(first), share * quarter_um, 2);
    EXPECT_NEAR(length_um(first) + length_um(second), quarter_um, 2);
    EXPECT_NEAR(double(first.filament_e5), share * 9'000, 2);
    EXPECT_EQ(first.filament_e5 + second.filament_e5, 9'000);
  }
}

// Ends that are rounded could lie the wrong way round, and make a circle of it.
TEST(Pieces, ThatAreShortAreStraight) {
  const auto [first, second] = cut(quarter(), at_share(quarter(), 0.002));
  EXPECT_FALSE(first.arc);
  EXPECT_TRUE(second.arc);
}

TEST(Pieces, WalkedBackwardsGoRoundTheOtherWay) {
  const std::vector<Piece> back = backwards({quarter()});
  EXPECT_EQ(back.front().from, quarter().to);
  EXPECT_TRUE(back.front().arc->clockwise);
  EXPECT_NEAR(length_um(back.front()), quarter_um, 1);
  EXPECT_NEAR(double(at_share(back.front(), 0.25).x_um), double(at_share(quarter(), 0.75).x_um), 1);
}

TEST(Pieces, AreNearestOnTheArcOrAtItsEnds) {
  const double d = std::sqrt(0.5);
  EXPECT_NEAR(distance(nearest_mm(quarter(), {1, 1}), {10 * d, 10 * d}), 0, 1e-6);
  EXPECT_NEAR(distance(nearest_mm(quarter(), {-3, 20}), {0, 10}), 0, 1e-6);
  EXPECT_NEAR(distance(nearest_mm(quarter(), {5, -8}), {10, 0}), 0, 1e-6);
  Piece around = quarter();  // the other three quarters
  around.arc->clockwise = true;
  EXPECT_NEAR(length_um(around), 3 * quarter_um, 1);
  EXPECT_NEAR(distance(nearest_mm(around, {-20, 0}), {-10, 0}), 0, 1e-6);
}

TEST(Pieces, LeaveAGapAtTheirEnd) {
  std::vector<Piece> pieces{quarter()};
  const std::int64_t gone = cut_end(pieces, 300);
  EXPECT_NEAR(length_um(pieces.back()), quarter_um - 300, 2);
  EXPECT_EQ(pieces.back().filament_e5 + gone, 9'000);
  cut_end(pieces, 2 * quarter_um);
  EXPECT_TRUE(pieces.empty());
}

TEST(Pieces, AreGoneOverInStepsOnTheArc) {
  const std::vector<FilePoint> points = points_of({quarter()});
  EXPECT_EQ(points.size(), 10U);
  EXPECT_EQ(points.front(), quarter().from);
  EXPECT_EQ(points.back(), quarter().to);
  for (const FilePoint p : points) EXPECT_NEAR(radius_um(p), 10'000, 1);
}

}  // namespace
}  // namespace cleancolor
