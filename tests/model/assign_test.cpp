#include "model/assign.hpp"

#include <gtest/gtest.h>

#include "meshes.hpp"

namespace cleancolor {
namespace {

Part part() {
  return {"file", {}, {}, {}, {}};
}
Part coloured(std::uint32_t rgb) {
  return {"file", {}, {}, rgb, {}};
}
Part of_material(std::string name) {
  return {"file", {}, {}, {}, std::move(name)};
}
Part with_extruder(int extruder) {
  return {"file", {}, extruder, {}, {}};
}

constexpr std::uint32_t red = 0xFF0000, green = 0x00FF00, blue = 0x0000FF;

std::vector<int> assigned(std::vector<std::vector<Part>> files, Assignment assignment) {
  assign_extruders(files, assignment);
  std::vector<int> extruders;
  for (const auto& parts : files)
    for (const Part& p : parts) extruders.push_back(*p.extruder);
  return extruders;
}

Assignment printer(int extruders) {
  return {{}, {}, extruders};
}

TEST(Assign, GivesEachFileAnExtruderInTheOrderGiven) {
  EXPECT_EQ(assigned({{part()}, {part()}, {part()}}, printer(3)), (std::vector{0, 1, 2}));
}

TEST(Assign, LetsAFileStayInOnePieceWhenItSaysNothing) {
  EXPECT_EQ(assigned({{part(), part()}}, printer(2)), (std::vector{0, 0}));
  EXPECT_EQ(assigned({{part(), part()}, {part()}}, printer(2)), (std::vector{0, 0, 1}));
}

TEST(Assign, GivesEachColourAnExtruderInTheOrderOfFirstUse) {
  EXPECT_EQ(assigned({{coloured(blue), coloured(red), coloured(blue)}}, printer(2)), (std::vector{0, 1, 0}));
  EXPECT_EQ(assigned({{of_material("b"), of_material("a"), of_material("b")}}, printer(2)), (std::vector{0, 1, 0}));
}

TEST(Assign, FollowsTheFileOfFilesOfOneColourEach) {
  // Two exports in the same default grey are still meant for two extruders.
  EXPECT_EQ(assigned({{coloured(red)}, {coloured(red)}}, printer(2)), (std::vector{0, 1}));
}

TEST(Assign, FollowsTheColoursOfAFileWithSeveralAmongOtherFiles) {
  EXPECT_EQ(assigned({{part()}, {coloured(red), coloured(blue)}}, printer(3)), (std::vector{0, 1, 2}));
}

TEST(Assign, FollowsTheExtrudersOfAProject) {
  EXPECT_EQ(assigned({{with_extruder(1), with_extruder(0), part()}}, printer(2)), (std::vector{1, 0, 0}));
}

TEST(Assign, LetsTheCommandLineOverrideTheFile) {
  EXPECT_EQ(assigned({{with_extruder(1), coloured(red)}}, {{0}, {{red, 1}}, 2}), (std::vector{0, 0}));
}

TEST(Assign, KeepsExtrudersFreeThatTheCommandLineNames) {
  EXPECT_EQ(assigned({{part()}, {part()}}, {{0, std::nullopt}, {}, 2}), (std::vector{0, 1}));
  EXPECT_EQ(assigned({{part()}, {part()}}, {{1, std::nullopt}, {}, 2}), (std::vector{1, 0}));
  EXPECT_EQ(assigned({{coloured(red), coloured(green)}}, {{}, {{red, 1}}, 2}), (std::vector{1, 0}));
}

TEST(Assign, RefusesMoreExtrudersThanThePrinterHas) {
  EXPECT_TRUE(says(refusal([] { assigned({{part()}, {part()}, {part()}}, printer(2)); }),
                   "needs extruder 3, but the printer has 2"));
  EXPECT_TRUE(says(refusal([] { assigned({{with_extruder(4)}}, printer(2)); }), "needs extruder 5"));
}

}  // namespace
}  // namespace cleancolor
