#include "replan/tool_changes.hpp"

#include <gtest/gtest.h>

namespace cleancolor {
namespace {

using Lines = ToolChanges::Lines;

Lines taking(const std::string& heat) {
  return {"T1", "G92 E0", heat, "; filament start gcode"};
}

const Extruder hotter_first = [] {
  Extruder e;
  e.temperature_c = 210, e.first_layer_temperature_c = 225;
  return e;
}();

TEST(ToolChanges, AreTheSameEachTime) {
  ToolChanges changes;
  EXPECT_TRUE(changes.take_enter(1, taking("M109 S210"), false));
  EXPECT_TRUE(changes.take_enter(1, taking("M109 S210"), false));
  EXPECT_FALSE(changes.take_enter(1, taking("M109 S211"), false));
  EXPECT_FALSE(changes.take_enter(1, {"T1"}, false));
  EXPECT_TRUE(changes.take_leave(0, {"; filament end"}));
  EXPECT_FALSE(changes.take_leave(0, {}));
  EXPECT_EQ(changes.enter(1, false, hotter_first), taking("M109 S210"));
  EXPECT_EQ(*changes.leave(0), Lines{"; filament end"});
}

TEST(ToolChanges, MayBeOfAnotherTemperatureInTheFirstLayerButOfNothingElse) {
  ToolChanges changes;
  EXPECT_TRUE(changes.take_enter(1, taking("M109 S230"), true));
  EXPECT_TRUE(changes.take_enter(1, taking("M109 S200"), false));
  EXPECT_FALSE(changes.take_enter(1, taking("M109 S230"), false));
  EXPECT_EQ(changes.enter(1, true, hotter_first), taking("M109 S230"));
  EXPECT_EQ(changes.enter(1, false, hotter_first), taking("M109 S200"));

  for (const char* other : {"M106 S200", "M109 S200 T0", "M104 S200", "M109 R200"}) {
    ToolChanges again;
    EXPECT_TRUE(again.take_enter(1, taking("M109 S230"), true));
    EXPECT_FALSE(again.take_enter(1, taking(other), false)) << other;
  }
}

TEST(ToolChanges, LeaveOutWhatTellsOfOneChangeAlone) {
  ToolChanges changes;
  EXPECT_TRUE(changes.take_enter(1, {"; layer 1", "M117 layer 1", "T1", "; pick"}, false));
  EXPECT_TRUE(changes.take_enter(1, {"; layer 2", "M117 layer 2", "T1", "; pick"}, false));
  EXPECT_TRUE(changes.take_enter(1, {"; layer 3", "M117 layer 3", "T1", "; pick"}, false));
  EXPECT_EQ(changes.enter(1, false, hotter_first), (Lines{"", "", "T1", "; pick"}));
  EXPECT_FALSE(changes.take_enter(1, {"; layer 4", "M106 S1", "T1", "; pick"}, false));
  EXPECT_FALSE(changes.take_enter(1, {"; layer 4", "T1", "; pick"}, false));
}

TEST(ToolChanges, ComeForTheFirstTimeAsHotAsTheConfigurationSays) {
  ToolChanges changes;
  for (const char* heat : {"M109 S210", "M104 T1 S210 ; set temperature", "M109 S210 T1"}) {
    changes = {};
    std::string first = heat;
    changes.take_enter(1, taking(heat), false);
    EXPECT_EQ(changes.enter(1, true, hotter_first), taking(first.replace(first.find("210"), 3, "225")));
    EXPECT_EQ(changes.enter(1, false, hotter_first), taking(heat));
  }
  changes = {};
  changes.take_enter(1, taking("M109 S225"), true);
  EXPECT_EQ(changes.enter(1, false, hotter_first), taking("M109 S210"));
}

TEST(ToolChanges, OfOtherTemperaturesThanTheConfigurationsStayAsTheyAre) {
  for (const char* heat : {"M109 S190", "M109 S210 T0", "M106 S210", "M109 S2100", "; M109 S210"}) {
    ToolChanges changes;
    changes.take_enter(1, taking(heat), false);
    EXPECT_EQ(changes.enter(1, true, hotter_first), taking(heat));
  }
}

TEST(ToolChanges, OfToolsThatTheFileNeverTakesHaveNoLines) {
  EXPECT_TRUE(ToolChanges().enter(3, true, hotter_first).empty());
  EXPECT_EQ(ToolChanges().leave(3), nullptr);
}

}  // namespace
}  // namespace cleancolor
