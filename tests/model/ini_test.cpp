#include "model/ini.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "model/options.hpp"
#include "support_errors.hpp"

namespace cleancolor {
namespace {

struct Loaded {
  Config config;
  std::vector<std::string> ignored;
  std::vector<std::string> warnings;
};

Loaded load(std::string_view ini, const Config& base = {}) {
  Loaded loaded;
  Progress progress;
  progress.warn = [&](const std::string& message) { loaded.warnings.push_back(message); };
  IniResult result = with_ini(base, read_ini(ini, "a.ini"), "a.ini", progress);
  loaded.config = std::move(result.config);
  loaded.ignored = std::move(result.ignored);
  return loaded;
}

std::string fault_of(std::string_view ini) {
  return error_of([&] { load(ini); });
}

using Texts = std::vector<std::string>;

TEST(Ini, LeavesOffsetsToSailfish) {
  for (const char* flavour : {"sailfish", "makerware"}) {
    const Loaded l =
        load(std::string("nozzle_diameter = 0.4,0.4\nextruder_offset = 0x0,33x0\ngcode_flavor = ") + flavour);
    EXPECT_EQ(l.config.offsets_in, OffsetsIn::firmware);
    EXPECT_EQ(l.config.extruders[1].nozzle_offset_mm, (Vec2{33, 0}));
    EXPECT_NE(l.warnings.back().find("a.ini:2: extruder_offset: sailfish adds"), std::string::npos);
  }
  Config sailfish;
  sailfish.gcode_flavor = Flavour::sailfish;
  EXPECT_EQ(load("nozzle_diameter = 0.4,0.4\nextruder_offset = 0x0,33x0\n", sailfish).config.offsets_in,
            OffsetsIn::firmware);
}

TEST(Ini, MapsEverythingThatMattersOfThePeersBaseFile) {
  const std::string file = CLEANCOLOR_SHARED "/peers/cfg/prusa-base.ini";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
  Texts warnings;
  Progress progress;
  progress.warn = [&](const std::string& message) { warnings.push_back(message); };
  const auto [c, ignored] = with_ini_file(Config{}, file, progress);
  EXPECT_EQ(warnings, Texts{});
  EXPECT_EQ(ignored, Texts{});
  ASSERT_EQ(c.extruders.size(), 2u);
  EXPECT_EQ(c.gcode_flavor, Flavour::marlin2);
  EXPECT_EQ(c.offsets_in, OffsetsIn::slicer);
  EXPECT_EQ(c.extruders[1].nozzle_offset_mm, (Vec2{33, 0}));
  EXPECT_EQ(c.bed_shape_mm[0], (Vec2{-112.5, -72.5}));
  EXPECT_EQ(c.max_print_height_mm, 150);
  EXPECT_EQ(c.extruders[0].extruder_colour, "#0000FF");
  EXPECT_EQ(c.extruders[1].extruder_colour, "#00FF00");
  EXPECT_EQ(c.layer_height_mm, 0.3);
  EXPECT_EQ(c.first_layer_height_mm, 0.3);
  EXPECT_EQ(c.perimeters, 2);
  EXPECT_EQ(c.fill_density, 0.2);
  EXPECT_EQ(c.fill_pattern, FillPattern::rectilinear);
  EXPECT_EQ(c.top_infill_extrusion_width.of(1), 0.4);
  EXPECT_FALSE(c.gap_fill_enabled);
  EXPECT_FALSE(c.thin_walls);
  EXPECT_EQ(c.external_perimeter_speed.of(1), 30);
  EXPECT_EQ(c.travel_speed_mm_s, 120);
  EXPECT_EQ(c.extruders[1].retract_length_mm, 0.5);
  EXPECT_EQ(c.extruders[1].retract_length_toolchange_mm, 1);
  EXPECT_EQ(c.skirts, 0);
  EXPECT_FALSE(c.extruders[1].cooling);
  EXPECT_EQ(c.extruders[1].temperature_c, 230);
  EXPECT_EQ(c.extruders[1].bed_temperature_c, 110);
  EXPECT_EQ(c.extruders[1].filament_type, "ABS");
  EXPECT_EQ(c.machine_max_feedrate_mm_s, (Vec3{300, 300, 19.5}));
  EXPECT_EQ(c.machine_max_jerk_e_mm_s, 3);
  EXPECT_EQ(c.start_gcode, "G28\nG21\nG90\n");
  EXPECT_EQ(c.end_gcode, "M104 S0 T0\nM104 S0 T1\nM140 S0\nM84\n");
  EXPECT_FALSE(c.remaining_times);
}

TEST(Ini, UnderstandsTheNamesOfSlic3r) {
  const std::string file = CLEANCOLOR_SHARED "/peers/cfg/slic3r-base.ini";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
  const auto [c, ignored] = with_ini_file(Config{}, file);
  EXPECT_EQ(ignored, Texts{});
  ASSERT_EQ(c.extruders.size(), 2u);
  EXPECT_FALSE(c.gap_fill_enabled);
  EXPECT_EQ(c.top_fill_pattern, FillPattern::rectilinear);
  EXPECT_EQ(c.extruders[1].bed_temperature_c, 110);
  EXPECT_EQ(c.extruders[1].start_filament_gcode, "");
  EXPECT_EQ(c.gcode_flavor, Flavour::marlin2);
}

TEST(Ini, ListsWhatItDoesNotKnowWhereItWouldHaveChangedThePrint) {
  const Loaded l = load(
      "support_material = 1\nsupport_material_spacing = 2.5\nraft_layers = 0\nraft_expansion = 1.5\nspiral_vase = 1\n"
      "ironing = 0\nironing_speed = 15\nwipe = 1,1\nretract_before_wipe = 70%,0%\nnotes = hello\nz_offset = 0.2\n"
      "print_settings_id = mine\nwiping_volumes_matrix = 0,140,140,0\nfuture_option = 3\n");
  EXPECT_EQ(l.ignored, (Texts{"support_material = 1", "support_material_spacing = 2.5", "spiral_vase = 1", "wipe = 1,1",
                              "retract_before_wipe = 70%,0%", "z_offset = 0.2", "future_option = 3"}));
}

TEST(Ini, TakesTheNearestOfWhatWeDoNotHaveAndWarns) {
  const Loaded l = load("\nfill_pattern = honeycomb\ntop_fill_pattern = monotonic\ngcode_flavor = makerware\n");
  EXPECT_EQ(l.config.fill_pattern, FillPattern::grid);
  EXPECT_EQ(l.config.top_fill_pattern, FillPattern::rectilinear);
  EXPECT_EQ(l.config.gcode_flavor, Flavour::sailfish);
  EXPECT_EQ(l.warnings,
            (Texts{"a.ini:2: fill_pattern = honeycomb is not known here; the nearest, grid, is taken",
                   "a.ini:4: gcode_flavor = makerware is not known here; the nearest, sailfish, is taken"}));
}

TEST(Ini, KeepsOurValueWhereTheirsIsLeftToTheSlicer) {
  const Loaded l = load("perimeter_speed = 0\nresolution = 0\nfilament_retract_length = nil\n");
  EXPECT_EQ(l.config.perimeter_speed_mm_s, Config{}.perimeter_speed_mm_s);
  EXPECT_EQ(l.config.resolution_mm, 0.02);
  EXPECT_EQ(l.warnings.size(), 1u);
}

TEST(Ini, LetsTheMaterialsRetractionReplaceThePrinters) {
  const Loaded l = load("filament_retract_length = nil,3\nretract_length = 1,1\nnozzle_diameter = 0.4,0.4\n");
  EXPECT_EQ(l.config.extruders[0].retract_length_mm, 1);
  EXPECT_EQ(l.config.extruders[1].retract_length_mm, 3);
  EXPECT_EQ(l.ignored, Texts{});
}

TEST(Ini, CutsLongListsAndRepeatsTheFirstValueOfShortOnes) {
  const Loaded l = load("temperature = 200\nbed_temperature = 60,70,80\nnozzle_diameter = 0.4,0.6\n");
  ASSERT_EQ(l.config.extruders.size(), 2u);
  EXPECT_EQ(l.config.extruders[1].temperature_c, 200);
  EXPECT_EQ(l.config.extruders[1].bed_temperature_c, 70);
}

TEST(Ini, TurnsThicknessesIntoLayers) {
  const Loaded l = load(
      "top_solid_min_thickness = 0.7\ntop_solid_layers = 3\nlayer_height = 0.1\n"
      "bottom_solid_min_thickness = 0.5\nbottom_solid_layers = 0\nfirst_layer_height = 150%\n");
  EXPECT_EQ(l.config.top_solid_layers, 7);
  EXPECT_EQ(l.config.bottom_solid_layers, 0);
  EXPECT_NEAR(l.config.first_layer_height_mm, 0.15, 1e-12);
}

TEST(Ini, TakesTheLastOfRepeatedKeys) {
  EXPECT_EQ(load("perimeters = 2\nperimeters = 5\n").config.perimeters, 5);
  EXPECT_FALSE(load("gap_fill_enabled = 1\nfill_gaps = 0\n").config.gap_fill_enabled);
}

Config dual_printer() {
  Config config;
  set_extruder_count(config, 2);
  config.extruders[1].nozzle_offset_mm = {25, 0};
  config.offsets_in = OffsetsIn::firmware;
  return config;
}

TEST(Ini, KeepsThePrintersNozzleOffsetsWhereItsOwnAreZero) {
  const Loaded l = load("nozzle_diameter = 0.4,0.4\nextruder_offset = 0x0,0x0\n", dual_printer());
  EXPECT_EQ(l.config.extruders[1].nozzle_offset_mm, (Vec2{25, 0}));
  EXPECT_EQ(l.config.offsets_in, OffsetsIn::firmware);
}

TEST(Ini, TakesOffsetsThatTheSlicerSubtracts) {
  const Loaded l = load("extruder_offset = 0x0,33x1\n", dual_printer());
  EXPECT_EQ(l.config.extruders[1].nozzle_offset_mm, (Vec2{33, 1}));
  EXPECT_EQ(l.config.offsets_in, OffsetsIn::slicer);
}

TEST(Ini, ReadsOurOwnConfigurationBlockAgain) {
  Config config = dual_printer();
  config.idle_nozzle = IdleNozzle::lifted;
  config.extruders[0].start_filament_gcode = "; a;\"b\"\n";
  config.fill_pattern = FillPattern::concentric;
  for (const OffsetsIn offsets_in : {OffsetsIn::slicer, OffsetsIn::firmware}) {
    config.offsets_in = offsets_in;
    std::string gcode = "; layer_height = 99\nG1 X1\n";
    for (const auto& [key, text] : config_block(config)) gcode += "; " + key + " = " + text + "\n";
    const IniResult result = with_ini(Config{}, read_gcode_config(gcode, "a.gcode"), "a.gcode");
    EXPECT_EQ(config_block(result.config), config_block(config));
    EXPECT_EQ(result.ignored, Texts{});
  }
}

TEST(Ini, FindsTheConfigurationAtTheEndOfAGcodeFile) {
  const TestFolder folder;
  const std::string gcode =
      "; perimeters = 9\nG1 X0 Y0\n; filament used [mm] = 12.3\n\n; prusaslicer_config = begin\n; perimeters = 4\n"
      "; support_material = 0\n; prusaslicer_config = end\n";
  const auto result = with_ini_file(Config{}, folder.file("a.gcode", gcode));
  EXPECT_EQ(result.config.perimeters, 4);
  EXPECT_EQ(result.ignored, Texts{});
  EXPECT_ERROR(with_ini_file(Config{}, folder.file("b.gcode", "G1 X0\n; nothing = 1\n")), "b.gcode: no configuration");
}

TEST(Ini, RefusesWithFileAndLine) {
  EXPECT_EQ(fault_of("# a\n\nlayer_height = thick\n"), "a.ini:3: layer_height: 'thick' is not a number");
  EXPECT_EQ(fault_of("layer_height = 7"),
            "a.ini:1: layer_height: 7 is out of range; it must lie between 0.01 and 5 mm");
  EXPECT_EQ(fault_of("perimeters = 1\nnonsense\n"), "a.ini:2: expected 'option = value'");
  EXPECT_EQ(fault_of("= 3"), "a.ini:1: expected 'option = value'");
  EXPECT_EQ(fault_of("fill_pattern = spaghetti"),
            "a.ini:1: fill_pattern: 'spaghetti' is none of the possible values rectilinear, grid, gyroid, concentric");
  EXPECT_EQ(fault_of("nozzle_diameter = 1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1"),
            "a.ini:1: nozzle_diameter: 17 values; there can be at most 16 extruders");
  EXPECT_EQ(fault_of("start_filament_gcode = \"open"),
            "a.ini:1: start_filament_gcode: a quoted text does not end; quotes within it are written \\\"");
  EXPECT_EQ(fault_of(std::string_view("a = \0", 5)), "a.ini: not a text file; expected an .ini file");
}

TEST(Ini, RefusesBundlesWithTheHintToExportAConfig) {
  EXPECT_EQ(fault_of("# bundle\n[print:0.2mm]\nlayer_height = 0.2\n"),
            "a.ini:2: a bundle of several profiles; choose the profiles in PrusaSlicer and use File, Export, Export "
            "Config");
}

TEST(Ini, ThatPrusaSlicerSavesLoadsWithFewOptionsIgnored) {
  if (std::system("prusa-slicer --help > /dev/null 2>&1") != 0) GTEST_SKIP() << "prusa-slicer is not installed";
  const TestFolder folder;
  const std::string file = folder.path("full.ini");
  ASSERT_EQ(std::system(("prusa-slicer --save " + file + " > /dev/null 2>&1").c_str()), 0);
  const IniResult result = with_ini_file(Config{}, file);
  EXPECT_EQ(result.ignored, Texts{"extra_perimeters = 1"});
}

TEST(ConfigBlock, IsReadByPrusaSlicer) {
  if (std::system("prusa-slicer --help > /dev/null 2>&1") != 0) GTEST_SKIP() << "prusa-slicer is not installed";
  const TestFolder folder;
  Config config = dual_printer();
  config.offsets_in = OffsetsIn::slicer;
  config.extruders[0].start_filament_gcode = "; a;\"b\"\nG92 E0";
  config.fill_density = 0.35;
  std::string ini;
  for (const auto& [key, text] : config_block(config)) ini += key + " = " + text + "\n";
  const std::string saved = folder.path("saved.ini");
  const std::string command =
      "prusa-slicer --load " + folder.file("ours.ini", ini) + " --save " + saved + " > /dev/null 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);

  // What PrusaSlicer kept says the same to us as what we gave it.
  Config again = with_ini_file(Config{}, saved).config;
  std::map<std::string, std::string> kept;
  for (const IniEntry& entry : read_ini(file_text(saved), saved)) kept[entry.key] = entry.value;
  int compared = 0;
  for (const auto& [key, text] : config_block(config)) {
    if (!kept.contains(key) || key == "extruder_offset") continue;
    if (key == "seam_position") continue;  // it does not know hidden, and takes aligned
    EXPECT_EQ(option_text(again, key), text) << key;
    ++compared;
  }
  EXPECT_GT(compared, 100);
  EXPECT_EQ(kept["extruder_offset"], "0x0,25x0");
}

}  // namespace
}  // namespace cleancolor
