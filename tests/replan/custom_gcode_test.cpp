// Custom G-code of PrusaSlicer's profiles: marks in the headers of layers, code of tools and filaments.

#include <gtest/gtest.h>

#include <utility>

#include "replanning.hpp"

namespace cleancolor {
namespace {

using namespace test;

/// Each line of the layers becomes what rewrite(line, layer) gives, from 1; the layers end where the configuration
/// begins.
template <class Rewrite>
std::string rewritten(const std::string& text, Rewrite rewrite) {
  std::istringstream lines(text);
  std::string result;
  int layer = 0;
  for (std::string line; std::getline(lines, line);) {
    layer += line == ";LAYER_CHANGE";
    result += layer > 0 ? rewrite(line, layer) + "\n" : line + "\n";
  }
  return result;
}

TEST(ReplanCustomGcode, MarksOfItsProfilesStandInTheHeadersOfLayers) {
  const std::string plain = fixture("prusaslicer.gcode");
  int told = 0, before = 0, after = 0;  // layers
  const std::string text = rewritten(plain, [&](const std::string& line, int layer) {
    const auto with = [&](const char* mark) {
      return line + fmt::format("\n;{}_LAYER_CHANGE\n;{:g}", mark, 0.3 * layer);
    };
    told += line == ";LAYER_CHANGE";
    if (line.starts_with(";HEIGHT:") && before < told) return ++before, with("BEFORE");
    if (line.starts_with("G1 Z") && after < told) return ++after, with("AFTER");
    return line;
  });
  const std::string out = replanned_text(text).text;
  std::istringstream lines(out);
  std::string without;
  int marks = 0;
  for (std::string line; std::getline(lines, line);) {
    const bool mark = line.starts_with(";BEFORE_LAYER_CHANGE") || line.starts_with(";AFTER_LAYER_CHANGE");
    if (mark)
      std::getline(lines, line), ++marks;
    else
      without += line + "\n";
  }
  EXPECT_EQ(marks, before + after);
  EXPECT_EQ(without, replanned_text(plain).text);
}

TEST(ReplanCustomGcode, ToolsAreDockedAndHeatedByTheFilesOwnCode) {
  int tool = 0;
  std::string text = rewritten(fixture("prusaslicer.gcode"), [&](const std::string& line, int layer) -> std::string {
    if (line != "T0" && line != "T1") return line;
    const int from = std::exchange(tool, line[1] - '0');
    return fmt::format(
        "; Change Tool{} -> Tool{} (layer {})\nG1 F21000\nP0 S1 L2 D0\n; {}\nM109 S{} T{}\nT{} S1 L0 D0\n"
        "M572 S0.036\nM142 S36\nG4 S0",
        from, tool, layer, layer, layer == 1 ? 225 : 215, tool, tool);
  });
  text = replaced(text, "\n; printer_model = \n", "\n; printer_model = XL2\n");
  const Replanned result = replanned_text(text);
  ASSERT_TRUE(result.changed);
  std::istringstream lines(result.text.substr(result.text.find(";LAYER_CHANGE")));
  std::vector<std::string> last;
  int changes = 0, layer = 0;
  for (std::string line; std::getline(lines, line); last.push_back(line)) {
    layer += line == ";LAYER_CHANGE";
    EXPECT_EQ(line.find("; Change Tool"), line.npos) << "true of one change alone";
    if (!line.starts_with("T") || !line.ends_with(" S1 L0 D0")) continue;
    ++changes;
    ASSERT_GE(last.size(), 3u);
    EXPECT_EQ(last.end()[-1], fmt::format("M109 S{} {}", layer == 1 ? 225 : 215, line.substr(0, 2)));
    EXPECT_EQ(last.end()[-2], "P0 S1 L2 D0");
    EXPECT_EQ(last.end()[-3], "G1 F21000");
  }
  EXPECT_GE(changes, 6);
  EXPECT_EQ(audit_machine(read_gcode(text, ""), {}).idle_nozzle, IdleNozzle::docked);
}

TEST(ReplanCustomGcode, AToolHeatedBeforeItIsTakenIsSoInEachLayerAsThere) {
  const std::string text = rewritten(fixture("prusaslicer.gcode"), [](const std::string& line, int layer) {
    if (line != "T0" && line != "T1") return line;
    return fmt::format("; Filament end\nM109 S{} {} ; layer {}\n{} ; layer {}", layer == 1 ? 225 : 215, line, layer,
                       line, layer);
  });
  std::istringstream lines(replanned_text(text).text);
  std::string before;
  int layer = 0, changes = 0;
  for (std::string line; std::getline(lines, line); before = line) {
    layer += line == ";LAYER_CHANGE";
    if (layer == 0 || !line.starts_with("T")) continue;
    EXPECT_EQ(before, fmt::format("M109 S{} {}", layer == 1 ? 225 : 215, line)) << layer;
    ++changes;
  }
  EXPECT_GE(changes, 6);
}

TEST(ReplanCustomGcode, WhatHoldsForAToolAloneIsToldEachTimeThatItIsTaken) {
  const std::string of_tool[] = {"M900 K0.05", "M572 S0.04", "SET_PRESSURE_ADVANCE ADVANCE=0.03", "M221 S9"};
  std::string text = fixture("prusaslicer.gcode");
  for (std::size_t at = text.find("\nT"); at != text.npos; at = text.find("\nT", at + 3)) {
    std::string lines;
    for (const std::string& line : of_tool)
      lines += "\n" + line + (line.starts_with("M221") ? text.substr(at + 2, 1) : "");
    text.insert(at + 3, lines);
  }
  for (const bool keeps_order : {false, true}) {
    std::istringstream lines(replanned_text(text, {.keeps_order = keeps_order}).text);
    std::vector<std::string> told;  // since the tool was taken
    char tool = '0';
    bool waits = false;
    int changes = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line == "T0" || line == "T1") told.clear(), tool = line[1], waits = true, ++changes;
      told.push_back(line);
      if (!waits || !line.starts_with("G1 X") || line.find(" E") == line.npos) continue;
      for (const std::string& own : of_tool)
        EXPECT_TRUE(std::ranges::count(told, own.starts_with("M221") ? own + tool : own)) << own << " of T" << tool;
      waits = false;
    }
    EXPECT_GE(changes, 6);
  }
}

TEST(ReplanCustomGcode, ATimeToWaitOrAToolPutDownElsewhereIsRefused) {
  const std::string text = fixture("prusaslicer.gcode");
  const std::size_t road = text.find(";TYPE:External perimeter");
  EXPECT_ERROR(replanned_text(with_line(text, "P0 S1 L2 D0", "G1 X", road)), "P0 S1 L2 D0");
  EXPECT_ERROR(replanned_text(with_line(text, "G4 S1", "G1 X", road)), "G4 S1");
}

}  // namespace
}  // namespace cleancolor
