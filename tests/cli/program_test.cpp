// The program as a person starts it: output, messages, exit codes, files left behind.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/command_line.hpp"
#include "model/options.hpp"
#include "outcome.hpp"

namespace cleancolor {
namespace {

// An ASCII STL of a box with two opposite corners.
std::string box(Vec3 min, Vec3 max) {
  const auto corner = [&](int i) { return Vec3{i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z}; };
  constexpr std::array<std::array<int, 3>, 12> triangles = {{{0, 2, 1},
                                                             {1, 2, 3},
                                                             {4, 5, 6},
                                                             {5, 7, 6},
                                                             {0, 1, 4},
                                                             {1, 5, 4},
                                                             {2, 6, 3},
                                                             {3, 6, 7},
                                                             {0, 4, 2},
                                                             {2, 4, 6},
                                                             {1, 3, 5},
                                                             {3, 7, 5}}};
  std::string stl = "solid box\n";
  for (const auto& triangle : triangles) {
    stl += "facet normal 0 0 0\nouter loop\n";
    for (const int i : triangle) stl += fmt::format("vertex {} {} {}\n", corner(i).x, corner(i).y, corner(i).z);
    stl += "endloop\nendfacet\n";
  }
  return stl + "endsolid box\n";
}

void put_two_boxes(const TestFolder& folder) {
  folder.file("a.stl", box({0, 0, 0}, {10, 10, 4}));
  folder.file("b.stl", box({10, 0, 0}, {20, 10, 4}));
}

TEST(Program, SlicesTwoMeshesAndPrintsATable) {
  const TestFolder folder;
  put_two_boxes(folder);
  const Outcome r = run(folder, "slice a.stl b.stl -o ab.gcode --printer replicator-dual");
  EXPECT_EQ(r.exit_code, exit_done) << r.err;
  EXPECT_EQ(r.out.substr(0, 10), "ab.gcode\nl");
  EXPECT_NE(r.out.find("tool changes"), r.out.npos);
  EXPECT_NE(file_text(folder.path("ab.gcode")).find("M108 T1"), std::string::npos);
}

TEST(Program, PrintsOneJsonObjectAndNothingElseOnRequest) {
  const TestFolder folder;
  put_two_boxes(folder);
  const Outcome r = run(folder, "slice --json --quiet a.stl b.stl --printer generic-dual-klipper");
  ASSERT_EQ(r.exit_code, exit_done) << r.err;
  const auto json = nlohmann::json::parse(r.out);
  EXPECT_EQ(json["output"], "a.gcode");
  EXPECT_EQ(json["layers"], 20);
  EXPECT_GT(json["extruders"][1]["filament_mm"], 10);
  EXPECT_EQ(r.err, "");
}

TEST(Program, WhenQuietPrintsNothing) {
  const TestFolder folder;
  put_two_boxes(folder);
  const Outcome r = run(folder, "slice --quiet a.stl");
  EXPECT_EQ(r.exit_code, exit_done);
  EXPECT_EQ(r.out + r.err, "");
  EXPECT_TRUE(std::filesystem::exists(folder.path("a.gcode")));
}

TEST(Program, LoadsTheConfigurationOfItsOwnGcode) {
  const TestFolder folder;
  put_two_boxes(folder);
  const std::string options = "--set perimeters=4 --set 'start_filament_gcode=\"; a;b\"' --set fill_density=33%";
  ASSERT_EQ(run(folder, "slice --quiet a.stl b.stl -o 1.gcode --printer generic-dual-klipper " + options).exit_code, 0);
  const Outcome r = run(folder, "slice --quiet a.stl b.stl -o 2.gcode --load 1.gcode");
  EXPECT_EQ(r.exit_code, 0);
  EXPECT_EQ(r.err, "");
  EXPECT_EQ(file_text(folder.path("1.gcode")), file_text(folder.path("2.gcode")));
}

TEST(Program, RefusesWrongInputWithCode2AMessageAndNoFile) {
  struct Case {
    const char* arguments;
    const char* message;
  };
  const Case cases[] = {
      {"", "see cleancolor --help"},
      {"slice", "name at least one mesh file"},
      {"print a.stl", "there is no command 'print'"},
      {"slice a.stl --no-such-option", "--no-such-option"},
      {"slice absent.stl", "absent.stl"},
      {"slice a.stl b.stl", "2 extruders are needed"},
      {"slice a.stl --printer nonesuch", "there is no printer 'nonesuch'; known are"},
      {"slice a.stl --printer bambu-h2d", "serves only to audit"},
      {"slice a.stl --printer bad.toml", "bad.toml:2: there is no option 'layer_hight'"},
      {"slice a.stl --material nonesuch", "there is no material 'nonesuch'"},
      {"slice a.stl --print nonesuch", "there is no print 'nonesuch'"},
      {"slice a.stl --load bad.ini", "bad.ini:1: layer_height: 'thick' is not a number"},
      {"slice a.stl --load bundle.ini", "bundle.ini:1: a bundle of several profiles"},
      {"slice a.stl --load a.stl", "a.stl:1: expected 'option = value'"},
      {"slice a.stl --load .", ".: this is not a file"},
      {"slice a.stl --set layer_height=0", "layer_height: 0 is out of range"},
      {"slice a.stl --set layer_height=0.5", "layer_height = 0.5 is more than nozzle_diameter = 0.4"},
      {"slice a.stl --set nozzle_diameter=0.4,0.4", "extruders 1 and 2 are at one place"},
      {"slice a.stl -o a.stl", "input and output are the same file"},
      {"profiles show nonesuch", "there is no profile 'nonesuch'"},
      {"profiles show absent.toml", "absent.toml: there is no such file"},
      {"options nonesuch", "no option has 'nonesuch'"},
  };
  const TestFolder folder;
  put_two_boxes(folder);
  folder.file("bad.toml", "\nlayer_hight = 0.2\n");
  folder.file("bad.ini", "layer_height = thick\n");
  folder.file("bundle.ini", "[print:a]\nlayer_height = 0.2\n");
  for (const Case& c : cases) {
    SCOPED_TRACE(c.arguments);
    const Outcome r = run(folder, c.arguments);
    EXPECT_EQ(r.exit_code, exit_wrong_input);
    EXPECT_NE(r.err.find(c.message), r.err.npos) << r.err;
    EXPECT_NE(r.err.find("cleancolor: "), r.err.npos) << r.err;
    EXPECT_EQ(r.out, "");
    EXPECT_FALSE(std::filesystem::exists(folder.path("a.gcode")));
  }
}

TEST(Program, ReportsFilesItCannotWriteWithCode3) {
  const TestFolder folder;
  put_two_boxes(folder);
  const Outcome r = run(folder, "slice a.stl -o absent/a.gcode");
  EXPECT_EQ(r.exit_code, exit_system);
  EXPECT_NE(r.err.find("absent"), r.err.npos) << r.err;
  if (std::filesystem::exists("/dev/full")) {
    EXPECT_EQ(std::system(CLEANCOLOR_PROGRAM " profiles > /dev/full 2> /dev/null") >> 8, exit_system);
  }
}

TEST(Program, InterruptedLeavesNoFileAndCode130) {
  const TestFolder folder;
  folder.file("a.stl", box({0, 0, 0}, {150, 150, 150}));
  const Outcome r = run(folder, "slice a.stl --set layer_height=0.03 --set fill_density=70%",
                        "timeout --foreground --preserve-status -s INT 0.7");
  EXPECT_EQ(r.exit_code, exit_interrupted) << r.out << r.err;
  EXPECT_NE(r.err.find("interrupted"), r.err.npos);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path("."))) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(name == "a.stl" || name == "stdout" || name == "stderr") << name;
  }
}

