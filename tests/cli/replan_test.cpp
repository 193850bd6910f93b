#include <gtest/gtest.h>

#include <algorithm>

#include "outcome.hpp"

namespace cleancolor {
namespace {

const std::string& sliced() {
  static const std::string text = file_text(std::string(CLEANCOLOR_ROOT) + "/tests/replan/files/prusaslicer.gcode");
  return text;
}

TEST(ReplanProgram, WritesAFileAndSaysWhatItTakes) {
  const TestFolder folder;
  folder.file("in.gcode", sliced());
  const Outcome done = run(folder, "replan in.gcode -o out.gcode");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find("smears "), std::string::npos) << done.out;
  EXPECT_NE(done.out.find("filament "), std::string::npos) << done.out;
  EXPECT_NE(done.out.find(" min instead of "), std::string::npos) << done.out;
  EXPECT_NE(file_text(folder.path("out.gcode")).find("; replanned by cleancolor "), std::string::npos);
  EXPECT_EQ(file_text(folder.path("in.gcode")), sliced());
}

TEST(ReplanProgram, EditsInPlaceAsAPostProcessingScriptDoes) {
  const TestFolder folder;
  folder.file("in.gcode.pp", sliced());
  const Outcome done = run(folder, "replan --post-process in.gcode.pp");
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_EQ(done.err, "");  // slicers show it
  const std::string once = file_text(folder.path("in.gcode.pp"));
  EXPECT_NE(once, sliced());
  const Outcome again = run(folder, "replan --post-process in.gcode.pp");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE(again.err.find("re-planned before"), std::string::npos) << again.err;
  EXPECT_EQ(file_text(folder.path("in.gcode.pp")), once);
}

TEST(ReplanProgram, TakesFromTheSlicersEnvironmentWhereTheNozzlesAre) {
  const TestFolder folder;
  std::string text = sliced();
  const std::string told = "; extruder_offset = 0x0,33x0\n";
  ASSERT_NE(text.find(told), text.npos);
  folder.file("in.gcode", text.erase(text.find(told), told.size()));
  const Outcome done = run(folder, "replan in.gcode --post-process", "SLIC3R_EXTRUDER_OFFSET=0x0,33x0");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.err.find("does not say"), done.err.npos) << done.err;
  EXPECT_NE(file_text(folder.path("in.gcode")), text);
}

TEST(ReplanProgram, DryRunPrintsFiguresAndWritesNothing) {
  const TestFolder folder;
  folder.file("in.gcode", sliced());
  const Outcome done = run(folder, "replan in.gcode --dry-run");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find("smear_volume"), std::string::npos) << done.out;
  EXPECT_EQ(file_text(folder.path("in.gcode")), sliced());
}

TEST(ReplanProgram, RemovesAShieldAndSaysHowMuchWent) {
  const TestFolder folder;
  folder.file("in.gcode", file_text(std::string(CLEANCOLOR_ROOT) + "/tests/replan/files/prusaslicer-shield.gcode"));
  const Outcome done = run(folder, "replan in.gcode -o out.gcode --remove-shield");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find(" mm3 of plastic are removed"), std::string::npos) << done.out;
  const Outcome kept = run(folder, "replan in.gcode -o out.gcode --remove-shield --order keep --travel keep");
  EXPECT_EQ(kept.exit_code, 2);
  EXPECT_NE(kept.err.find("--remove-shield"), std::string::npos) << kept.err;
}

TEST(ReplanProgram, RefusesOrHandsOnWhatItCannotPlan) {
  const TestFolder folder;
  std::string text = sliced();
  text.insert(text.find(";LAYER_CHANGE", text.size() / 3), "M600\n");
  folder.file("in.gcode", text);
  const Outcome refused = run(folder, "replan in.gcode -o out.gcode");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("in.gcode:"), std::string::npos) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("out.gcode")));
  const Outcome handed_on = run(folder, "replan in.gcode -o out.gcode --keep-going");
  EXPECT_EQ(handed_on.exit_code, 0);
  EXPECT_NE(handed_on.err.find("M600"), std::string::npos) << handed_on.err;
  EXPECT_EQ(file_text(folder.path("out.gcode")), text);
  EXPECT_EQ(run(folder, "replan in.gcode --post-process --keep-going").exit_code, 0);
  EXPECT_EQ(file_text(folder.path("in.gcode")), text);
}

