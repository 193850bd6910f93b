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

TEST(Assign, RefusesToMapAColourThatNoPartHas) {
  EXPECT_TRUE(says(refusal([] { assigned({{coloured(green), coloured(blue)}}, {{}, {{red, 1}}, 2}); }),
                   "--map-colour #FF0000=2: no part has this colour; there are #0000FF, #00FF00"));
  EXPECT_TRUE(says(refusal([] { assigned({{part()}, {of_material("PLA")}}, {{}, {{red, 1}}, 2}); }),
                   "--map-colour #FF0000=2: no part has a colour"));
}

TEST(Assign, ListsOnlySomeOfManyColours) {
  std::vector<Part> parts;
  for (std::uint32_t rgb = 0; rgb < 20; ++rgb) parts.push_back(coloured(rgb));
  EXPECT_TRUE(says(refusal([&] { assigned({parts}, {{}, {{red, 1}}, 2}); }), "#00000E, #00000F and 4 more"));
}

TEST(Assign, RefusesToMapAColourToAnExtruderThatThePrinterDoesNotHave) {
  for (const Part& p : {part(), coloured(red), coloured(blue)})
    EXPECT_TRUE(says(refusal([&] { assigned({{p}}, {{}, {{red, 2}}, 2}); }),
                     "--map-colour #FF0000=3: the printer has 2 extruders"));
}

std::vector<std::string> warnings(std::vector<std::vector<Part>> files, const Assignment& assignment) {
  std::vector<std::string> texts;
  assign_extruders(files, assignment, {.warn = [&](const std::string& text) { texts.push_back(text); }});
  return texts;
}

TEST(Assign, WarnsOfPartsOfOneFileThatSayNothingWhereThePrinterHasSeveralExtruders) {
  const Part a{"two.3mf: a", {}, {}, {}, {}};
  const Part b{"two.3mf: b", {}, {}, {}, {}};
  using Texts = std::vector<std::string>;
  EXPECT_EQ(warnings({{a, b}}, printer(2)),
            Texts{"two.3mf: 2 parts without colour or extruder, all printed by extruder 1"});
  EXPECT_EQ(warnings({{part()}, {a, b}}, printer(2)),
            Texts{"two.3mf: 2 parts without colour or extruder, all printed by extruder 2"});
  EXPECT_EQ(warnings({{a, b}}, printer(1)), Texts{});
  EXPECT_EQ(warnings({{a, b}}, {{1}, {}, 2}), Texts{}) << "--extruder 2 was asked for";
  EXPECT_EQ(warnings({{part()}, {part()}}, printer(2)), Texts{});
  EXPECT_EQ(warnings({{coloured(red), coloured(red)}}, printer(2)), Texts{});
}

}  // namespace
}  // namespace cleancolor
