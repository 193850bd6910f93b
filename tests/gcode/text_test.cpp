#include "gcode/text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "gcode/jobs.hpp"
#include "gcode/polyline.hpp"
#include "gcode/template_codes.hpp"

using namespace cleancolor;
using namespace cleancolor::test;

namespace {

std::string fixed3(std::int64_t value) {
  char buffer[32];
  return {buffer, put_fixed<3>(buffer, value)};
}

}  // namespace

TEST(PutFixed, DropsWhatDoesNotCount) {
  EXPECT_EQ(fixed3(99999123), "99999.123");
  EXPECT_EQ(fixed3(1000), "1");
  EXPECT_EQ(fixed3(203200), "203.2");
  EXPECT_EQ(fixed3(0), "0");
  EXPECT_EQ(fixed3(-1), "-.001");
  EXPECT_EQ(fixed3(350), ".35");
  EXPECT_EQ(fixed3(-10050), "-10.05");
  EXPECT_EQ(fixed3(INT64_MIN), "-9223372036854775.808");
}

TEST(PutFixed, ReadsBackAsTheSameNumber) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 10000; ++i) {
    const auto value = std::int64_t(random() >> (20 + random() % 40)) * (random() % 2 ? 1 : -1);
    EXPECT_EQ(std::llround(std::strtod(fixed3(value).c_str(), nullptr) * 1000), value) << fixed3(value);
  }
}

TEST(Text, TextsOfAnyLengthComeOutInOrder) {
  std::string all, expected;
  Text text(to_string(all));
  for (int i = 0; i < 2000; ++i) {
    const std::string piece(std::size_t(i % 700), char('a' + i % 26));
    text.line(piece);
    expected += piece + "\n";
    EXPECT_EQ(text.offset(), expected.size());
  }
  text.put(std::string(200000, 'x'));
  text.patch(1, "Y");
  expected += std::string(200000, 'x');
  expected[1] = 'Y';
  EXPECT_EQ(all, expected);
}

TEST(LayOut, AStraightRunKeepsItsEndsOnly) {
  Path p = square(0, {0, 0}, 10);
  p.points = {{0, 0}, {3, 0.001}, {5, 0}, {10, 0}, {10, 5}, {10, 10}, {0, 10}};
  Polyline line;
  lay_out(p, 0.0125, 0, line);
  EXPECT_EQ(line.points, (std::vector<Vec2>{{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}}));
}

TEST(LayOut, NoPointIsFartherFromTheLineThanTheTolerance) {
  Path p = square(0, {0, 0}, 1);
  p.points.clear();
  for (int i = 0; i < 2000; ++i) p.points.push_back({20 * std::cos(i * M_PI / 1000), 20 * std::sin(i * M_PI / 1000)});
  Polyline line;
  lay_out(p, 0.0125, 0, line);
  EXPECT_LT(line.points.size(), 150u);
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
    EXPECT_GT(length((line.points[i] + line.points[i + 1]) * 0.5), 20 - 0.0126);
}

TEST(LayOut, ClosedPathEndsTheGapBeforeItsStart) {
  Polyline line;
  lay_out(square(0, {0, 0}, 19.6), 0.0125, 0.06, line);
  double length = 0;
  for (std::size_t i = 1; i < line.points.size(); ++i) length += distance(line.points[i - 1], line.points[i]);
  EXPECT_NEAR(length, 78.34, 1e-9);
  lay_out(square(0, {0, 0}, 0.01), 0, 0.06, line);  // a loop shorter than the gap does not vanish
  EXPECT_EQ(line.points.size(), 4u);
}

TEST(LayOut, PointsWhereAStretchBeginsStay) {
  Path p = square(0, {0, 0}, 10);
  p.closed = false;
  p.points = {{0, 0}, {4, 0}, {6, 0}, {10, 0}};
  p.stretches.push_back({1, road(Role::overhang_perimeter)});
  p.stretches.push_back({2, road(Role::external_perimeter)});
  Polyline line;
  lay_out(p, 0.0125, 0, line);
  EXPECT_EQ(line.points, p.points);
  ASSERT_EQ(line.stretches.size(), 3u);
  EXPECT_EQ(line.stretches[1].first_segment, 1u);
  EXPECT_EQ(line.stretches[2].first_segment, 2u);
}

TEST(TemplateCodes, StartCodeThatHeatsIsRecognised) {
  const FlavourWords& w = words(Flavour::marlin2);
  const auto heats = [&](const char* code, int tool) { return heats_nozzle(code, code, w, tool, 0); };
  EXPECT_FALSE(heats("G28 ; M104 S200", 0));
  EXPECT_TRUE(heats("G28\n  M104 S200", 0));
  EXPECT_FALSE(heats("M104 S200", 1));
  EXPECT_TRUE(heats("M104 S200 T1", 1));
  EXPECT_FALSE(heats("M104 S200 T1", 0));
  EXPECT_FALSE(heats("M104 S200 T11", 1));
  EXPECT_TRUE(heats("M104 S0", 1));
  // A macro heats the nozzles whose temperature it is given; the others would stay cold.
  EXPECT_TRUE(heats("START_PRINT T={first_layer_temperature[0]}", 0));
  EXPECT_FALSE(heats("START_PRINT T={first_layer_temperature[0]}", 1));
  EXPECT_TRUE(heats("START_PRINT A={first_layer_temperature[0]} B=[first_layer_temperature_1]", 1));
  EXPECT_TRUE(heats("START_PRINT T=[first_layer_temperature]", 0));
  EXPECT_FALSE(heats("START_PRINT T=[first_layer_temperature]", 1));
  EXPECT_FALSE(heats_bed("M104 S200", "M104 S200", w));
  EXPECT_TRUE(heats_bed("M190 S60", "M190 S60", w));
}

TEST(TemplateCodes, ToolWordsAreRecognised) {
  const auto selects = [](Flavour f, const char* code, int tool) { return selects_tool(code, words(f), tool); };
  EXPECT_TRUE(selects(Flavour::marlin2, "G1 X0\nT1 S1", 1));
  EXPECT_FALSE(selects(Flavour::marlin2, "T10", 1));
  EXPECT_FALSE(selects(Flavour::marlin2, "; T1", 1));
  EXPECT_TRUE(selects(Flavour::sailfish, "M135 T1", 1));
}
