// Arcs become chords: by themselves, and as moves of a file.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "reader/arc.hpp"
#include "reader/read.hpp"
#include "support_errors.hpp"

namespace cleancolor {
namespace {

constexpr double pi = std::numbers::pi;

/// Chords with the start in front.
std::vector<Vec2> points(const Arc& arc) {
  std::vector<Vec2> all{arc.from_mm};
  for (const ArcPoint& p : chords(arc)) all.push_back(p.at_mm);
  return all;
}

double way(const std::vector<Vec2>& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += distance(line[i - 1], line[i]);
  return sum;
}

/// Twice the area swept about the centre, counterclockwise positive.
double swept(const std::vector<Vec2>& line, Vec2 center) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += cross(line[i - 1] - center, line[i] - center);
  return sum;
}

TEST(Arcs, StayWithinATenthOfATenthOfAMillimetre) {
  for (const double radius : {0.05, 0.5, 5.0, 50.0, 400.0}) {
    SCOPED_TRACE(radius);
    const Vec2 center{3, 4};
    const auto line =
        points({.from_mm = center + Vec2{radius, 0}, .to_mm = center + Vec2{0, radius}, .center_mm = center});
    ASSERT_GE(line.size(), 2u);
    for (std::size_t i = 1; i < line.size(); ++i) {
      EXPECT_NEAR(distance(line[i], center), radius, 1e-9 * (1 + radius));
      EXPECT_LE(radius - distance(lerp(line[i - 1], line[i], 0.5), center), 0.01 + 1e-9);
    }
    EXPECT_EQ(line.back(), center + (Vec2{0, radius}));
  }
}

TEST(Arcs, G3GoesLeftAndG2TheOtherWayRound) {
  const Vec2 right{10, 0}, top{0, 10}, center{0, 0};
  const auto left_round = points({.from_mm = right, .to_mm = top, .clockwise = false, .center_mm = center});
  const auto right_round = points({.from_mm = right, .to_mm = top, .clockwise = true, .center_mm = center});
  EXPECT_NEAR(way(left_round), 10 * pi / 2, 0.02);
  EXPECT_NEAR(way(right_round), 10 * 3 * pi / 2, 0.06);
  EXPECT_GT(swept(left_round, center), 0);
  EXPECT_LT(swept(right_round, center), 0);
}

TEST(Arcs, EqualEndsAreAFullCircle) {
  const auto line = points({.from_mm = {10, 0}, .to_mm = {10, 0}, .clockwise = true, .center_mm = Vec2{0, 0}});
  EXPECT_NEAR(way(line), 20 * pi, 0.08);
  EXPECT_NEAR(swept(line, {0, 0}) / 2, -100 * pi, 0.5);
}

// Both ends on a circle of radius 5 about (0, 0) and about (6, 0): chord from (3, -4) to (3, 4).
TEST(Arcs, RadiusFormTakesTheShorterArcAndWithAMinusTheLonger) {
  const Arc arc{.from_mm = {3, -4}, .to_mm = {3, 4}, .clockwise = false, .center_mm = {}, .radius_mm = 5};
  const double half = std::asin(4.0 / 5);  // of the angle of the shorter one
  EXPECT_NEAR(way(points(arc)), 5 * 2 * half, 0.02);
  for (const Vec2 p : points(arc)) EXPECT_NEAR(length(p), 5, 1e-9);  // left turn: the centre is on the left

  Arc longer = arc;
  longer.radius_mm = -5;
  EXPECT_NEAR(way(points(longer)), 5 * (2 * pi - 2 * half), 0.05);
  for (const Vec2 p : points(longer)) EXPECT_NEAR(distance(p, {6, 0}), 5, 1e-9);

  Arc clockwise = arc;
  clockwise.clockwise = true;
  EXPECT_NEAR(way(points(clockwise)), 5 * 2 * half, 0.02);
  for (const Vec2 p : points(clockwise)) EXPECT_NEAR(distance(p, {6, 0}), 5, 1e-9);
}

TEST(Arcs, SharesAscendToOne) {
  const auto all = chords({.from_mm = {10, 0}, .to_mm = {-10, 0}, .center_mm = Vec2{0, 0}});
  ASSERT_GT(all.size(), 10u);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_NEAR(all[i].share, double(i + 1) / double(all.size()), 1e-12);
}

TEST(Arcs, WithoutACircleThereAreNoChords) {
  EXPECT_TRUE(chords({.from_mm = {0, 0}, .to_mm = {10, 0}, .center_mm = {}, .radius_mm = 1}).empty());
  EXPECT_TRUE(chords({.from_mm = {0, 0}, .to_mm = {0, 0}, .center_mm = {}, .radius_mm = 1}).empty());
  EXPECT_TRUE(chords({.from_mm = {1, 1}, .to_mm = {2, 2}, .center_mm = Vec2{1, 1}}).empty());
}

TEST(Arcs, OfAFileCarryTheirFilamentAndRise) {
  const GcodePrint print = read_gcode(
      "G1 X10 Y0 Z0.2 F600\n"
      "M83\n"
      "G3 X-10 Y0 Z0.4 I-10 E3\n"
      "G1 X-20 E1\n",
      "arc.gcode");
  double filament = 0, climbed = 0.2;
  std::size_t arcs = 0;
  for (const GcodeMove& move : print.moves) {
    if (!move.arc) continue;
    ++arcs;
    filament += move.filament_mm;
    EXPECT_GT(move.to_mm.z, climbed);
    EXPECT_GE(move.to_mm.y, -1e-9);
    EXPECT_NEAR(std::hypot(move.to_mm.x, move.to_mm.y), 10, 1e-9);
    EXPECT_EQ(line_at(*print.text, move.offset), "G3 X-10 Y0 Z0.4 I-10 E3");
    climbed = move.to_mm.z;
  }
  EXPECT_GT(arcs, 30u);
  EXPECT_NEAR(filament, 3, 1e-12);
  EXPECT_EQ(climbed, 0.4);
}

TEST(Arcs, InInchesAndRelative) {
  const GcodePrint print = read_gcode(
      "G20\nG1 X1 Y1 Z0.01 F60\nG91\nM83\n"
      "G2 X1 Y0 I.5 E.1\n",  // half a circle of 1 inch to the right
      "arc.gcode");
  ASSERT_TRUE(print.moves.back().arc);
  EXPECT_NEAR(print.moves.back().to_mm.x, 50.8, 1e-9);
  EXPECT_NEAR(print.moves.back().to_mm.y, 25.4, 1e-9);
  double top = 0;
  for (const GcodeMove& move : print.moves) top = std::max(top, move.to_mm.y);
  EXPECT_NEAR(top, 25.4 * 1.5, 0.01);  // clockwise from the left: over the top
}

TEST(Arcs, FromAPlaceThatIsNotKnownDrawNoLine) {
  const GcodePrint print = read_gcode("M83\nG28\nG2 X10 Y10 I5 J5 E1\nG1 X20 Z.2 E1\n", "arc.gcode");
  EXPECT_FALSE(print.moves.front().known_start);
  EXPECT_EQ(print.moves.front().to_mm.x, 10);
  EXPECT_EQ(print.moves.size(), 2u);
}

TEST(Arcs, InOtherPlanesAreRefused) {
  EXPECT_ERROR(read_gcode("G1 X0 Y0 Z0.2\nM83\nG1 X1 E1\nG18\nG2 X2 Y2 I1 K1 E1\n", "arc.gcode"), "arc.gcode:");
}

TEST(Arcs, TooLargeOnesDoNotBlowUp) {
  std::string text = "M83\nG1 X9000 Y0 Z0.2\nG1 X8999 E1\n";
  for (int i = 0; i < 20000; ++i) text += "G2I-8999\n";
  // Either refused, or a bounded number of chords.
  std::size_t moves = 0;
  const std::string error = error_of([&] { moves = read_gcode(text, "arc.gcode").moves.size(); });
  EXPECT_TRUE(error.find("arc.gcode:") == 0 || moves < 50u * 20000) << error << moves;
}

}  // namespace
}  // namespace cleancolor
