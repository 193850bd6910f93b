#include "replan/told_filament.hpp"

#include <gtest/gtest.h>

#include "replanning.hpp"

namespace cleancolor {
namespace {

using namespace test;

GcodePrint pushing(const std::vector<double>& mm) {
  std::ostringstream text;
  text << "M83\nG1 X0 Y0 Z0.2\n";
  for (std::size_t tool = 0; tool < mm.size(); ++tool)
    if (mm[tool] > 0) text << 'T' << tool << "\nG1 X1000 E" << mm[tool] << "\nG1 X0\n";
  return read_gcode(text.str(), "");
}

std::string told(std::string text, const std::vector<double>& before, const std::vector<double>& after) {
  correct_filament(text, pushing(before), pushing(after));
  return text;
}

TEST(ToldFilament, EachToolsFigureGrowsByItsShareAndTheTotalByAll) {
  EXPECT_EQ(told("\n; filament used [mm] = 1858.40, 100.00\n; filament used [cm3] = 4.47, 0.24\n"
                 "; filament used [g] = 4.00, 1.00\n; total filament used [g] = 5.00\n; total filament cost = 0.10\n",
                 {10, 20}, {11, 30}),
            "\n; filament used [mm] = 2044.24, 150.00\n; filament used [cm3] = 4.92, 0.36\n"
            "; filament used [g] = 4.40, 1.50\n; total filament used [g] = 5.90\n; total filament cost = 0.12\n");
}

TEST(ToldFilament, CostsOfToolsMakeTheTotalCost) {
  EXPECT_EQ(told("\n; filament used [g] = 4.0, 1.0\n; filament cost = 1.00, 8.00\n; total filament cost = 9.00\n",
                 {1, 1}, {1, 2}),
            "\n; filament used [g] = 4.0, 2.0\n; filament cost = 1.00, 16.00\n; total filament cost = 17.00\n");
}

TEST(ToldFilament, OfSlic3rStandsOnALineForEachTool) {
  EXPECT_EQ(told("\n; filament used = 1885.1mm (4.5cm3)\n; filament used = 100.0mm (0.2cm3)\n", {1, 1}, {2, 3}),
            "\n; filament used = 3770.2mm (9.0cm3)\n; filament used = 300.0mm (0.6cm3)\n");
}

TEST(ToldFilament, OfCuraStandsInTheHead) {
  EXPECT_EQ(told(";FLAVOR:Marlin\n;Filament used: 8.90m, 1.25m\n", {1, 1}, {2, 4}),
            ";FLAVOR:Marlin\n;Filament used: 17.80m, 5.00m\n");
}

TEST(ToldFilament, ToolsThatPrintNothingMayBeLeftOut) {
  EXPECT_EQ(told("\n; filament used [g] = 4.0, 1.0\n", {1, 0, 1}, {1, 0, 2}), "\n; filament used [g] = 4.0, 2.0\n");
  EXPECT_EQ(told("\n; filament used [g] = 4.0, 0.0, 1.0\n", {1, 0, 1}, {1, 0, 2}),
            "\n; filament used [g] = 4.0, 0.0, 2.0\n");
}

TEST(ToldFilament, ToolsBeyondThoseThatPrintStayAtNothing) {
  EXPECT_EQ(told("\n; filament used [g] = 4.0, 1.0, 0.0, 0.0\n; total filament used [g] = 5.0\n", {1, 1}, {1, 2}),
            "\n; filament used [g] = 4.0, 2.0, 0.0, 0.0\n; total filament used [g] = 6.0\n");
}

TEST(ToldFilament, TheLastLineMayEndWithoutALineEnd) {
  EXPECT_EQ(told("\n; filament used [g] = 4.0, 1.0", {1, 1}, {1, 2}), "\n; filament used [g] = 4.0, 2.0");
  EXPECT_EQ(told("\n; filament cost = 1.5", {1, 1}, {1, 2}), "\n; filament cost = 1.5");
  EXPECT_EQ(told("\n; filament used = 2.0mm", {1, 1}, {1, 2}), "\n; filament used = 2.0mm");
}

TEST(ToldFilament, AListOfAnotherLengthStaysAndSoDoesItsTotal) {
  for (const char* text : {"\n; filament used [g] = 5.0\n; total filament used [g] = 5.0\n",
                           "\n; filament used [g] =\n", "\n; filament used [g] = -\n", ";Filament used: 0m\n", ""})
    EXPECT_EQ(told(text, {1, 1}, {2, 2}), text);
}

TEST(ToldFilament, IsWhatAReplannedFileTakes) {
  const std::string text = fixture("prusaslicer.gcode");
  const std::string out = replanned_text(text, {.protection = ReplanProtection::rampart}).text;
  const auto told_mm = [](const std::string& file) {
    const std::size_t at = file.find("\n; filament used [mm] =");
    return std::stod(file.substr(at + 23));
  };
  const double before = filament_of_tools_mm(read_gcode(text, "")).front();
  const double after = filament_of_tools_mm(read_gcode(out, "")).front();
  ASSERT_GT(after, 1.01 * before);
  EXPECT_NEAR(told_mm(out), told_mm(text) * after / before, 0.006);
}

}  // namespace
}  // namespace cleancolor