TEST(ReplanProgram, HandsOnNothingWhereThereIsNoFile) {
  const TestFolder folder;
  for (const char* arguments :
       {"replan --post-process --keep-going missing.gcode", "replan . --keep-going -o out.gcode"}) {
    const Outcome refused = run(folder, arguments);
    EXPECT_EQ(refused.exit_code, 2) << arguments;
    EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
  }
}

TEST(ReplanProgram, RefusesFilesThatWereCutOff) {
  const TestFolder folder;
  const std::string cura = file_text(std::string(CLEANCOLOR_ROOT) + "/tests/replan/files/cura.gcode");
  const std::string options = " --nozzle-offset 0x0,33x0 --offsets-in slicer -o out.gcode";
  folder.file("line.gcode", cura.substr(0, cura.find("X", cura.size() / 2) + 2));
  folder.file("layer.gcode", cura.substr(0, cura.find("\nG1", cura.size() / 2) + 1));
  for (const char* file : {"line.gcode", "layer.gcode"}) {
    const Outcome refused = run(folder, std::string("replan ") + file + options);
    EXPECT_EQ(refused.exit_code, 2) << file << refused.out;
    EXPECT_NE(refused.err.find("cut off"), std::string::npos) << refused.err;
  }
}

TEST(ReplanProgram, HandsOnBinaryFilesWithAHint) {
  const TestFolder folder;
  const std::string binary("GCDE\1\0\0\0\1\0\0\0", 12);
  folder.file("in.gcode", binary);
  EXPECT_EQ(run(folder, "replan in.gcode -o out.gcode").exit_code, 2);
  const Outcome handed_on = run(folder, "replan in.gcode --post-process --keep-going");
  EXPECT_EQ(handed_on.exit_code, 0);
  EXPECT_NE(handed_on.err.find("binary"), std::string::npos) << handed_on.err;
  EXPECT_EQ(file_text(folder.path("in.gcode")), binary);
}

// The real slicer calls the program, once with a relative path of its output and once with an absolute one.
TEST(ReplanProgram, IsThePostProcessingScriptOfPrusaSlicer) {
  if (std::system("prusa-slicer --help > /dev/null 2>&1") != 0) GTEST_SKIP() << "prusa-slicer is not installed";
  const TestFolder folder;
  folder.file("dual.ini",
              "nozzle_diameter = 0.4,0.4\nextruder_offset = 0x0,33x0\nfilament_diameter = 1.75,1.75\n"
              "bed_shape = 0x0,225x0,225x145,0x145\nretract_length = 0.5,0.5\ntemperature = 220,220\n"
              "perimeter_extruder = 1\ninfill_extruder = 2\nsolid_infill_extruder = 2\nwipe = 0,0\n");
  const auto slice = [&](const std::string& output) {
    const std::string command = fmt::format(
        "cd '{}' && prusa-slicer --load dual.ini --center 112,72 -g -o '{}' --post-process '{} replan "
        "--post-process' {}/models/4-cones_white.stl > slicer.txt 2>&1",
        folder.path("."), output, CLEANCOLOR_PROGRAM, CLEANCOLOR_ROOT);
    EXPECT_EQ(std::system(command.c_str()), 0) << file_text(folder.path("slicer.txt"));
    return file_text(folder.path("out.gcode"));
  };
  for (const std::string& output : {std::string("out.gcode"), folder.path("out.gcode")}) {
    const std::string text = slice(output);
    EXPECT_NE(text.find("; replanned by cleancolor "), text.npos);
    EXPECT_NE(text.find(";RAMPART_WALL"), text.npos);
  }
}

TEST(ReplanProgram, TellsWhatItDoesNotUnderstand) {
  const TestFolder folder;
  folder.file("in.gcode", sliced());
  EXPECT_EQ(run(folder, "replan in.gcode").exit_code, 2);
  EXPECT_EQ(run(folder, "replan in.gcode -o out.gcode --order keep").exit_code, 2);
  EXPECT_EQ(run(folder, "replan in.gcode -o out.gcode --protect most").exit_code, 2);
  EXPECT_EQ(run(folder, "replan -o out.gcode").exit_code, 2);
  EXPECT_EQ(run(folder, "replan --help").exit_code, 0);
}

}  // namespace
}  // namespace cleancolor
