#include "audit/offset_guess.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "audit/machine.hpp"
#include "reader/read.hpp"
#include "support_errors.hpp"

namespace cleancolor {
namespace {

constexpr double square_mm = 2, line_mm = 0.4;

/// Lines of tool `tool` in the squares of a drawing that have its digit.
std::string lines_of(const std::string& drawing, int tool, Vec2 shift_mm) {
  std::string text = fmt::format("T{}\n", tool);
  std::istringstream rows(drawing);
  int y = 0;
  for (std::string row; std::getline(rows, row); ++y) {
    std::erase(row, ' ');
    for (std::size_t x = 0; x < row.size(); ++x) {
      if (row[x] != char('0' + tool)) continue;
      std::size_t end = x;
      while (end < row.size() && row[end] == row[x]) ++end;
      for (double at = line_mm / 2; at < square_mm; at += line_mm) {
        const double gy = -(y * square_mm + at) + shift_mm.y;
        text += fmt::format("G1 X{} Y{}\nG1 X{} Y{} E1\n", double(x) * square_mm + line_mm / 2 + shift_mm.x, gy,
                            double(end) * square_mm - line_mm / 2 + shift_mm.x, gy);
      }
      x = end;
    }
  }
  return text;
}

/// Layers of 0.3 mm. The numbers of tool i in the file are its place minus offsets[i].
GcodePrint print_of(const std::vector<std::string>& layers, const std::vector<Vec2>& offsets_mm,
                    const std::string& type = "Solid infill") {
  std::string text = "M83\nG1 F6000\n";
  double z = 0;
  for (const std::string& layer : layers) {
    text += fmt::format("G1 Z{}\n;TYPE:{}\n", z += 0.3, type);
    for (std::size_t tool = 0; tool < offsets_mm.size(); ++tool)
      text += lines_of(layer, int(tool), offsets_mm[tool] * -1);
  }
  return read_gcode(text, "a.gcode");
}

// Fits in one place only.
const std::string jigsaw = R"(
  0 0 0 0 0 0 0
  0 0 1 1 1 0 0
  0 0 1 1 1 1 1
  0 0 0 0 1 1 0
  0 0 0 0 0 0 0 )";

// As 4 cones: the colours meet nowhere.
const std::string apart = R"(
  0 0 . . 1 1
  0 0 . . 1 1
  . . . . . .
  1 1 . . 0 0
  1 1 . . 0 0 )";

const std::vector<Vec2> apart_offsets = {{0, 0}, {33, 0}};

TEST(OffsetFit, CountsCellsBesideAndOver) {
  // One line of 10 mm each, 41 cells of 0.25 mm along it: beside each other 0.5 mm apart, then the one over the other.
  const std::string lines = "M83\nG1 Z0.3 F6000\nG1 X0 Y0\nG1 X10 Y0 E1\nT1\nG1 X0 Y20.5\nG1 X10 Y20.5 E1\n";
  const GcodePrint print = read_gcode(lines, "a.gcode");
  EXPECT_EQ(offset_fit(print, {{0, 0}, {0, -20}}).touching, 1);
  EXPECT_EQ(offset_fit(print, {{0, 0}, {0, -20}}).overlapping, 0);
  EXPECT_EQ(offset_fit(print, {{0, 0}, {0, -20.5}}).overlapping, 1);
  EXPECT_EQ(offset_fit(print, {{0, 0}, {0, -20.5}}).together, 1);
  EXPECT_EQ(offset_fit(print, {}).touching, 0);
  // Half of the line lies beside, and two cells more at its end.
  EXPECT_NEAR(offset_fit(print, {{0, 0}, {5, -20}}).touching, 21. / 41, 2.01 / 41);
}

TEST(OffsetFit, AuxiliaryPlasticDoesNotCount) {
  const GcodePrint print = print_of({jigsaw}, apart_offsets, "Wipe tower");
  const OffsetFit fit = offset_fit(print, apart_offsets);
  EXPECT_EQ(fit.touching + fit.overlapping + fit.together, 0);
  EXPECT_FALSE(guessed_offsets_in(print, apart_offsets));
}

TEST(GuessedOffsetsIn, IsTheFormInWhichTheColoursFit) {
  EXPECT_EQ(guessed_offsets_in(print_of({jigsaw}, apart_offsets), apart_offsets), OffsetsIn::slicer);
  EXPECT_EQ(guessed_offsets_in(print_of({jigsaw}, {{0, 0}, {0, 0}}), apart_offsets), OffsetsIn::firmware);
}

TEST(GuessedOffsetsIn, IsTheFormInWhichColoursThatNowhereMeetAreAmongEachOther) {
  EXPECT_EQ(guessed_offsets_in(print_of({apart}, apart_offsets), apart_offsets), OffsetsIn::slicer);
  EXPECT_EQ(guessed_offsets_in(print_of({apart}, {{0, 0}, {0, 0}}), apart_offsets), OffsetsIn::firmware);
}

