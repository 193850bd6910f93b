// Configurations of OrcaSlicer, BambuStudio and SuperSlicer in the names of PrusaSlicer.

#include <gtest/gtest.h>

#include <algorithm>

#include "model/ini.hpp"

namespace cleancolor {
namespace {

/// "" where it is not told; the last one holds.
std::string value_of(const std::vector<IniEntry>& entries, const std::string& key) {
  std::string value;
  for (const IniEntry& entry : entries)
    if (entry.key == key) value = entry.value;
  return value;
}

const std::vector<IniEntry> orca = {{"nozzle_diameter", "0.6,0.6", 1},
                                    {"layer_height", "0.25", 2},
                                    {"retraction_length", "1.5,2", 3},
                                    {"filament_retraction_length", "nil,3", 4},
                                    {"z_hop", "0.4,0.2", 5},
                                    {"outer_wall_line_width", "110%", 6},
                                    {"inner_wall_line_width", "0.62", 7},
                                    {"printable_area", "0x0,300x0,300x200,0x200", 8},
                                    {"machine_max_speed_x", "450,200", 9},
                                    {"gcode_flavor", "klipper", 10},
                                    {"wall_sequence", "outer wall/inner wall", 11},
                                    {"sparse_infill_pattern", "crosshatch", 12},
                                    {"brim_type", "auto_brim", 13},
                                    {"ironing_type", "no ironing", 14},
                                    {"filament_flow_ratio", "0.98,0.95", 15},
                                    {"bottom_shell_layers", "3", 16}};

TEST(OrcaNames, BecomeThoseOfPrusaSlicer) {
  const Config config = with_ini(Config{}, from_orca(orca), "orca.gcode").config;
  ASSERT_EQ(config.extruders.size(), 2u);
  EXPECT_DOUBLE_EQ(config.extruders[0].nozzle_diameter_mm, 0.6);
  EXPECT_DOUBLE_EQ(config.layer_height_mm, 0.25);
  EXPECT_DOUBLE_EQ(config.extruders[0].retract_lift_mm, 0.4);
  EXPECT_DOUBLE_EQ(config.extruders[1].retract_lift_mm, 0.2);
  EXPECT_DOUBLE_EQ(config.extruders[1].extrusion_multiplier, 0.95);
  EXPECT_DOUBLE_EQ(config.machine_max_feedrate_mm_s.x, 450);
  EXPECT_EQ(config.bed_shape_mm.size(), 4u);
  EXPECT_TRUE(config.external_perimeters_first);
}

TEST(OrcaNames, OfMaterialsHoldOverThoseOfThePrinter) {
  const Config config = with_ini(Config{}, from_orca(orca), "orca.gcode").config;
  EXPECT_DOUBLE_EQ(config.extruders[0].retract_length_mm, 1.5);
  EXPECT_DOUBLE_EQ(config.extruders[1].retract_length_mm, 3);
}

TEST(OrcaNames, WidthsInPercentAreOfTheNozzle) {
  const auto entries = from_orca(orca);
  EXPECT_EQ(value_of(entries, "external_perimeter_extrusion_width"), "0.66");
  EXPECT_EQ(value_of(entries, "perimeter_extrusion_width"), "0.62");
}

TEST(OrcaNames, WhatHasNoCounterpartIsLeftOut) {
  EXPECT_TRUE(std::ranges::none_of(from_orca(orca), [](const IniEntry& e) {
    return e.key == "sparse_infill_pattern" || e.key == "brim_type" || e.key == "bottom_shell_layers";
  }));
}

TEST(SuperSlicerNames, SharesOfTheNozzleBecomeLengths) {
  const auto entries = from_superslicer({{"nozzle_diameter", "0.4,0.4", 1},
                                         {"extrusion_width", "105%", 2},
                                         {"first_layer_height", "75%", 3},
                                         {"infill_speed", "80%", 4},
                                         {"external_perimeter_speed", "60%", 5},
                                         {"seam_position", "cost", 6}});
  EXPECT_EQ(value_of(entries, "extrusion_width"), "0.42");
  EXPECT_EQ(value_of(entries, "first_layer_height"), "0.3");
  EXPECT_EQ(value_of(entries, "infill_speed"), "") << "of a speed that is not known here";
  EXPECT_EQ(value_of(entries, "external_perimeter_speed"), "60%");
  EXPECT_EQ(value_of(entries, "seam_position"), "");
}

TEST(SuperSlicerNames, WhatThePrintSaysHoldsOverThePrinter) {
  const auto with = [](const char* value) {
    return from_superslicer({{"print_retract_length", value, 1}, {"retract_length", "2,2", 2}});
  };
  EXPECT_EQ(value_of(with("-1"), "retract_length"), "2,2");
  EXPECT_EQ(value_of(with("0.8"), "retract_length"), "0.8");
}

}  // namespace
}  // namespace cleancolor
