#include "model/settings.hpp"

#include <gtest/gtest.h>

#include "model/options.hpp"
#include "model/profile.hpp"
#include "support_errors.hpp"

namespace cleancolor {
namespace {

// layer_height, top_solid_layers, ... each set by one more of the steps: the last one to speak wins.
TEST(Settings, HoldInTheOrderDefaultsPrinterMaterialPrintLoadSet) {
  const TestFolder folder;
  Settings s;
  s.printer = folder.file("p.toml", "max_print_height = 111\nretract_length = 3\nstart_gcode = \"printer\"\n");
  s.materials = {folder.file("m.toml", "temperature = 222\nbed_temperature = 77\n")};
  s.print = folder.file("q.toml", "perimeters = 7\nskirts = 5\nlayer_height = 0.22\n");
  s.load = folder.file("l.ini", "skirts = 6\nlayer_height = 0.24\nbed_temperature = 88\nretract_length = 4\n");
  s.set = {"layer_height=0.26", "start_gcode = set"};
  const Config c = config_of(s);
  EXPECT_EQ(c.first_layer_height_mm, Config{}.first_layer_height_mm);
  EXPECT_EQ(c.max_print_height_mm, 111);
  EXPECT_EQ(c.extruders[0].temperature_c, 222);
  EXPECT_EQ(c.perimeters, 7);
  EXPECT_EQ(c.skirts, 6);
  EXPECT_EQ(c.extruders[0].bed_temperature_c, 88);
  EXPECT_EQ(c.extruders[0].retract_length_mm, 4);
  EXPECT_EQ(c.layer_height_mm, 0.26);
  EXPECT_EQ(c.start_gcode, "set");
}

TEST(Settings, TakeThePrintersMaterialAndPrintWhereNoneIsNamed) {
  const Config c = config_of({.printer = "replicator-dual"});
  EXPECT_EQ(c.extruders[1].filament_type, "ABS");
  EXPECT_EQ(c.layer_height_mm, 0.3);
  EXPECT_EQ(config_of({.printer = "replicator-dual", .materials = {"pla"}}).extruders[1].filament_type, "PLA");
}

TEST(Settings, AreThoseOfAPrinterThatWasReadBeforeAsOfOneThatIsNamed) {
  const Profile printer = find_profile(OptionGroup::printer, "replicator-dual");
  for (Settings s : {Settings{}, Settings{.materials = {"pla", "petg"}}, Settings{.print = "fine"},
                     Settings{.set = {"layer_height=0.15"}}}) {
    const Config read = config_of(printer, s);
    s.printer = "replicator-dual";
    const Config named = config_of(s);
    for (const Option& option : options())
      EXPECT_EQ(option_text(read, option.name), option_text(named, option.name)) << option.name;
  }
}

TEST(Settings, TakeTheGenericPrinterWhereNoneIsNamed) {
  const Config c = config_of({});
  EXPECT_EQ(c.extruders.size(), 1u);
  EXPECT_EQ(c.layer_height_mm, 0.2);
}

TEST(Settings, DoNotMixAPrintersDefaultsIntoALoadedFile) {
  const TestFolder folder;
  const Config c = config_of({.printer = "replicator-dual", .load = folder.file("l.ini", "perimeters = 4\n")});
  EXPECT_EQ(c.perimeters, 4);
  EXPECT_EQ(c.top_solid_layers, Config{}.top_solid_layers);
  EXPECT_EQ(c.extruders[1].filament_type, Config{}.extruders[0].filament_type);
}

TEST(Settings, GiveEachExtruderItsMaterialAndTheLastToTheRest) {
  const Config c = config_of({.printer = "rrf-toolchanger", .materials = {"pla", "pva"}});
  ASSERT_EQ(c.extruders.size(), 4u);
  EXPECT_EQ(c.extruders[0].filament_type, "PLA");
  EXPECT_EQ(c.extruders[1].filament_type, "PVA");
  EXPECT_EQ(c.extruders[3].filament_type, "PVA");
  EXPECT_ERROR(config_of({.materials = {"pla", "pva"}}), "--material: 2 materials, but the printer has 1 extruder");
}

TEST(Settings, AskForAPrinterWhereALoadedFileHidesItsNozzles) {
  const TestFolder folder;
  Settings s{.load = folder.file("l.ini", "nozzle_diameter = 0.4,0.4\nextruder_offset = 0x0,0x0\n")};
  EXPECT_ERROR(config_of(s), "nozzle_offset: extruders 1 and 2 are at one place; choose a --printer");
  s.set = {"nozzle_offset=0x0,20x0"};
  EXPECT_EQ(config_of(s).extruders[1].nozzle_offset_mm, (Vec2{20, 0}));
  s.set = {};
  s.printer = "replicator-dual";
  EXPECT_EQ(config_of(s).extruders[1].nozzle_offset_mm, (Vec2{33, 0}));
}

TEST(Settings, WarnOfIgnoredOptionsInOneLine) {
  const TestFolder folder;
  std::vector<std::string> warnings;
  Progress progress;
  progress.warn = [&](const std::string& message) { warnings.push_back(message); };
  const std::string file = folder.file("l.ini", "support_material = 1\nspiral_vase = 1\n");
  config_of({.load = file}, progress);
  EXPECT_EQ(warnings, std::vector<std::string>{file + ": 2 options are not known here and without effect: "
                                                      "support_material = 1, spiral_vase = 1"});
}

TEST(Settings, SayWhichSetIsWrong) {
  EXPECT_ERROR(config_of({.set = {"layer_height"}}), "--set layer_height: expected name=value");
  EXPECT_ERROR(config_of({.set = {"layer_hight=0.2"}}),
               "--set there is no option 'layer_hight'; did you mean 'layer_height'?");
  EXPECT_ERROR(config_of({.set = {"layer_height=9"}}), "--set layer_height: 9 is out of range");
}

}  // namespace
}  // namespace cleancolor
