#include "model/options.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "base/error.hpp"
#include "support_errors.hpp"

namespace cleancolor {
namespace {

Config two_extruders() {
  Config config;
  set_extruder_count(config, 2);
  return config;
}

TEST(Options, HaveNamesHelpAndDefaultsInRange) {
  std::set<std::string_view> names;
  for (const Option& option : options()) {
    SCOPED_TRACE(option.name);
    EXPECT_TRUE(names.insert(option.name).second) << "twice";
    EXPECT_FALSE(option.help.empty());
    Config config;
    EXPECT_NO_THROW(store_option(config, option, 0, option_value(config, option)));
    const bool is_number = option.kind() == OptionKind::number || option.kind() == OptionKind::integer;
    if (is_number) {
      EXPECT_LT(option.min, option.max);
    }
    EXPECT_EQ(find_option(option.name), &option);
  }
}

TEST(Options, StandBySectionSoThatHeadingsComeOnce) {
  std::set<std::string_view> seen;
  std::string_view current;
  for (const Option& option : options()) {
    if (option.section == current) continue;
    current = option.section;
    EXPECT_TRUE(seen.insert(current).second) << current;
  }
}

TEST(Options, AreSetFromPrusaSlicersText) {
  Config config = two_extruders();
  set_option(config, "layer_height", "0.25");
  set_option(config, "fill_density", "35%");
  set_option(config, "external_perimeter_speed", "50%");
  set_option(config, "first_layer_speed", "17.5");
  set_option(config, "thin_walls", "0");
  set_option(config, "gcode_flavor", "sailfish");
  set_option(config, "bed_shape", "-10x-20,10x-20,10x20,-10x20");
  set_option(config, "nozzle_offset", "0x0,33x-0.5");
  set_option(config, "machine_max_jerk_y", "7");
  set_option(config, "start_gcode", R"(G28\nM117 a\\b)");
  EXPECT_EQ(config.layer_height_mm, 0.25);
  EXPECT_EQ(config.fill_density, 0.35);
  EXPECT_TRUE(config.external_perimeter_speed.is_share);
  EXPECT_EQ(config.external_perimeter_speed.of(60), 30);
  EXPECT_EQ(config.first_layer_speed.of(60), 17.5);
  EXPECT_FALSE(config.thin_walls);
  EXPECT_EQ(config.gcode_flavor, Flavour::sailfish);
  ASSERT_EQ(config.bed_shape_mm.size(), 4u);
  EXPECT_EQ(config.bed_shape_mm[2], (Vec2{10, 20}));
  EXPECT_EQ(config.extruders[1].nozzle_offset_mm, (Vec2{33, -0.5}));
  EXPECT_EQ(config.machine_max_jerk_mm_s.y, 7);
  EXPECT_EQ(config.start_gcode, "G28\nM117 a\\b");
}

TEST(Options, TakeOneValueForAllExtrudersOrOneForEach) {
  Config config = two_extruders();
  set_option(config, "temperature", "230");
  EXPECT_EQ(config.extruders[1].temperature_c, 230);
  set_option(config, "temperature", "200,210");
  EXPECT_EQ(config.extruders[0].temperature_c, 200);
  EXPECT_EQ(config.extruders[1].temperature_c, 210);
  EXPECT_ERROR(set_option(config, "temperature", "1,2,3"), "temperature: 3 values for 2 extruders");
}

TEST(Options, GrowByTheNumberOfNozzleDiameters) {
  Config config;
  config.extruders[0].temperature_c = 222;
  set_option(config, "nozzle_diameter", "0.4,0.6,0.8");
  ASSERT_EQ(config.extruders.size(), 3u);
  EXPECT_EQ(config.extruders[2].nozzle_diameter_mm, 0.8);
  EXPECT_EQ(config.extruders[2].temperature_c, 222);
}

TEST(Options, SplitQuotedTextsAtUnquotedSemicolonsOnly) {
  Config config = two_extruders();
  set_option(config, "start_filament_gcode", R"("; a \"b\"; c\n";G92 E0)");
  EXPECT_EQ(config.extruders[0].start_filament_gcode, "; a \"b\"; c\n");
  EXPECT_EQ(config.extruders[1].start_filament_gcode, "G92 E0");
  EXPECT_ERROR(set_option(config, "start_filament_gcode", "\"never ends"), "start_filament_gcode: a quoted text");
  EXPECT_ERROR(set_option(config, "start_filament_gcode", "\"a\"b"), "start_filament_gcode: a quoted text");
}

TEST(Options, RefuseWhatCannotBeReadOrIsOutOfRangeAndSayWhere) {
  Config config = two_extruders();
  const auto where = "base.ini:3: ";
  EXPECT_ERROR(set_option(config, "perimetrs", "2", where),
               "base.ini:3: there is no option 'perimetrs'; did you mean 'perimeters'?");
  EXPECT_ERROR(set_option(config, "qqqqqqqqqq", "2", where), "base.ini:3: there is no option 'qqqqqqqqqq'");
  EXPECT_ERROR(set_option(config, "layer_height", "thick", where), "base.ini:3: layer_height: 'thick' is not a number");
  EXPECT_ERROR(set_option(config, "layer_height", "0.2mm", where), "base.ini:3: layer_height: '0.2mm' is not a number");
  EXPECT_ERROR(set_option(config, "layer_height", "", where), "base.ini:3: layer_height: '' is not a number");
  EXPECT_ERROR(set_option(config, "layer_height", "nan", where), "layer_height: 'nan' is not a number");
  EXPECT_ERROR(set_option(config, "layer_height", "9", where),
               "base.ini:3: layer_height: 9 is out of range; it must lie between 0.01 and 5 mm");
  EXPECT_ERROR(set_option(config, "perimeters", "2.5", where), "perimeters: '2.5' is not a whole number");
  EXPECT_ERROR(set_option(config, "perimeters", "99999999999", where), "perimeters: ");
  EXPECT_ERROR(set_option(config, "thin_walls", "yes", where), "thin_walls: 'yes' is neither 0 (no) nor 1 (yes)");
  EXPECT_ERROR(set_option(config, "fill_pattern", "stars", where),
               "fill_pattern: 'stars' is none of the possible values rectilinear, grid, gyroid, concentric");
  EXPECT_ERROR(set_option(config, "fill_density", "0.2", where), "fill_density: '0.2' may mean 0.2% or 20%");
  EXPECT_ERROR(set_option(config, "fill_density", "101%", where), "fill_density: 101 is out of range");
  EXPECT_ERROR(set_option(config, "extrusion_width", "2000%", where), "extrusion_width: 2000% is out of range");
  EXPECT_ERROR(set_option(config, "external_perimeter_speed", "0%", where),
               "0% is out of range; it must lie between 1%");
  EXPECT_NO_THROW(set_option(config, "extrusion_width", "0%", where));
  EXPECT_ERROR(set_option(config, "bed_shape", "0x0,5", where), "bed_shape: '0x0,5' is not a list of points");
  EXPECT_ERROR(set_option(config, "bed_shape", "0x0,5000x0,0x5", where), "bed_shape: 5000 is out of range");
  EXPECT_ERROR(set_option(config, "nozzle_offset", "0x0,33", where), "nozzle_offset: '33' is not a point");
}

TEST(Options, ReadTheirOwnTextAgain) {
  Config config = two_extruders();
  config.extruders[1].nozzle_offset_mm = {24.8, 0.6};
  config.extruders[1].extruder_printable_area_mm = {{0, 0}, {1, 0}, {0, 1}};
  config.extruders[0].extruder_colour = "#FF0000";
  config.extruders[0].start_filament_gcode = " \"quoted\"; back\\slash\nsecond; line\r\n";
  config.extruders[1].end_filament_gcode = "a;b";
  config.extruders[1].retract_length_mm = 1.0 / 3;
  config.start_gcode = "G28 ; \"home\" \\n\nG1 Z5\n";
  config.layer_height_mm = 0.1 + 0.2;
  config.fill_density = 0.07;
  config.first_layer_speed = {0.35, true};
  config.idle_nozzle = IdleNozzle::docked;
  config.machine_max_feedrate_mm_s = {1, 2.5, 3e3};
  const auto block = config_block(config);

  Config again = two_extruders();
  for (const auto& [key, text] : block) {
    SCOPED_TRACE(key);
    EXPECT_EQ(text.find('\n'), text.npos);
    if (key != "extruder_offset") set_option(again, key, text);
  }
  for (const Option& option : options()) {
    EXPECT_EQ(option_text(again, option.name), option_text(config, option.name));
  }
  EXPECT_EQ(again.extruders[0].start_filament_gcode, config.extruders[0].start_filament_gcode);
  EXPECT_EQ(again.start_gcode, config.start_gcode);
  EXPECT_EQ(again.layer_height_mm, config.layer_height_mm);
  EXPECT_EQ(again.fill_density, config.fill_density);
  EXPECT_EQ(again.extruders[1].retract_length_mm, config.extruders[1].retract_length_mm);
  EXPECT_EQ(again.extruders[1].extruder_printable_area_mm, config.extruders[1].extruder_printable_area_mm);
  EXPECT_TRUE(again.extruders[0].extruder_printable_area_mm.empty());
}

std::string block_value(const Config& config, std::string_view wanted) {
  for (const auto& [key, text] : config_block(config)) {
    if (key == wanted) return text;
  }
  return "missing";
}

TEST(ConfigBlock, SaysExtruderOffsetAsPrusaSlicerUnderstandsIt) {
  Config config = two_extruders();
  config.extruders[1].nozzle_offset_mm = {33, 0};
  config.offsets_in = OffsetsIn::slicer;
  EXPECT_EQ(block_value(config, "extruder_offset"), "0x0,33x0");
  config.offsets_in = OffsetsIn::firmware;
  EXPECT_EQ(block_value(config, "extruder_offset"), "0x0,0x0");
  EXPECT_EQ(block_value(config, "nozzle_offset"), "0x0,33x0");
}

TEST(OptionReference, InDocsIsWhatTheTableSays) {
  EXPECT_EQ(file_text(CLEANCOLOR_ROOT "/docs/options.md"), options_markdown())
      << "run: cleancolor options --markdown > docs/options.md";
}

}  // namespace
}  // namespace cleancolor