TEST(Program, ListsAndShowsProfiles) {
  const TestFolder folder;
  const Outcome list = run(folder, "profiles");
  EXPECT_EQ(list.exit_code, exit_done);
  for (const char* name : {"replicator-dual", "klipper-idex", "rrf-toolchanger", "ultimaker-s5", "petg", "paper"}) {
    EXPECT_NE(list.out.find(fmt::format("\n  {} ", name)), list.out.npos) << name;
  }
  put_two_boxes(folder);
  for (const char* name : {"replicator-dual", "abs", "paper"}) {
    const Outcome shown = run(folder, fmt::format("profiles show {}", name));
    EXPECT_EQ(shown.exit_code, exit_done);
    folder.file(fmt::format("{}.toml", name), shown.out);
  }
  // What is shown is a profile itself, and the same one.
  ASSERT_EQ(run(folder, "slice --quiet a.stl b.stl -o 1.gcode --printer replicator-dual").exit_code, 0);
  ASSERT_EQ(run(folder,
                "slice --quiet a.stl b.stl -o 2.gcode --printer replicator-dual.toml --material abs.toml "
                "--print paper.toml")
                .exit_code,
            0);
  EXPECT_EQ(file_text(folder.path("1.gcode")), file_text(folder.path("2.gcode")));
}

TEST(Program, ShowsProfilesOfYourOwn) {
  const TestFolder folder;
  folder.file("mine.toml", "inherits = \"fine\"\n");
  folder.file("hot.toml", "temperature = 280\n");
  EXPECT_NE(run(folder, "profiles show mine.toml").out.find("layer_height = 0.1\n"), std::string::npos);
  EXPECT_NE(run(folder, "profiles show hot.toml").out.find("temperature = 280\n"), std::string::npos);
}

TEST(Program, PrintsTheOptionReference) {
  const TestFolder folder;
  EXPECT_EQ(run(folder, "options --markdown").out, options_markdown());
  const Outcome r = run(folder, "options brim_width");
  EXPECT_NE(r.out.find("brim_width"), r.out.npos);
  EXPECT_EQ(r.out.find("layer_height"), r.out.npos);
}

TEST(Program, FindsOptionsByTheHeadingTheyStandUnder) {
  const TestFolder folder;
  for (const char* word : {"infill", "INFILL"}) {
    const Outcome r = run(folder, fmt::format("options {}", word));
    for (const char* name : {"  fill_density ", "  fill_pattern ", "  solid_infill_speed "})
      EXPECT_NE(r.out.find(name), r.out.npos) << name;
    EXPECT_EQ(r.out.find("  nozzle_offset "), r.out.npos);
  }
}

TEST(Program, ViewPrintsItsAddressAndLeavesNothingWhenItIsInterrupted) {
  const TestFolder folder;
  put_two_boxes(folder);
  // Interrupted as soon as the address is there.
  const Outcome r =
      run(folder, "view a.stl --no-browser --port 0 --printer replicator-dual",
          "sh -c '(for i in $(seq 300); do grep -qs token stdout && break; sleep 0.1; done; kill -INT $$) & "
          "TMPDIR=. exec \"$0\" \"$@\"'");
  EXPECT_EQ(r.exit_code, exit_done) << r.err;
  EXPECT_EQ(r.out.substr(0, 17), "http://127.0.0.1:");
  EXPECT_NE(r.out.find("/?token="), r.out.npos);
  EXPECT_EQ(r.err, "");
  for (const auto& entry : std::filesystem::directory_iterator(folder.path(".")))
    EXPECT_FALSE(entry.is_directory()) << entry.path();
}

}  // namespace
}  // namespace cleancolor
