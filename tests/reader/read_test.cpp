// G-code -> moves and events: what every command means, and that nothing is lost.
#include "reader/read.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "support_errors.hpp"

namespace cleancolor {
namespace {

// Two moves that lay plastic, so that a text of commands alone is a print, and 2 mm of filament of tool 0.
const std::string printed = "G1 X0 Y0 Z0.2 F600\nG1 X10 E1\nG1 X0 E2\n";

GcodePrint as_print(const std::string& text) {
  return read_gcode(text, "a.gcode");
}

/// Net filament of the tool.
double net_mm(const GcodePrint& print, int tool = 0) {
  double sum = 0;
  for (const GcodeMove& move : print.moves)
    if (move.feeds == tool) sum += move.filament_mm;
  return sum;
}

std::vector<GcodeEvent> events(const GcodePrint& print, GcodeEvent::Kind kind) {
  std::vector<GcodeEvent> found;
  for (const GcodeEvent& event : print.events)
    if (event.kind == kind) found.push_back(event);
  return found;
}

std::string unknown(const GcodePrint& print) {
  std::string names;
  for (const UnknownCommand& command : print.unknown)
    names += fmt::format("{} x{} from line {}; ", command.name, command.count, command.first_line);
  return names;
}

void expect_at(const GcodePrint& print, Vec3 to) {
  const Vec3 at = print.moves.back().to_mm;
  EXPECT_NEAR(at.x, to.x, 1e-9);
  EXPECT_NEAR(at.y, to.y, 1e-9);
  EXPECT_NEAR(at.z, to.z, 1e-9);
}

TEST(Reader, PositionsAreAbsoluteOrRelative) {
  expect_at(as_print(printed + "G1 X5 Y6\nG91\nG1 X1 Z1\nG1 Y-2\nG90\nG1 X3\n"), {3, 4, 1.2});
}

TEST(Reader, InchesAreInches) {
  const GcodePrint print = as_print(printed + "G20\nG1 X1 Y2 E0.5 F60\nG21\n");
  expect_at(print, {25.4, 50.8, 0.2});
  EXPECT_NEAR(print.moves.back().filament_mm, 12.7 - 2, 1e-9);
  EXPECT_NEAR(print.moves.back().speed_mm_s, 25.4, 1e-5);
}

// G92 names the place where the nozzle is; it does not move it.
TEST(Reader, G92OfAKnownPositionShiftsTheOrigin) {
  expect_at(as_print(printed + "G1 X50 Y60\nG92 X0 Y10\nG1 X1 Y11\n"), {51, 61, 0.2});
  expect_at(as_print(printed + "G1 X50 Y60\nG92\nG1 X1 Y1 Z1\n"), {51, 61, 1.2});
  expect_at(as_print(printed + "G1 X50\nG92 X0\nG92.1\nG1 X7\n"), {7, 0, 0.2});
}

// But no line is drawn from the end of the move before.
TEST(Reader, G92OfAnUnknownPositionDefinesIt) {
  const GcodePrint print = as_print(printed + "G28\nG92 X100 Y100 Z0\nG91\nG1 X10\nG1 X10\n");
  expect_at(print, {120, 100, 0});
  EXPECT_FALSE(print.moves[3].known_start);
  EXPECT_TRUE(print.moves[4].known_start);
}

TEST(Reader, HomingForgetsWhereTheNozzleIs) {
  for (const char* home : {"G28", "G28 X Y", "G29", "G162 X Y F2000", "M132 X Y Z A B"}) {
    SCOPED_TRACE(home);
    const GcodePrint print = as_print(printed + home + "\nG1 X1\nG1 Y1\nG1 X2\n");
    const auto& moves = print.moves;
    ASSERT_EQ(moves.size(), 6u);
    EXPECT_FALSE(moves[0].known_start);  // the file does not say where it begins
    EXPECT_TRUE(moves[1].known_start);
    EXPECT_FALSE(moves[3].known_start);
    EXPECT_FALSE(moves[4].known_start);  // Y was not told
    EXPECT_TRUE(moves[5].known_start);
  }
  EXPECT_TRUE(as_print(printed + "G28 Z\nG1 X1\n").moves.back().known_start);
}

TEST(Reader, EIsAbsoluteOrRelative) {
  EXPECT_NEAR(net_mm(as_print(printed + "G1 E3\nG1 E2.5\n")), 2.5, 1e-9);
  EXPECT_NEAR(net_mm(as_print(printed + "M83\nG1 E3\nG1 E-1\nM82\nG1 E10\n")), 10, 1e-9);
  EXPECT_NEAR(net_mm(as_print(printed + "G92 E0\nG1 X1 E3\nG92 E100\nG1 X2 E101\n")), 6, 1e-9);
}

// Cura's end code on Marlin: G91 makes E relative as well, G90 absolute again.
TEST(Reader, G91IsAboutEWhereTheFirmwareSaysSo) {
  EXPECT_NEAR(net_mm(as_print("M82\n" + printed + "G91\nG1 E-2 Z5\nG90\nG1 E1\n")), 1, 1e-9);
  EXPECT_NEAR(net_mm(as_print(printed + "G91\nM82\nG1 E3\n")), 3, 1e-9);                               // M82 came later
  EXPECT_NEAR(net_mm(as_print("EXCLUDE_OBJECT_START NAME=a\n" + printed + "G91\nG1 E5\n")), 5, 1e-9);  // Klipper
  for (const char* flavour : {"klipper", "reprapfirmware", "sailfish"})
    EXPECT_NEAR(net_mm(as_print(printed + "G91\nG1 E5\nG90\n; layer_height = 0.2\n; gcode_flavor = " + flavour + "\n")),
                5, 1e-9)
        << flavour;
}

TEST(Reader, G90LeavesM83InForce) {
  EXPECT_NEAR(net_mm(as_print("M83\nG1 X0 Y0 Z.2\nG1 X5 E1\nG91\nG1 Z1\nG90\nG1 X9 E1\n")), 2, 1e-9);
}

TEST(Reader, AllToolsShareOneCount) {
  const GcodePrint print = as_print(printed + "T1\nG1 X5 E5\nT0\nG1 X6 E6\n");
  EXPECT_NEAR(net_mm(print, 0), 3, 1e-9);
  EXPECT_NEAR(net_mm(print, 1), 3, 1e-9);
}

TEST(Reader, SailfishCountsForEachTool) {
  for (const char* word : {"M135", "M108"}) {
    const GcodePrint print = as_print(
        fmt::format("{}{} T1\nG1 X5 E5\n{} T0\nG1 X6 E3\nG92 E0\n{} T1\nG1 X7 E6\n", printed, word, word, word));
    EXPECT_NEAR(net_mm(print, 0), 3, 1e-9) << word;
    EXPECT_NEAR(net_mm(print, 1), 6, 1e-9) << word;
  }
}

TEST(Reader, AxesAAndBAreFilament) {
  const GcodePrint print = as_print("G92 X0 Y0 Z0 A0 B0\nG1 X1 A1\nG1 X2 B2\nG1 X3 A3 B3\nM135 T1\nG1 X4 E4\n");
  EXPECT_NEAR(net_mm(print, 0), 3, 1e-9);
  EXPECT_NEAR(net_mm(print, 1), 4, 1e-9);
  EXPECT_EQ(print.tools, 2);
}

TEST(Reader, FirmwareRetracts) {
  const GcodePrint print = as_print(printed + "G10\nG10\nG1 X5\nG11\nG11\n");
  ASSERT_EQ(print.moves.size(), 6u);  // a second G10 does nothing
  EXPECT_EQ(print.moves[3].filament_mm, -1);
  EXPECT_EQ(print.moves[5].filament_mm, 1);
  EXPECT_EQ(print.moves[3].to_mm, print.moves[2].to_mm);
  EXPECT_NEAR(net_mm(as_print(printed + "M207 S2.5\nM208 S0.1\nG10\n")), -0.5, 1e-9);
  EXPECT_NEAR(net_mm(as_print(printed + "M207 S2.5\nM208 S0.1\nG10\nG11\n")), 2.1, 1e-9);
  // Of the configuration, by tool.
  const std::string config = "; layer_height = 0.2\n; retract_length = 0.7,3\n";
  EXPECT_NEAR(net_mm(as_print(printed + "G10\n" + config)), 1.3, 1e-9);
  EXPECT_NEAR(net_mm(as_print(printed + "T1\nG10\n" + config), 1), -3, 1e-9);
}

// mm3 of a filament of 2.85 mm.
TEST(Reader, VolumetricEBecomesLength) {
  const double area = std::numbers::pi / 4 * 2.85 * 2.85;
  const GcodePrint print = as_print("M200 D2.85\nG1 X0 Y0 Z.2\nG1 X5 E10\nM200 D0\nG1 X6 E11\n");
  EXPECT_NEAR(net_mm(print), 10 / area + 1, 1e-9);
  EXPECT_NEAR(print.facts.filament_diameter_mm.front(), 2.85, 1e-9);
  EXPECT_NEAR(net_mm(as_print(";FLAVOR:UltiGCode\n" + printed)), 2 / (std::numbers::pi / 4 * 1.75 * 1.75), 1e-9);
}

TEST(Reader, VolumesComeOutAsTheFileHasThemWhateverItsHeaderSays) {
  const GcodePrint print = as_print("; filament_diameter = 1.75\nM200 D2.85\nG1 X0 Y0 Z.2\nG1 X5 E10\n");
  const double d = print.facts.filament_diameter_mm.front();
  EXPECT_NEAR(net_mm(print) * std::numbers::pi / 4 * d * d, 10, 1e-9);
}

TEST(Reader, AnOffsetOfTheFirmwareKeepsTheAxisThatIsNotNamed) {
  const GcodePrint print = as_print("M218 T1 X33\nM218 T1 Y1\n" + printed);
  EXPECT_EQ(print.facts.firmware_offset_mm, (std::vector<Vec2>{{0, 0}, {33, 1}}));
}

TEST(Reader, ToolWordsOfAllFirmwares) {
  for (const char* word : {"T1", "T1 S1", "T1 P0", "M6 T1", "M108 T1", "M135 T1",
                           "ACTIVATE_EXTRUDER EXTRUDER=extruder1", "M620 S1A\nT1\nM621 S1A"}) {
    SCOPED_TRACE(word);
    const GcodePrint print = as_print(printed + word + "\nT255\nG1 X5 E20\n");
    EXPECT_EQ(print.moves.back().tool, 1);
    EXPECT_EQ(print.tools, 2);
    const auto changes = events(print, GcodeEvent::Kind::tool_change);
    ASSERT_EQ(changes.size(), 1u);
    EXPECT_EQ(changes[0].tool, 1);
    EXPECT_EQ(changes[0].before_move, 3u);
    EXPECT_FALSE(changes[0].jumps);
    EXPECT_TRUE(print.unknown.empty()) << unknown(print);
  }
}

TEST(Reader, OnlyABareToolWordOnMarlinJumps) {
  const auto jumps = [](const std::string& word, const std::string& flavour) {
    return events(as_print(";FLAVOR:" + flavour + "\n" + printed + word + "\nG1 X5 E20\n"),
                  GcodeEvent::Kind::tool_change)
        .at(0)
        .jumps;
  };
  EXPECT_TRUE(jumps("T1", "Marlin"));
  EXPECT_TRUE(jumps("T1 ; the other one", "Marlin"));
  EXPECT_FALSE(jumps("T1 S1", "Marlin"));
  EXPECT_FALSE(jumps("M6 T1", "Marlin"));
  EXPECT_FALSE(jumps("T1", "Repetier"));
}

TEST(Reader, SpeedsAndAccelerationsHoldUntilToldAgain) {
  const GcodePrint print = as_print(
      "G1 X0 Y0 Z.2 F6000\nM83\nM204 P1000 T2000 R3000\nG1 X5 E1 F1200\nG1 X6\nG1 E-1\n"
      "M220 S50\nM204 S500\nG1 X7 E1\nSET_VELOCITY_LIMIT ACCEL=700\nG1 X8\nG1 F0 X9\n");
  const auto& m = print.moves;
  EXPECT_EQ(m[0].speed_mm_s, 100);
  EXPECT_EQ(m[0].acceleration_mm_s2, 0);  // never told
  EXPECT_EQ(m[1].speed_mm_s, 20);
  EXPECT_EQ(m[1].acceleration_mm_s2, 1000);
  EXPECT_EQ(m[2].acceleration_mm_s2, 2000);
  EXPECT_EQ(m[3].acceleration_mm_s2, 3000);
  EXPECT_EQ(m[4].speed_mm_s, 10);
  EXPECT_EQ(m[4].acceleration_mm_s2, 500);
  EXPECT_EQ(m[5].acceleration_mm_s2, 700);
  EXPECT_EQ(m[6].speed_mm_s, 10);
}

TEST(Reader, LimitsAreEvents) {
  const GcodePrint print = as_print(printed + "M201 X1000 E5000\nM203 Z12\nM205 X8 Y9\n");
  const auto acceleration = events(print, GcodeEvent::Kind::max_acceleration);
  ASSERT_EQ(acceleration.size(), 2u);
  EXPECT_EQ(acceleration[1].axis, 3);
  EXPECT_EQ(acceleration[1].value, 5000);
  EXPECT_EQ(events(print, GcodeEvent::Kind::max_speed).at(0).value, 12);
  EXPECT_EQ(events(print, GcodeEvent::Kind::max_jerk).at(1).axis, 1);
  // RepRapFirmware tells them a minute.
  const GcodePrint rrf =
      as_print(printed + "M203 X6000\nM566 X600\n; layer_height = 0.2\n; gcode_flavor = reprapfirmware\n");
  EXPECT_EQ(events(rrf, GcodeEvent::Kind::max_speed).at(0).value, 100);
  EXPECT_EQ(events(rrf, GcodeEvent::Kind::max_jerk).at(0).value, 10);
}

struct Heated {
  int tool;
  double value;
  bool waits;
  friend bool operator==(const Heated&, const Heated&) = default;
};

std::vector<Heated> heated(const std::string& commands) {
  std::vector<Heated> all;
  for (const GcodeEvent& e : events(as_print(printed + commands), GcodeEvent::Kind::target_temperature))
    all.push_back({e.tool, e.value, e.waits});
  return all;
}

TEST(Reader, TemperaturesOfAllFirmwares) {
  EXPECT_EQ(heated("M104 S200\nM109 S210 T1\nM109 R90\n"),
            (std::vector<Heated>{{0, 200, false}, {1, 210, true}, {0, 90, true}}));
  EXPECT_EQ(heated("M104 S200 T0\nM104 S210 T1\nM133 T1\nM116\n"),
            (std::vector<Heated>{{0, 200, false}, {1, 210, false}, {1, 210, true}, {0, 200, true}, {1, 210, true}}));
  EXPECT_EQ(heated("SET_HEATER_TEMPERATURE HEATER=extruder1 TARGET=180\n"), (std::vector<Heated>{{1, 180, false}}));
  EXPECT_EQ(heated("SET_HEATER_TEMPERATURE HEATER=heater_bed TARGET=60\nM140 S60\nM190 S60\n"), std::vector<Heated>{});
}

// RepRapFirmware: each tool has a temperature in use and one of standby, and changes with the tool.
TEST(Reader, StandbyTemperaturesFollowTheTool) {
  EXPECT_EQ(heated("G10 P0 S215 R150\nM568 P1 S210 R140\nT1\nG1 X1\n"),
            (std::vector<Heated>{{0, 215, false}, {1, 140, false}, {0, 150, false}, {1, 210, false}}));
}

TEST(Reader, DwellsAreSecondsOrMilliseconds) {
  const auto dwells = events(as_print(printed + "G4 S2\nG4 P250\nG4 S0\n"), GcodeEvent::Kind::dwell);
  ASSERT_EQ(dwells.size(), 2u);
  EXPECT_EQ(dwells[0].value, 2);
  EXPECT_EQ(dwells[1].value, 0.25);
  EXPECT_EQ(dwells[1].before_move, 3u);
}

TEST(Reader, OffsetsThatTheFileSetsInTheFirmware) {
  const std::vector<Vec2> expected = {{0, 0}, {33, -1}};
  EXPECT_EQ(as_print(printed + "M218 T1 X33 Y-1\n").facts.firmware_offset_mm, expected);
  EXPECT_EQ(as_print(printed + "G10 P1 X33 Y-1\n").facts.firmware_offset_mm, expected);
}

TEST(Reader, LinesGoOnWithTheCommandBefore) {
  expect_at(as_print(printed + "G1 X5\nY7 E3\nX6\n"), {6, 7, 0.2});
}

TEST(Reader, WhatItDoesNotKnowIsListedNotFatal) {
  const GcodePrint print =
      as_print("START_PRINT BED=60\n" + printed + "M9999 X1.2.3\nM106 S255\nG999\nM9999\n@pause\nM117 1..2\n");
  EXPECT_EQ(unknown(print),
            "@pause x1 from line 9; G999 x1 from line 7; M9999 x2 from line 5; START_PRINT x1 from line 1; ");
}

TEST(Reader, AnUnknownMoveLeavesAnUnknownPosition) {
  EXPECT_FALSE(as_print(printed + "G999 X50\nG1 X5\n").moves.back().known_start);
}

TEST(Reader, CodeBeforeTheFirstLabelIsTheUsers) {
  const GcodePrint print = as_print(printed + ";TYPE:External perimeter\nG1 X3 E3\n");
  EXPECT_EQ(print.moves[1].role, Role::custom);
  EXPECT_GT(print.moves[1].width_mm, 0);
  EXPECT_EQ(print.moves[3].role, Role::external_perimeter);
  EXPECT_EQ(as_print(printed).moves[1].role, Role::unknown);  // nothing is labelled
}

// Cura labels objects and roads apart from each other.
TEST(Reader, WhatBelongsToNoObjectIsNoPartOfIt) {
  const GcodePrint print =
      as_print(";MESH:a.stl\n;TYPE:WALL-OUTER\n" + printed + ";MESH:NONMESH\nG1 X9\nG1 X3 E3\n;TYPE:SKIRT\nG1 X4 E4\n");
  EXPECT_EQ(print.moves[2].role, Role::external_perimeter);
  EXPECT_EQ(print.moves[3].role, Role::external_perimeter);  // travel
  EXPECT_EQ(print.moves[4].role, Role::custom);
  EXPECT_EQ(print.moves[5].role, Role::skirt_brim);
}

TEST(Reader, RoadsOfAnUnknownTypeAreNoStartCode) {
  const GcodePrint print = as_print(";TYPE:Unknown\n" + printed + ";TYPE:External perimeter\nG1 X3 E3\n");
  EXPECT_EQ(print.moves[1].role, Role::unknown);
  EXPECT_EQ(print.moves[3].role, Role::external_perimeter);
}

TEST(Reader, LineEndsOfAllSystems) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string text = "\xEF\xBB\xBF;one\nG1 X0 Y0 Z.2 ;two\nG1 X5 E1\nG1 Xbad\n", changed;
    for (const char c : text) changed += c == '\n' ? std::string(end) : std::string(1, c);
    const std::string error = error_of([&] { as_print(changed); });
    EXPECT_TRUE(error.starts_with("a.gcode:4: X has no number")) << error;
  }
}

