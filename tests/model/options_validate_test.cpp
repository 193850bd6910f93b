#include <gtest/gtest.h>

#include "model/options.hpp"
#include "model/validate.hpp"
#include "support_errors.hpp"

namespace cleancolor {
namespace {

Config dual() {
  Config config;
  set_extruder_count(config, 2);
  config.extruders[1].nozzle_offset_mm = {25, 0};
  return config;
}

Config with(const char* name, const char* text) {
  Config config = dual();
  set_option(config, name, text);
  return config;
}

TEST(Validate, AcceptsTheDefaults) {
  EXPECT_NO_THROW(validate(Config{}));
  EXPECT_NO_THROW(validate(dual()));
}

TEST(Validate, RefusesLayersHigherThanANozzleIsWide) {
  EXPECT_ERROR(validate(with("layer_height", "0.41")), "layer_height = 0.41 is more than nozzle_diameter = 0.4");
  EXPECT_ERROR(validate(with("first_layer_height", "0.5")), "first_layer_height = 0.5");
  EXPECT_ERROR(validate(with("nozzle_diameter", "0.4,0.25")), "nozzle_diameter = 0.25 of extruder 2");
}

TEST(Validate, RefusesLinesThatAreHigherThanWideOrFarTooWide) {
  EXPECT_ERROR(validate(with("extrusion_width", "0.3")), "extrusion_width = 0.3 mm is not above the layer height");
  EXPECT_ERROR(validate(with("infill_extrusion_width", "90%")), "infill_extrusion_width = 0.27 mm");
  EXPECT_ERROR(validate(with("top_infill_extrusion_width", "1.7")), "more than 4 times");
  EXPECT_NO_THROW(validate(with("extrusion_width", "0.31")));
}

TEST(Validate, ChecksWidthsAgainstTheFirstLayerWhereItHasNoneOfItsOwn) {
  Config config = with("perimeter_extrusion_width", "0.32");
  set_option(config, "first_layer_height", "0.35");
  EXPECT_NO_THROW(validate(config));
  set_option(config, "first_layer_extrusion_width", "0");
  EXPECT_ERROR(validate(config), "perimeter_extrusion_width = 0.32 mm is not above the layer height of 0.35 mm");
  set_option(config, "perimeter_extrusion_width", "110%");
  EXPECT_NO_THROW(validate(config));
}

TEST(Validate, RefusesNozzlesThatHoverAtOnePlace) {
  EXPECT_ERROR(validate(with("nozzle_offset", "0x0")), "nozzle_offset: extruders 1 and 2 are at one place");
  EXPECT_ERROR(validate(with("nozzle_offset", "1x0,2x0")), "nozzle_offset: the first must be 0,0");
  Config docked = with("nozzle_offset", "0x0");
  docked.idle_nozzle = IdleNozzle::docked;
  EXPECT_NO_THROW(validate(docked));
}

TEST(Validate, RefusesBedsWithoutArea) {
  EXPECT_ERROR(validate(with("bed_shape", "0x0,10x0,20x0")), "bed_shape");
  EXPECT_ERROR(validate(with("bed_shape", "")), "bed_shape");
  EXPECT_ERROR(validate(with("extruder_printable_area", ";0x0,10x0")),
               "extruder_printable_area: the outline of extruder 2");
}

TEST(Validate, RefusesMoreExtrudersThanTheFirmwareDrives) {
  Config three;
  set_option(three, "nozzle_diameter", "0.4,0.4,0.4");
  set_option(three, "nozzle_offset", "0x0,20x0,40x0");
  EXPECT_NO_THROW(validate(three));
  three.gcode_flavor = Flavour::sailfish;
  EXPECT_ERROR(validate(three), "sailfish drives at most 2");
}

TEST(Validate, RefusesToSubtractOffsetsThatSailfishAddsItself) {
  Config config = with("gcode_flavor", "sailfish");
  EXPECT_NO_THROW(validate(config));
  config.offsets_in = OffsetsIn::slicer;
  EXPECT_ERROR(validate(config), "offsets_in = slicer: with gcode_flavor = sailfish the firmware adds");
}

TEST(Validate, RefusesAViewThatIsNoDirection) {
  for (const char* good : {"none", "0", "12.5", "360"}) EXPECT_NO_THROW(validate(with("view_direction", good)));
  for (const char* bad : {"", "left", "-1", "361", "nan", "90 180"})
    EXPECT_ERROR(validate(with("view_direction", bad)), "view_direction");
}

TEST(Validate, RefusesColoursAndThumbnailsThatAreNone) {
  EXPECT_NO_THROW(validate(with("filament_colour", "#00ff7F")));
  EXPECT_ERROR(validate(with("filament_colour", "red")), "filament_colour of extruder 1: 'red'");
  EXPECT_ERROR(validate(with("extruder_colour", ";#12345G")), "extruder_colour of extruder 2");
  EXPECT_NO_THROW(validate(with("thumbnails", "16x16, 220x124/PNG")));
  for (const char* bad :
       {"16", "16x", "16x16,", "0x16", "x16", "16x16x16", "99999x1", "2049x16", ",16x16", "16x16/JPG"}) {
    SCOPED_TRACE(bad);
    EXPECT_ERROR(validate(with("thumbnails", bad)), "thumbnails");
  }
}

TEST(Validate, RefusesFansThatAreLeastAboveMost) {
  EXPECT_ERROR(validate(with("max_fan_speed", "20")), "min_fan_speed = 35 is above max_fan_speed = 20");
}

}  // namespace
}  // namespace cleancolor
