// Which layer every move belongs to, and how wide roads are.
#include "reader/layers.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <numbers>

#include "reader/read.hpp"

namespace cleancolor {
namespace {

GcodePrint read(const std::string& text) {
  return read_gcode("M83\nG1 F3000\n" + text, "layers.gcode");
}

std::vector<double> heights(const GcodePrint& print) {
  std::vector<double> z;
  for (const GcodeLayer& layer : print.layers) z.push_back(std::round(layer.z_mm * 1e4) / 1e4);
  return z;
}

/// The layer of each move, as one digit.
std::string layers(const GcodePrint& print) {
  std::string digits;
  for (const GcodeMove& move : print.moves) digits += char('0' + move.layer);
  return digits;
}

TEST(Layers, AreTheHeightsAtWhichPlasticIsLaid) {
  const GcodePrint print = read(
      "G1 X0 Y0 Z0.3\nG1 X10 E1\n"
      "G1 Z0.5\nG1 X0 E1\n"
      "G1 Z50\nG1 X90\nG1 E1\n"  // travel, and plastic that is pushed on the spot
      "G1 Z0.7\nG1 X0 E1\n");
  EXPECT_EQ(heights(print), (std::vector<double>{0.3, 0.5, 0.7}));
  EXPECT_NEAR(print.layers[0].height_mm, 0.3, 1e-9);
  EXPECT_NEAR(print.layers[1].height_mm, 0.2, 1e-9);
}

TEST(Layers, CloserThanTwoHundredthsAreOne) {
  const GcodePrint print =
      read("G1 X0 Y0 Z0.3\nG1 X10 E1\nG1 Z0.315\nG1 X0 E1\nG1 Z0.33\nG1 X10 E1\nG1 Z.6\nG1 X0 E1\n");
  EXPECT_EQ(heights(print), (std::vector<double>{0.3, 0.33, 0.6}));
}

// One object after the other: the second one's heights are those of the first.
TEST(Layers, OfSeveralObjectsAtOneHeightAreOne) {
  std::string text;
  for (const int x : {0, 100}) {
    text += fmt::format("G1 Z9\nG1 X{} Y0\n", x);
    for (int k = 1; k <= 3; ++k) text += fmt::format("G1 Z{}\nG1 X{} E1\nG1 X{} E1\n", 0.2 * k, x + 10, x);
  }
  const GcodePrint print = read(text);
  EXPECT_EQ(heights(print), (std::vector<double>{0.2, 0.4, 0.6}));
  EXPECT_EQ(print.moves.back().layer, 2u);
}

// A hop of 0.4 mm is higher than the next layer, but the plastic laid next is still that of the same layer.
TEST(Layers, HopsStayInTheirLayer) {
  const GcodePrint print = read(
      "G1 X0 Y0 Z0.2\n"  // 0
      "G1 X10 E1\n"      // 0
      "G1 Z0.6\n"        // 0: hop
      "G1 X20\n"         // 0
      "G1 Z0.2\n"        // 0
      "G1 X30 E1\n"      // 0
      "G1 E-1\n"         // 0: still there
      "G1 Z0.8\n"        // 1: hop on the way to the next layer
      "G1 X0\n"          // 1
      "G1 Z0.4\n"        // 1
      "G1 E1\n"          // 1
      "G1 X10 E1\n"      // 1
      "G1 Z9\n");        // 1: the last one
  EXPECT_EQ(layers(print), "0000000111111");
}

TEST(Layers, TravelBeforeTheLiftBelongsToTheLayerLeft) {
  const GcodePrint print = read("G1 X0 Y0 Z0.2\nG1 X10 E1\nG1 X50\nG1 Z0.4\nG1 X60\nG1 X70 E1\n");
  EXPECT_EQ(layers(print), "000111");
}

// The second object begins far below.
TEST(Layers, WayDownBelongsToTheLowerLayer) {
  const GcodePrint print = read("G1 X0 Y0 Z0.2\nG1 X10 E1\nG1 Z0.4\nG1 X0 E1\nG1 Z5\nG1 X100\nG1 Z.2\nG1 X110 E1\n");
  EXPECT_EQ(layers(print), "00110000");
}

// Ten turns of a square of 10 mm, each 0.2 mm higher, above a flat first layer: 40 rising sides.
TEST(Layers, VaseModeIsBandsOfTheUsualHeight) {
  std::string text = "G1 X0 Y0 Z0.2\nG1 X10 E1\nG1 Y10 E1\nG1 X0 E1\nG1 Y0 E1\nG1 Z0.4\nG1 X10 E1\nG1 X0 E1\n";
  for (int k = 1; k <= 40; ++k)
    text += fmt::format("G1 X{} Y{} Z{:.3f} E1\n", k % 4 == 1 || k % 4 == 2 ? 10 : 0, k % 4 == 2 || k % 4 == 3 ? 10 : 0,
                        0.4 + 0.05 * k);
  const GcodePrint print = read(text);
  std::vector<double> expected = {0.2, 0.4};
  for (int k = 1; k <= 10; ++k) expected.push_back(0.4 + 0.2 * k);
  EXPECT_EQ(heights(print).size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(print.layers[i].z_mm, expected[i], 1e-6);
  EXPECT_EQ(print.moves.back().layer, 11u);
}

// Short chords, so that most of them are level to the third decimal.
TEST(Layers, VaseModeOfShortChordsIsNoStaircase) {
  std::string text = "G1 X30 Y0 Z0.2\n";
  for (int turn = 0; turn < 5; ++turn) {
    for (int k = 1; k <= 1000; ++k) {
      const double angle = 2 * std::numbers::pi * k / 1000;
      text += fmt::format("G1 X{:.3f} Y{:.3f} Z{:.3f} E.01\n", 30 * std::cos(angle), 30 * std::sin(angle),
                          0.2 + 0.2 * (turn + k / 1000.0));
    }
  }
  const GcodePrint print = read(text);
  EXPECT_GE(print.layers.size(), 5u);
  EXPECT_LE(print.layers.size(), 6u);
}

// A wall that begins with a ramp up to its layer: no layer of its own.
TEST(Layers, ScarfSeamsBelongToTheLayerAbove) {
  const GcodePrint print = read(
      "G1 X0 Y0 Z0.2\nG1 X50 E1\nG1 Y50 E1\nG1 Z0.4\nG1 X45\n"
      "G1 Z0.25 X40\nG1 X35 Z0.3 E.1\nG1 X30 Z0.35 E.1\nG1 X25 Z0.4 E.1\nG1 X0 E1\nG1 Y0 E1\n");
  EXPECT_EQ(heights(print), (std::vector<double>{0.2, 0.4}));
  EXPECT_EQ(print.moves.back().layer, 1u);
  EXPECT_EQ(print.moves[6].layer, 1u);
}

TEST(Layers, HeightIsWhatTheFileTellsOfItsLayer) {
  const GcodePrint print = read(
      "G1 X0 Y0 Z0.2\n;HEIGHT:0.2\n;TYPE:Perimeter\nG1 X10 E1\n"
      "G1 Z0.35\n;HEIGHT:0.4\n;TYPE:Bridge infill\nG1 X0 E1\n;HEIGHT:0.15\n;TYPE:Perimeter\nG1 X10 E1\n");
  EXPECT_NEAR(print.layers[1].height_mm, 0.15, 1e-6);
  EXPECT_NEAR(print.moves[3].height_mm, 0.4, 1e-6);  // of the road
  EXPECT_NEAR(print.moves[4].height_mm, 0.15, 1e-6);
}

// Support at 0.3 between layers of the part at 0.2 and 0.4.
TEST(Layers, SupportBetweenTwoLayersDoesNotMakeThemThinner) {
  const GcodePrint print = read(
      ";TYPE:WALL-OUTER\nG1 X0 Y0 Z0.2\nG1 X10 E1\n;TYPE:SUPPORT\nG1 Z0.3\nG1 X20 E1\n;TYPE:WALL-OUTER\nG1 Z0.4\nG1 X0 "
      "E1\n");
  ASSERT_EQ(heights(print), (std::vector<double>{0.2, 0.3, 0.4}));
  EXPECT_NEAR(print.layers[2].height_mm, 0.2, 1e-9);
}

// 10 mm of a road 0.4 wide and 0.2 high: area 0.2 (0.4 - 0.2 (1 - pi/4)) = 0.07142 mm2; filament of 1.75 mm has
// 2.405 mm2.
TEST(Layers, WidthFollowsFromTheAmount) {
  const double area = 0.2 * (0.4 - 0.2 * (1 - std::numbers::pi / 4));
  const double filament = 10 * area / (std::numbers::pi / 4 * 1.75 * 1.75);
  const GcodePrint print =
      read(fmt::format("G1 X0 Y0 Z0.2\nG1 X10 E{:.9f}\nG1 X20\n;WIDTH:0.6\nG1 X30 E0.1\n", filament));
  EXPECT_NEAR(print.moves[1].width_mm, 0.4, 1e-5);
  EXPECT_EQ(print.moves[2].width_mm, 0);
  EXPECT_NEAR(print.moves[3].width_mm, 0.6, 1e-6);  // told
}

// A strand of 0.1 mm diameter over a layer of 0.3 mm: no road of negative width.
TEST(Layers, RoadsOfLittlePlasticAreRoundStrands) {
  const double filament = 10 * (0.1 * 0.1) / (1.75 * 1.75);
  const GcodePrint print = read(fmt::format("G1 X0 Y0 Z0.3\nG1 X10 E{:.9f}\n", filament));
  EXPECT_NEAR(print.moves[1].width_mm, 0.1, 1e-5);
}

TEST(Layers, AHundredThousandHeightsTakeNoTime) {
  std::string text = "G1 X0 Y0\n";
  for (int k = 1; k <= 100000; ++k) text += fmt::format("G1 Z{:.3f}\nG1 X{} E1\n", 0.03 * ((k * 7919) % 100003), k % 2);
  const std::clock_t begin = std::clock();
  const GcodePrint print = read(text);
  const double seconds = double(std::clock() - begin) / CLOCKS_PER_SEC;
  EXPECT_GT(print.layers.size(), 99000u);
  EXPECT_LT(seconds, 10);  // quadratic would be hours
}

}  // namespace
}  // namespace cleancolor
