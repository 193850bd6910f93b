#include "cli/command_line.hpp"

#include <gtest/gtest.h>

#include "cli/slice.hpp"
#include "support_errors.hpp"

namespace cleancolor {
namespace {

using Words = std::vector<std::string>;

SliceCommand slice_of(Words words) {
  words.insert(words.begin(), "slice");
  return std::get<SliceCommand>(parse_command_line(words));
}

std::string text_of(const Words& words) {
  return std::get<TextCommand>(parse_command_line(words)).text;
}

TEST(CommandLine, BindsExtrudersToTheFilesThatFollow) {
  const auto files = slice_of({"a.stl", "--extruder", "3", "b.stl", "c.stl", "--extruder=1", "d.stl"}).files;
  ASSERT_EQ(files.size(), 4u);
  EXPECT_EQ(files[0].path, "a.stl");
  EXPECT_EQ(files[0].extruder, std::nullopt);
  EXPECT_EQ(files[1].extruder, 2);
  EXPECT_EQ(files[2].extruder, 2);
  EXPECT_EQ(files[3].path, "d.stl");
  EXPECT_EQ(files[3].extruder, 0);
}

TEST(CommandLine, RefusesAnExtruderThatNoFileFollows) {
  const char* message = "--extruder 2: no file comes after it; it holds for the files that follow";
  EXPECT_ERROR(slice_of({"a.stl", "b.stl", "--extruder", "2"}), message);
  EXPECT_ERROR(slice_of({"a.stl", "--extruder", "2", "--extruder", "1", "b.stl"}), message);
  EXPECT_ERROR(slice_of({"a.stl", "--extruder=2", "--quiet"}), message);
  EXPECT_NO_THROW(slice_of({"--extruder", "2", "--quiet", "a.stl"}));
}

TEST(CommandLine, ReadsEveryOption) {
  const SliceCommand c =
      slice_of({"a.stl",       "--printer",    "p",         "--material", "m",         "--material", "n",
                "b.stl",       "--print",      "q",         "--load",     "l.ini",     "--set",      "x=1",
                "--set=y=2 3", "--map-colour", "#FF8000=2", "--center",   "-10,5.5",   "--rotate",   "-30",
                "--scale",     "2.5",          "--overlap", "last",       "--threads", "3",          "--quiet",
                "--json",      "--preview",    "a.png",     "-o",         "out.gcode"});
  EXPECT_EQ(c.files.size(), 2u);
  EXPECT_EQ(c.settings.printer, "p");
  EXPECT_EQ(c.settings.materials, (Words{"m", "n"}));
  EXPECT_EQ(c.settings.print, "q");
  EXPECT_EQ(c.settings.load, "l.ini");
  EXPECT_EQ(c.settings.set, (Words{"x=1", "y=2 3"}));
  EXPECT_EQ(c.extruder_of_rgb, (std::map<std::uint32_t, int>{{0xFF8000, 1}}));
  EXPECT_EQ(c.placement.center_mm, (Vec2{-10, 5.5}));
  EXPECT_EQ(c.placement.rotate_deg, -30);
  EXPECT_EQ(c.placement.scale, 2.5);
  EXPECT_EQ(c.overlap, Overlap::last);
  EXPECT_EQ(c.threads, 3);
  EXPECT_TRUE(c.quiet && c.json);
  EXPECT_EQ(c.preview, "a.png");
  EXPECT_EQ(c.output, "out.gcode");
}

TEST(CommandLine, KeepsValuesWithCommasAndSemicolonsWhole) {
  const auto set = slice_of({"a.stl", "--set", "temperature=200,210", "--set", "filament_type=PLA;ABS", "--set",
                             "start_gcode=G28 [x]"})
                       .settings.set;
  EXPECT_EQ(set, (Words{"temperature=200,210", "filament_type=PLA;ABS", "start_gcode=G28 [x]"}));
}

TEST(CommandLine, ShortFormsOfOptionsCountLessThanTheirNames) {
  const auto set_by = [](Words words) {
    words.insert(words.begin(), "a.stl");
    return slice_of(words).settings.set;
  };
  EXPECT_EQ(set_by({"--planner", "paper"}), (Words{"planner=paper"}));
  EXPECT_EQ(set_by({"--effort", "best", "--planner", "clean"}), (Words{"planner=clean", "effort=best"}));
  EXPECT_EQ(set_by({"--set", "planner=plain", "--planner", "paper"}), (Words{"planner=paper", "planner=plain"}));
  // But more than what --protect says of it.
  EXPECT_EQ(set_by({"--planner", "paper", "--protect", "rampart"}), (Words{"planner=plain", "planner=paper"}));
}

TEST(CommandLine, NamesTheOutputAfterTheFirstMesh) {
  EXPECT_EQ(slice_of({"dir/a.b.stl", "c.stl"}).output, "dir/a.b.gcode");
}

TEST(CommandLine, KeepsPlacesOfTheFilesOnRequest) {
  EXPECT_TRUE(slice_of({"a.stl", "--no-center"}).placement.keep);
  EXPECT_ERROR(slice_of({"a.stl", "--no-center", "--center", "1,1"}), "exclude each other");
}

TEST(CommandLine, RefusesWhatItDoesNotUnderstand) {
  EXPECT_ERROR(slice_of({}), "name at least one mesh file");
  EXPECT_ERROR(slice_of({"a.stl", "--perimeters", "3"}), "--perimeters");
  EXPECT_ERROR(slice_of({"a.stl", "--extruder", "0"}), "--extruder: '0' is not an extruder");
  EXPECT_ERROR(slice_of({"a.stl", "--extruder", "2x"}), "--extruder: '2x' is not an extruder");
  EXPECT_ERROR(slice_of({"a.stl", "--extruder"}), "--extruder");
  EXPECT_ERROR(slice_of({"a.stl", "--center", "1"}), "--center: '1' is not a point");
  EXPECT_ERROR(slice_of({"a.stl", "--center", "1,y"}), "--center: '1,y' is not a point");
  EXPECT_ERROR(slice_of({"a.stl", "--scale", "0"}), "--scale: 0 is not a positive factor");
  EXPECT_ERROR(slice_of({"a.stl", "--scale", "-1"}), "--scale: -1 is not a positive factor");
  EXPECT_ERROR(slice_of({"a.stl", "--rotate", "inf"}), "--rotate");
  EXPECT_ERROR(slice_of({"a.stl", "--rotate", "left"}), "--rotate");
  EXPECT_ERROR(slice_of({"a.stl", "--overlap", "both"}), "--overlap: 'both' is none of refuse, first, last");
  EXPECT_ERROR(slice_of({"a.stl", "--planner", "Paper"}), "--planner: 'Paper' is none of clean, paper, plain");
  EXPECT_ERROR(slice_of({"a.stl", "--effort", "high"}), "--effort: 'high' is none of fast, normal, best");
  EXPECT_ERROR(slice_of({"a.stl", "--effort"}), "--effort");
  EXPECT_ERROR(slice_of({"a.stl", "--threads", "-1"}), "--threads: -1 is not between 0 and 1024");
  EXPECT_ERROR(slice_of({"a.stl", "--threads", "many"}), "--threads");
  for (const char* bad : {"red=1", "#FF8000", "#FF80=1", "#GG0000=1", "#FF8000=0", "#FF8000=x", "#-12345=1", "=1"}) {
    EXPECT_ERROR(slice_of({"a.stl", "--map-colour", bad}), "--map-colour");
  }
  EXPECT_ERROR(parse_command_line({}), "see cleancolor --help");
  EXPECT_ERROR(
      parse_command_line({"print"}),
      "there is no command 'print'; known are slice, azimuth, audit, explain, replan, view, profiles, options");
  EXPECT_ERROR(parse_command_line({"profiles", "show"}), "name");
  EXPECT_ERROR(parse_command_line({"profiles", "a", "b"}), "a");
}

TEST(CommandLine, TellsExamplesAndExitCodesInHelp) {
  for (const Words& words : {Words{"--help"}, Words{"slice", "--help"}}) {
    const std::string help = text_of(words);
    EXPECT_NE(help.find("cleancolor slice ocean.stl land.stl -o globe.gcode --printer replicator-dual"), help.npos);
    EXPECT_NE(help.find("130  interrupted"), help.npos);
  }
  const std::string help = text_of({"slice", "a.stl", "-h"});
  for (const char* option : {"--extruder", "--map-colour", "--center", "--no-center", "--rotate", "--scale",
                             "--overlap", "--printer", "--material", "--print", "--load", "--planner", "--effort",
                             "--set", "--output", "--preview", "--json", "--quiet", "--threads"}) {
    EXPECT_NE(help.find(option), help.npos) << option;
  }
  EXPECT_NE(text_of({"profiles", "show", "--help"}).find("cleancolor profiles show"), std::string::npos);
  EXPECT_EQ(text_of({"--version"}).substr(0, 11), "cleancolor ");
}

TEST(SliceRequest, AsksForAPrinterWhereSeveralExtrudersAreNeeded) {
  EXPECT_NO_THROW(slice_request(slice_of({"a.stl"}), {}));
  EXPECT_ERROR(slice_request(slice_of({"a.stl", "b.stl"}), {}), "2 extruders are needed");
  EXPECT_ERROR(slice_request(slice_of({"--extruder", "3", "a.stl"}), {}), "3 extruders are needed");
  EXPECT_ERROR(slice_request(slice_of({"--extruder", "1", "a.stl", "--map-colour", "#000000=2"}), {}),
               "--printer, such as");
  EXPECT_NO_THROW(slice_request(slice_of({"--extruder", "1", "a.stl", "b.stl"}), {}));
  EXPECT_NO_THROW(slice_request(slice_of({"a.stl", "b.stl", "--printer", "replicator-dual"}), {}));
}

TEST(SliceRequest, RefusesProfilesThatServeOnlyToAudit) {
  for (const char* name : {"ultimaker-s5", "bambu-h2d", "raise3d-n2"}) {
    EXPECT_ERROR(slice_request(slice_of({"a.stl", "--printer", name}), {}), "serves only to audit and re-plan");
  }
}

TEST(SliceRequest, SaysWhichFeaturesAreNotThereYet) {
  const auto request = [](const std::string& set) { return slice_request(slice_of({"a.stl", "--set", set}), {}); };
  EXPECT_ERROR(request("support_material=1"), "--set support_material=1: supports are not there yet");
  EXPECT_ERROR(request("support_material_angle=30"), "supports are not there yet");
  EXPECT_ERROR(request("raft_layers=3"), "a raft is not there yet");
  EXPECT_ERROR(request("ironing = 1"), "ironing is not there yet");
  EXPECT_ERROR(request("spiral_vase=1"), "the spiral vase is not there yet");
  EXPECT_ERROR(request("complete_objects=1"), "one object after the other is not there yet");
  EXPECT_ERROR(request("brim_ears=1"), "a brim of ears only is not there yet");
  EXPECT_ERROR(request("arc_fitting=emit_center"), "arcs are not there yet");
  EXPECT_ERROR(request("suport=1"), "there is no option 'suport'");
}

TEST(SliceRequest, RefusesToWriteOverItsInput) {
  const TestFolder folder;
  const std::string file = folder.file("a.stl", "solid");
  EXPECT_ERROR(slice_request(slice_of({file, "-o", folder.path("./a.stl")}), {}), "input and output are the same file");
  EXPECT_ERROR(slice_request(slice_of({file, "-o", folder.path("a.gcode"), "--preview", folder.path("./a.stl")}), {}),
               "input and --preview are the same file");
  const std::string ini = folder.file("a.ini", "layer_height = 0.2\n");
  EXPECT_ERROR(slice_request(slice_of({file, "--load", ini, "-o", ini}), {}), "a.ini: input and output");
  const std::string printer = folder.file("a.toml", "inherits = \"generic\"\n");
  EXPECT_ERROR(slice_request(slice_of({file, "--printer", printer, "--preview", printer}), {}),
               "a.toml: input and --preview");
}

TEST(SliceRequest, RefusesOnePlaceForBothOutputs) {
  const TestFolder folder;
  const std::string file = folder.file("a.stl", "solid");
  EXPECT_ERROR(slice_request(slice_of({file, "-o", folder.path("new"), "--preview", folder.path("./new")}), {}),
               "output and --preview are the same file");
  EXPECT_NO_THROW(slice_request(slice_of({file, "-o", folder.path("new"), "--preview", folder.path("new.png")}), {}));
}

ViewCommand view_of(Words words) {
  words.insert(words.begin(), "view");
  return std::get<ViewCommand>(parse_command_line(words));
}

TEST(CommandLine, ViewTellsPrintsFromMeshesByTheirEndings) {
  const TestFolder folder;
  const std::string gcode = folder.file("a.GCODE", ""), mesh = folder.file("b.3mf", ""),
                    text = folder.file("c.txt", "");
  const ViewCommand c =
      view_of({gcode, "--printer", "p", mesh, "--port", "0", "--no-browser", "--nozzle-offset", "0x0,33x0"});
  EXPECT_EQ(c.prints, (std::vector<std::filesystem::path>{gcode}));
  EXPECT_EQ(c.meshes, (std::vector<std::filesystem::path>{mesh}));
  EXPECT_EQ(c.port, 0);
  EXPECT_FALSE(c.browser);
  EXPECT_EQ(c.nozzle_offset_mm.size(), 2u);
  EXPECT_EQ(view_of({}).port, std::nullopt);
  EXPECT_EQ(view_of({}).address, "127.0.0.1");
  EXPECT_ERROR(view_of({text}), "neither G-code nor a mesh");
  EXPECT_ERROR(view_of({folder.path("none.gcode")}), "there is no such file");
  EXPECT_ERROR(view_of({"--port", "65536"}), "is not a port");
}

}  // namespace
}  // namespace cleancolor
