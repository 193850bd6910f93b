#include "model/profile.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "model/validate.hpp"
#include "support_errors.hpp"

namespace cleancolor {
namespace {

Config printer(std::string_view toml) {
  return with_profile(Config{}, read_profile(OptionGroup::printer, toml, "my.toml"));
}

Config print(std::string_view toml) {
  return with_profile(Config{}, read_profile(OptionGroup::print, toml, "my.toml"));
}

std::string fault_of_printer(std::string_view toml) {
  return error_of([&] { printer(toml); });
}

std::string fault_of_print(std::string_view toml) {
  return error_of([&] { print(toml); });
}

TEST(Profile, SetsOptionsByTheirNames) {
  const Config config = printer(R"(
      description = "test"
      nozzle_diameter = [0.4, 0.6]
      nozzle_offset = [[0, 0], [33, 0.5]]
      retract_length = 2
      extruder_printable_area = [[[0, 0], [9, 0], [0, 9]], []]
      gcode_flavor = "klipper"
      use_relative_e_distances = true
      start_gcode = """
G28
M117 "hello" \\
"""
  )");
  ASSERT_EQ(config.extruders.size(), 2u);
  EXPECT_EQ(config.extruders[1].nozzle_diameter_mm, 0.6);
  EXPECT_EQ(config.extruders[1].nozzle_offset_mm, (Vec2{33, 0.5}));
  EXPECT_EQ(config.extruders[1].retract_length_mm, 2);
  EXPECT_EQ(config.extruders[0].extruder_printable_area_mm.size(), 3u);
  EXPECT_TRUE(config.extruders[1].extruder_printable_area_mm.empty());
  EXPECT_EQ(config.gcode_flavor, Flavour::klipper);
  EXPECT_TRUE(config.use_relative_e_distances);
  EXPECT_EQ(config.start_gcode, "G28\nM117 \"hello\" \\\n");
}

TEST(Profile, TakesLengthsAsNumbersAndSharesAsTexts) {
  const Config config = print("extrusion_width = 0.45\nfirst_layer_speed = \"40%\"\nfill_density = \"15%\"\n");
  EXPECT_EQ(config.extrusion_width.of(99), 0.45);
  EXPECT_EQ(config.first_layer_speed.of(100), 40);
  EXPECT_EQ(config.fill_density, 0.15);
}

TEST(Profile, RefusesWithFileAndLine) {
  EXPECT_EQ(fault_of_print("\nperimetrs = 2\n"),
            "my.toml:2: there is no option 'perimetrs'; did you mean 'perimeters'?");
  EXPECT_EQ(fault_of_print("perimeters = \"2\""), "my.toml:1: perimeters: the value must be a whole number");
  EXPECT_EQ(fault_of_print("perimeters = 2.5"), "my.toml:1: perimeters: the value must be a whole number");
  EXPECT_EQ(fault_of_print("perimeters = 9999999999999"), "my.toml:1: perimeters: the value must be a whole number");
  EXPECT_EQ(fault_of_print("\n\nlayer_height = 9"),
            "my.toml:3: layer_height: 9 is out of range; it must lie between 0.01 and 5 mm");
  EXPECT_EQ(fault_of_print("layer_height = nan"), "my.toml:1: layer_height: is not a finite number");
  EXPECT_EQ(fault_of_print("thin_walls = 1"), "my.toml:1: thin_walls: the value must be true or false");
  EXPECT_EQ(fault_of_print("fill_pattern = \"stars\"").substr(0, 37), "my.toml:1: fill_pattern: 'stars' is n");
  EXPECT_EQ(fault_of_print("fill_density = true"),
            "my.toml:1: fill_density: the value must be a number or a percentage such as \"20%\"");
  EXPECT_EQ(fault_of_print("layer_height = [0.2]"), "my.toml:1: layer_height: the value must be a number");
  EXPECT_EQ(fault_of_print("[perimeters]\nx = 1"), "my.toml:1: perimeters: the value must be a whole number");
  EXPECT_EQ(fault_of_print("bed_shape = []"),
            "my.toml:1: bed_shape is an option of the printer, not of the print; put it into a profile for --printer");
  EXPECT_EQ(fault_of_print("temperature = 200"),
            "my.toml:1: temperature is an option of the material, not of the print; put it into a profile for "
            "--material");
  EXPECT_EQ(fault_of_print("description = 7"), "my.toml:1: description: the value must be a text in quotes");
}

TEST(Profile, RefusesMalformedTomlWithFileAndLine) {
  for (const char* bad : {"\nlayer_height = ", "\nlayer_height", "\n[", "\nx = \"unterminated",
                          "\nperimeters = 1\nperimeters = 2", "\n\xff\xfe = 1", "\nx = [[[[[", "\nx = 1979-99-99"}) {
    SCOPED_TRACE(bad);
    EXPECT_EQ(fault_of_print(bad).substr(0, 8), "my.toml:");
  }
}

TEST(Profile, RefusesListsThatDoNotFitTheExtruders) {
  EXPECT_EQ(fault_of_printer("nozzle_diameter = [0.4, 0.4]\nretract_length = [1, 2, 3]"),
            "my.toml:2: retract_length: 3 values for 2 extruders (so many values has nozzle_diameter)");
  EXPECT_EQ(fault_of_printer("nozzle_diameter = []"),
            "my.toml:1: nozzle_diameter: 0 values; give one for each extruder, of which there can be 1 to 16");
  EXPECT_EQ(fault_of_printer("nozzle_offset = [[0, 0], [1]]"),
            "my.toml:1: nozzle_offset: the value must be a point [x, y]");
  EXPECT_EQ(fault_of_printer("bed_shape = [[0, 0], [1, \"2\"]]"),
            "my.toml:1: bed_shape: the value must be a list of points [[x, y], ...]");
  EXPECT_EQ(error_of([] { read_profile(OptionGroup::material, "temperature = [200, 210]", "m.toml"); }),
            "m.toml:1: temperature: a list; a material profile is about one extruder and has one value");
}

TEST(Profile, OfAMaterialConcernsOneExtruder) {
  Config config;
  set_extruder_count(config, 2);
  config = with_profile(config, read_profile(OptionGroup::material, "temperature = 251", "m.toml"), 1);
  EXPECT_NE(config.extruders[0].temperature_c, 251);
  EXPECT_EQ(config.extruders[1].temperature_c, 251);
}

TEST(Profile, InheritsFromABuiltInOneAndOverridesIt) {
  const Config config = printer("inherits = \"replicator-dual\"\nmax_print_height = 99\n");
  EXPECT_EQ(config.max_print_height_mm, 99);
  EXPECT_EQ(config.gcode_flavor, Flavour::sailfish);
  EXPECT_EQ(config.extruders.size(), 2u);
}

TEST(Profile, InheritsFromAFileBesideIt) {
  const TestFolder folder;
  folder.file("base.toml", "layer_height = 0.12\nperimeters = 5\n");
  const std::string child = folder.file("child.toml", "inherits = \"base.toml\"\nperimeters = 6\n");
  const Config config = with_profile(Config{}, find_profile(OptionGroup::print, child));
  EXPECT_EQ(config.layer_height_mm, 0.12);
  EXPECT_EQ(config.perimeters, 6);
}

TEST(Profile, RefusesCirclesAndUnknownParents) {
  const TestFolder folder;
  const std::string circle = folder.file("a.toml", "inherits = \"b.toml\"\n");
  folder.file("b.toml", "inherits = \"a.toml\"\n");
  EXPECT_ERROR(find_profile(OptionGroup::print, circle), "is it a circle?");
  EXPECT_ERROR(print("inherits = \"nothing\""),
               "my.toml:1: there is no print 'nothing'; known are draft, fine, normal");
  EXPECT_ERROR(find_profile(OptionGroup::print, folder.path("c.toml")), "c.toml: there is no such file");
}

TEST(Profile, IsListedWhereTheNameIsUnknown) {
  EXPECT_ERROR(find_profile(OptionGroup::printer, "replicator"),
               "there is no printer 'replicator'; known are bambu-h2d");
}

Config complete(const Profile& machine) {
  Config config = with_profile(Config{}, machine);
  for (std::size_t i = 0; i < config.extruders.size(); ++i) {
    config = with_profile(config, find_profile(OptionGroup::material, machine.default_material), i);
  }
  return with_profile(config, find_profile(OptionGroup::print, machine.default_print));
}

TEST(BuiltInProfiles, AreCompleteAndGoTogether) {
  std::set<std::string_view> names;
  for (const BuiltInProfile& p : builtin_profiles()) {
    SCOPED_TRACE(p.name);
    EXPECT_TRUE(names.insert(p.name).second) << "twice";
    const Profile profile = find_profile(p.group, std::string(p.name));
    EXPECT_FALSE(profile.description.empty());
    EXPECT_EQ(profile.name, p.name);
    if (p.group == OptionGroup::printer) {
      EXPECT_NO_THROW(validate(complete(profile)));
    }
  }
  EXPECT_GE(names.size(), 16u);
}

TEST(BuiltInProfiles, OfEveryPrintAndMaterialSuitEveryPrinter) {
  for (const BuiltInProfile& machine : builtin_profiles()) {
    if (machine.group != OptionGroup::printer) continue;
    const Config config = with_profile(Config{}, find_profile(machine.group, std::string(machine.name)));
    for (const BuiltInProfile& p : builtin_profiles()) {
      if (p.group == OptionGroup::printer) continue;
      SCOPED_TRACE(fmt::format("{} {}", machine.name, p.name));
      EXPECT_NO_THROW(validate(with_profile(config, find_profile(p.group, std::string(p.name)))));
    }
  }
}

TEST(BuiltInProfiles, WithoutStartCodeAreForAuditOnly) {
  for (const BuiltInProfile& p : builtin_profiles()) {
    if (p.group != OptionGroup::printer) continue;
    SCOPED_TRACE(p.name);
    const Config config = complete(find_profile(p.group, std::string(p.name)));
    EXPECT_EQ(config.audit_only, config.start_gcode.empty());
    EXPECT_EQ(config.audit_only, config.end_gcode.empty());
  }
}

TEST(BuiltInProfiles, PrintThePapersValuesOnTheReplicator) {
  const Config config = complete(find_profile(OptionGroup::printer, "replicator-dual"));
  EXPECT_EQ(config.extruders[1].nozzle_offset_mm, (Vec2{33, 0}));
  EXPECT_EQ(config.layer_height_mm, 0.3);
  EXPECT_EQ(config.perimeters, 2);
  EXPECT_EQ(config.fill_density, 0.2);
  EXPECT_EQ(config.perimeter_speed_mm_s, 30);
  EXPECT_EQ(config.infill_speed_mm_s, 60);
  EXPECT_EQ(config.travel_speed_mm_s, 120);
  EXPECT_EQ(config.extruders[0].retract_length_mm, 0.5);
  EXPECT_EQ(config.extruders[0].temperature_c, 230);
  EXPECT_EQ(config.extruders[0].bed_temperature_c, 110);
}

TEST(ProfileToml, GivesTheSameConfigAgain) {
  for (const BuiltInProfile& p : builtin_profiles()) {
    SCOPED_TRACE(p.name);
    const Config config = with_profile(Config{}, find_profile(p.group, std::string(p.name)));
    const std::string toml = profile_toml(config, p.group);
    EXPECT_EQ(config_block(with_profile(Config{}, read_profile(p.group, toml, "show.toml"))), config_block(config));
  }
}

TEST(ProfileToml, KeepsEveryCharacterOfGcode) {
  Config config;
  config.start_gcode = "\n\"\"\"a\\b\t\x01 \r\n\"\"";
  config.end_gcode = "\"\\";
  const Config again = printer(profile_toml(config, OptionGroup::printer));
  EXPECT_EQ(again.start_gcode, config.start_gcode);
  EXPECT_EQ(again.end_gcode, config.end_gcode);
}

TEST(BuiltInProfiles, AreKnownByGroupAndName) {
  EXPECT_TRUE(is_built_in(OptionGroup::printer, "replicator-dual"));
  EXPECT_TRUE(is_built_in(OptionGroup::material, "pla"));
  for (const char* name : {"", "pla", "replicator", "replicator-dual.toml", "./replicator-dual"})
    EXPECT_FALSE(is_built_in(OptionGroup::printer, name)) << name;
}

}  // namespace
}  // namespace cleancolor
