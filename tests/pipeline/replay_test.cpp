// The replay itself: what it must see in a file that breaks a rule.

#include "replay.hpp"

#include <gtest/gtest.h>

namespace cleancolor {
namespace {

using namespace test;

/// One road of 10 mm at Z 0.3, after some lines of the case's own.
std::vector<std::string> broken_after(const std::string& lines) {
  Config config;
  config.extruders.resize(1);
  const std::string text = "M104 S200 T0\nG90\nM83\n;LAYER_CHANGE\n;Z:0.3\nG1 Z.3\nG1 E-.5\nG1 X10 Y10\nG1 E.5\n";
  return replayed(text + lines + "G1 X20 E1\n", config).broken;
}

TEST(Replay, FindsNothingWrongWithAHotRoadAtItsHeight) {
  EXPECT_EQ(broken_after(""), std::vector<std::string>{});
  EXPECT_EQ(broken_after("G91\nG1 Z5\nG1 Z-5\nG90\nM83\n"), std::vector<std::string>{});
}

TEST(Replay, SeesRoadsAtAnotherHeightRoadsOfAColdNozzleAndRoadsOffTheBed) {
  for (const auto& [lines, rule] : {std::pair{"G91\nG1 Z5\nG90\nM83\n", "beside the height of its layer"},
                                    {"M104 S0 T0\n", "with its heater off"},
                                    {"G10 P0 S0 R0\n", "with its heater off"},
                                    {"G1 X-5 E1\n", "where its nozzle cannot go"}}) {
    const std::vector<std::string> broken = broken_after(lines);
    ASSERT_FALSE(broken.empty()) << rule;
    EXPECT_NE(broken.front().find(rule), std::string::npos) << broken.front();
  }
}

}  // namespace
}  // namespace cleancolor
