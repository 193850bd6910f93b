#include "toolpath/cooling.hpp"

#include <gtest/gtest.h>

#include "toolpath/regions.hpp"

namespace cleancolor {
namespace {

/// One straight 60 mm path at 60 mm/s: one second.
Layer one_second(Role role = Role::perimeter, int index = 5) {
  Path path;
  path.points = {{0, 0}, {60, 0}};
  path.stretches = {{0, {.role = role, .width_mm = 0.4, .height_mm = 0.3, .area_mm2 = 0.1, .speed_mm_s = 60}}};
  Layer layer;
  layer.index = index;
  layer.paths = {path};
  return layer;
}

double speed(const Layer& layer) {
  return layer.paths[0].road().speed_mm_s;
}

TEST(Cooling, SlowsALayerUntilItLastsLongEnough) {
  Config config = plain_config();
  config.extruders[0].slowdown_below_layer_time_s = 4;
  Layer layer = one_second();
  cool(layer, config);
  EXPECT_DOUBLE_EQ(speed(layer), 15);
}

TEST(Cooling, NeverGoesBelowTheLeastSpeed) {
  Config config = plain_config();
  config.extruders[0].slowdown_below_layer_time_s = 30;
  config.extruders[0].min_print_speed_mm_s = 10;
  Layer layer = one_second();
  cool(layer, config);
  EXPECT_DOUBLE_EQ(speed(layer), 10);
}

TEST(Cooling, LeavesLongLayersBridgesAndUncooledMaterialsAlone) {
  Config config = plain_config();
  config.extruders[0].slowdown_below_layer_time_s = 0.5;
  Layer layer = one_second();
  cool(layer, config);
  EXPECT_DOUBLE_EQ(speed(layer), 60);

  config.extruders[0].slowdown_below_layer_time_s = 10;
  Layer bridge = one_second(Role::bridge_infill);
  cool(bridge, config);
  EXPECT_DOUBLE_EQ(speed(bridge), 60);

  config.extruders[0].cooling = false;
  Layer hot = one_second();
  cool(hot, config);
  EXPECT_DOUBLE_EQ(speed(hot), 60);
}

TEST(Cooling, RunsTheFanByTheTimeOfTheLayer) {
  Config config = plain_config();
  Extruder& e = config.extruders[0];
  e.min_fan_speed_percent = 20;
  e.max_fan_speed_percent = 80;
  e.slowdown_below_layer_time_s = 0.5;
  e.fan_below_layer_time_s = 1.5;
  const auto fan = [&](Layer layer) {
    cool(layer, config);
    return layer.fan_by_extruder[0];
  };
  EXPECT_NEAR(fan(one_second()), 0.5, 1e-9);  // half way between
  e.slowdown_below_layer_time_s = 2;
  EXPECT_NEAR(fan(one_second()), 0.8, 1e-9);
  e.slowdown_below_layer_time_s = 0.1;
  e.fan_below_layer_time_s = 0.2;
  EXPECT_NEAR(fan(one_second()), 0.2, 1e-9);
  e.fan_always_on = false;
  EXPECT_NEAR(fan(one_second()), 0, 1e-9);
  e.disable_fan_first_layers = 6;
  e.fan_always_on = true;
  EXPECT_NEAR(fan(one_second()), 0, 1e-9);
}

}  // namespace
}  // namespace cleancolor
