// Files as no slicer writes them on purpose, but custom G-code, unusual settings or damage do.

#include <gtest/gtest.h>

#include <chrono>

#include "replan/heaters.hpp"
#include "replan/recovered.hpp"
#include "replanning.hpp"

namespace cleancolor {
namespace {

using namespace test;

RecoveredPrint recovered_text(const std::string& text) {
  return recovered_print(read_gcode(text, "in.gcode"));
}

TEST(ReplanRobust, AToolThatIsNoneInATowerIsRefused) {
  const std::string text = fixture("prusaslicer-tower.gcode");
  const std::size_t tower = text.find("; CP TOOLCHANGE WIPE");
  for (const char* tool : {"T-1", "T255", "T1000"}) {
    SCOPED_TRACE(tool);
    EXPECT_ERROR(recovered_text(with_line(text, tool, "G1 ", tower)), "a tool change that is not understood");
  }
}

TEST(ReplanRobust, AWipeOfNoLengthIsDrawnBackOnTheSpot) {
  const std::string text =
      replaced(fixture("prusaslicer-wipe.gcode"), "G1 X5.88 Y-.253 E3.12246", "G1 X7.4012 Y-.23 E3.12246");
  const GcodePrint print = read_gcode(replanned_text(text).text, "");
  for (const GcodeMove& move : print.moves) EXPECT_LT(std::abs(move.filament_mm), 5);
  EXPECT_NE(print.text->find(";WIPE_START"), std::string::npos);
}

/// The text with as much less (mm) pushed forward each time.
std::string with_less_pushed(const std::string& text, double less_mm) {
  std::string result;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    double e = 0;
    if (std::sscanf(line.c_str(), "G1 E%lf F1500", &e) == 1 && e > 0)
      line = fmt::format("G1 E{:.5f} F1500", e - less_mm);
    result += line + "\n";
  }
  return result;
}

TEST(ReplanRobust, LessPushedForwardThanWasDrawnBackIsRefused) {
  const std::string text = fixture("prusaslicer-tower.gcode");
  EXPECT_ERROR(recovered_text(with_less_pushed(text, 0.1)), "retract_restart_extra");
}

TEST(ReplanRobust, WhatRoundingLeavesDrawnBackDoesNotAddUp) {
  const std::string text = with_less_pushed(fixture("prusaslicer-tower.gcode"), 0.001);
  const std::int64_t sound = recovered_text(fixture("prusaslicer-tower.gcode")).end_drawn_back_e5;
  EXPECT_NEAR(double(recovered_text(text).end_drawn_back_e5), double(sound), 200);
}

TEST(ReplanRobust, WhatStartCodeLeavesDrawnBackIsNotPushedForward) {
  const std::string bar = fixture("prusaslicer.gcode");
  const RecoveredPrint sound = recovered_text(bar);
  const RecoveredPrint other = recovered_text(with_line(bar, "G92 E0\nG1 E-2 F1500\nG92 E0", ";LAYER_CHANGE"));
  EXPECT_EQ(other.begin_drawn_back_e5, sound.begin_drawn_back_e5);
  EXPECT_EQ(other.end_drawn_back_e5, sound.end_drawn_back_e5);
}

TEST(ReplanRobust, ProgressOfAnotherModeIsNotTakenForThatOfThisOne) {
  const std::string bar = fixture("prusaslicer.gcode");
  const std::size_t layers = bar.find(";LAYER_CHANGE");
  const std::string both = with_line(with_line(bar, "M73 P50 R3", ";TYPE:", layers), "M73 Q50 S4", "M73 P50");
  EXPECT_EQ(recovered_text(both).progress_line, "M73 P50 R3");
  EXPECT_EQ(recovered_text(with_line(bar, "M73 Q50 S4", ";TYPE:", layers)).progress_line, "");
}

/// Line is put behind that which begins so.
std::string with_line_behind(std::string text, const std::string& line, const std::string& behind) {
  return text.insert(text.find('\n', text.find(behind)) + 1, line + "\n");
}

TEST(ReplanRobust, ATemperatureOfAToolThatPrintsNothingStays) {
  const std::string bar = fixture("cura.gcode");
  const MachineRequest apart{.nozzle_offset_mm = {{0, 0}, {33, 0}}};
  for (const char* line : {"M104 T2 S0", "M109 T2 S60"}) {
    SCOPED_TRACE(line);
    const std::string out = replanned_text(with_line_behind(bar, line, ";LAYER:2"), {}, {}, apart).text;
    EXPECT_NE(out.find(fmt::format(";LAYER:2\n{}\n", line)), out.npos);
    EXPECT_ERROR(recovered_text(with_line_behind(bar, line, "G1 F1800")), "cannot be moved");
  }
}

TEST(ReplanRobust, StatesThatAreEqualAreKeptOnce) {
  for (const char* name : {"prusaslicer", "prusaslicer-tower", "cura"}) {
    SCOPED_TRACE(name);
    const RecoveredPrint print = recovered_text(fixture(fmt::format("{}.gcode", name)));
    for (std::size_t i = 0; i < print.states.size(); ++i)
      EXPECT_EQ(std::ranges::count(print.states, print.states[i]), 1) << i;
  }
}

TEST(ReplanRobust, MoreFansThanAnyPrinterHasAreRefused) {
  std::string fans;
  for (int fan = 0; fan < 70; ++fan) fans += fmt::format("M106 P{} S9\n", fan);
  const std::string bar = fixture("prusaslicer.gcode");
  EXPECT_ERROR(recovered_text(with_line(bar, fans, "G1 ", bar.find(";LAYER_CHANGE"))), "M106 P6");
  EXPECT_ERROR(recovered_text(with_line(bar, fans, "G28")), "M106 P6");
}

TEST(ReplanRobust, PiecesOfATowerThatLayNothingAreReadInOneGo) {
  const std::string text = fixture("prusaslicer-tower.gcode");
  std::string pieces;
  for (int i = 0; i < 100'000; ++i) pieces += fmt::format(";TYPE:Wipe tower\nG1 X{} Y0\n", i % 2);
  const GcodePrint print =
      read_gcode(with_line(text, pieces + ";TYPE:Perimeter", "G1 E", text.find(";TYPE:Perimeter")), "in.gcode");
  const auto begin = std::chrono::steady_clock::now();
  error_of([&] { recovered_print(print); });
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
}

TEST(ReplanRobust, AWipeAfterLaterRoadsIsNoneOfTheTower) {
  const std::string text = fixture("prusaslicer-tower.gcode");
  const std::size_t tower = text.find(";TYPE:Wipe tower"), perimeter = text.find(";TYPE:Perimeter", tower);
  const RecoveredPrint print =
      recovered_text(with_line(text, ";WIPE_START\n;WIPE_END", "G1 E-.5", text.find(" E", perimeter)));
  int pieces = 0;
  for (const RecoveredLayer& layer : print.layers)
    for (const RecoveredRun& run : layer.runs) {
      if (!run.fixed) continue;
      ++pieces;
      EXPECT_EQ(std::ranges::find(run.fixed->lines, ";TYPE:Perimeter"), run.fixed->lines.end());
    }
  EXPECT_GT(pieces, 5);
}

TEST(ReplanRobust, TemperaturesOfManyChangesAreReadInOneGo) {
  std::string text = ";FLAVOR:Marlin\n;Generated with Cura_SteamEngine 4.13.0\nT0\nM104 T0 S200\nM104 T1 S200\nM83\n";
  text += ";LAYER_COUNT:1\n;LAYER:0\nG1 F1200 X0 Y0 Z0.3\n;TYPE:WALL-OUTER\n";
  for (int i = 0; i < 100'000; ++i)
    text += fmt::format("G1 X{} E0.1\nT{}\nM104 T{} S150\n", (i + 1) % 2, (i + 1) % 2, i % 2);
  text += "G1 X0 E0.1\n";
  const GcodePrint print = read_gcode(text, "in.gcode");
  const AuditMachine machine = audit_machine(print, {.nozzle_offset_mm = {{0, 0}, {33, 0}}});
  RecoveredPrint layers;
  layers.begin = text.find(";LAYER:0"), layers.end = text.size();
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_NE(with_heaters(layers, print, print, machine, ";LAYER:").size(), 0u);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
}

}  // namespace
}  // namespace cleancolor