// All that a later stage needs to write the file back: lines between the moves, moves by their offsets.
TEST(Reader, EveryByteIsBetweenTheOffsets) {
  const std::string text =
      "; made by hand\r\nSTART_PRINT\n\nM83 (relative)\nG28\nG1 X0 Y0 Z.2 F600\nG3 X10 Y0 I5 E1\n"
      "M9999 ; nobody knows\nT1\nM104 S200 T0\n;TYPE:Custom\nG1 X20 E1 ; last\n  G10 \nG4 P5\n; end without a line end";
  const GcodePrint print = as_print(text);
  EXPECT_EQ(*print.text, text);
  std::map<std::size_t, std::string> begins;  // of every line that caused something
  for (const GcodeMove& move : print.moves) begins[move.offset] = "move";
  for (const GcodeEvent& event : print.events) begins[event.offset] = "event";
  std::string written;
  std::string caused;
  std::size_t copied = 0;
  for (const auto& [offset, what] : begins) {
    ASSERT_TRUE(offset == 0 || text[offset - 1] == '\n');
    written += text.substr(copied, offset - copied);
    const std::string_view line = line_at(text, offset);
    caused += what + ": " + std::string(line) + "\n";
    written += line;
    copied = offset + line.size();
  }
  written += text.substr(copied);
  EXPECT_EQ(written, text);
  EXPECT_EQ(caused,
            "move: G1 X0 Y0 Z.2 F600\nmove: G3 X10 Y0 I5 E1\nevent: T1\nevent: M104 S200 T0\n"
            "move: G1 X20 E1 ; last\nmove:   G10 \nevent: G4 P5\n");
}

TEST(Reader, LinesAreNumberedFromOne) {
  const std::string text = "a\nbc\r\n\nd";
  EXPECT_EQ(line_number(text, 0), 1u);
  EXPECT_EQ(line_number(text, 2), 2u);
  EXPECT_EQ(line_number(text, 4), 2u);
  EXPECT_EQ(line_number(text, 7), 4u);
  EXPECT_EQ(line_at(text, 3), "bc");
  EXPECT_EQ(line_at(text, 6), "");
  EXPECT_EQ(line_at(text, 7), "d");
}

TEST(Reader, AFileIsReadAsItsText) {
  const TestFolder folder;
  const std::string file = folder.file("a.gcode", printed);
  const GcodePrint print = read_gcode_file(file);
  EXPECT_EQ(print.name, file);
  EXPECT_EQ(*print.text, printed);
  EXPECT_EQ(print.moves.size(), 3u);
}

TEST(Reader, AMoveTakesLittleMemory) {
  EXPECT_LE(sizeof(GcodeMove), 64u);
}

}  // namespace
}  // namespace cleancolor