TEST(GuessedOffsetsIn, IsTheFormInWhichOneColourStandsOnTheOther) {
  const std::vector<std::string> stack = {"0 0 0 0", "1 1 1 1"};
  EXPECT_EQ(guessed_offsets_in(print_of(stack, apart_offsets), apart_offsets), OffsetsIn::slicer);
  EXPECT_EQ(guessed_offsets_in(print_of(stack, {{0, 0}, {0, 0}}), apart_offsets), OffsetsIn::firmware);
}

TEST(GuessedOffsetsIn, IsNothingWhereTheFormsAreAlike) {
  EXPECT_FALSE(guessed_offsets_in(print_of({jigsaw}, apart_offsets), {{0, 0}, {0, 0}}));
  // Two parts side by side, far from each other in both forms.
  const GcodePrint print =
      read_gcode("M83\nG1 Z0.3 F6000\nG1 X0 Y0\nG1 X10 Y0 E1\nT1\nG1 X100 Y90\nG1 X110 Y90 E1\n", "a.gcode");
  EXPECT_FALSE(guessed_offsets_in(print, apart_offsets));
}

TEST(GuessedOffsets, AreWhereAJigsawFits) {
  for (const Vec2 offset : {Vec2{33, 0}, Vec2{-25, 0}, Vec2{24.8, 0.6}, Vec2{0, 47.5}}) {
    SCOPED_TRACE(fmt::format("{} {}", offset.x, offset.y));
    const std::vector<Vec2> guessed = guessed_offsets_mm(print_of({jigsaw}, {{0, 0}, offset}));
    ASSERT_EQ(guessed.size(), 2u);
    EXPECT_EQ(guessed[0], (Vec2{0, 0}));
    EXPECT_NEAR(guessed[1].x, offset.x, 0.5);
    EXPECT_NEAR(guessed[1].y, offset.y, 0.5);
  }
}

TEST(GuessedOffsets, AreFoundForEachNozzle) {
  const std::string three = R"(
    0 0 0 0 0 0 0 0
    0 1 1 1 0 2 2 0
    0 0 0 1 0 2 0 0
    0 1 1 1 0 2 2 0
    0 0 0 0 0 0 0 0 )";
  const std::vector<Vec2> guessed = guessed_offsets_mm(print_of({three}, {{0, 0}, {30, 0}, {60, 0}}));
  ASSERT_EQ(guessed.size(), 3u);
  EXPECT_NEAR(guessed[1].x, 30, 0.5);
  EXPECT_NEAR(guessed[2].x, 60, 0.5);
}

TEST(GuessedOffsets, AreNotMadeUp) {
  EXPECT_TRUE(guessed_offsets_mm(print_of({jigsaw}, {{0, 0}, {0, 0}})).empty()) << "fits as it is";
  EXPECT_TRUE(guessed_offsets_mm(print_of({apart}, apart_offsets)).empty()) << "the colours meet nowhere";
  EXPECT_TRUE(guessed_offsets_mm(print_of({"0 0 0 0 1 1 1 1"}, apart_offsets)).empty()) << "fits on either side";
  EXPECT_TRUE(guessed_offsets_mm(print_of({"0 0 0 0", "1 1 1 1"}, apart_offsets)).empty()) << "no layer has both";
}

TEST(GuessedOffsets, OfPartsTooLargeToDrawAreNone) {
  const GcodePrint print =
      read_gcode("M83\nG1 Z0.3 F6000\nG1 X0 Y0\nG1 X9000 Y9000 E9\nT1\nG1 X1 Y0\nG1 X9001 Y9000 E9\n", "a.gcode");
  EXPECT_TRUE(guessed_offsets_mm(print).empty());
  EXPECT_EQ(offset_fit(print, {}).touching, 0);
}

TEST(AuditMachine, FindsANozzleThatNobodySaysAnythingOf) {
  Warned warned;
  const AuditMachine machine = audit_machine(print_of({jigsaw}, {{0, 0}, {25, 0}}), {}, warned.progress);
  EXPECT_NEAR(machine.nozzles[1].offset_mm.x, 25, 0.5);
  EXPECT_EQ(machine.offsets_in, OffsetsIn::slicer);
  ASSERT_EQ(warned.warnings.size(), 1u) << "a guess is told";
  EXPECT_NE(warned.warnings[0].find("--nozzle-offset 0x0,25x"), std::string::npos) << warned.warnings[0];
}

TEST(AuditMachine, SaysForEveryNozzleWhatToType) {
  EXPECT_ERROR(audit_machine(print_of({"0 1 2"}, {{0, 0}, {0, 0}, {0, 0}}), {}),
               "--nozzle-offset 0x0,33x0,66x0 (and --offsets-in slicer");
}

}  // namespace
}  // namespace cleancolor
