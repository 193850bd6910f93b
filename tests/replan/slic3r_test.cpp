// Slic3r 1.3.0, which tells the roles of roads in verbose comments alone: two bars of two colours, 16 x 4 mm each, side
// by side in 6 layers.

#include <gtest/gtest.h>

#include "replan/found_roles.hpp"
#include "replanning.hpp"

namespace cleancolor {
namespace {

using namespace test;

/// How many roads of that role each layer has.
std::vector<int> roads_of(const GcodePrint& print, Role role) {
  std::vector<int> count(print.layers.size(), 0);
  for (std::size_t i = 0; i < print.moves.size(); ++i)
    if (lays_plastic(print, i) && print.moves[i].role == role) ++count[print.moves[i].layer];
  return count;
}

GcodePrint found(const std::string& name) {
  const GcodePrint print = read_gcode(fixture(name), "");
  return with_found_roles(print, audit_machine(print, {}));
}

TEST(ReplanSlic3r, FindsWallsOfBothColours) {
  const GcodePrint print = found("slic3r-plain.gcode");
  // Of each colour one loop of four roads.
  EXPECT_EQ(roads_of(print, Role::external_perimeter), std::vector<int>(6, 8));
  EXPECT_EQ(roads_of(print, Role::perimeter), std::vector<int>(6, 8));
  EXPECT_EQ(roads_of(print, Role::skirt_brim), std::vector<int>(6, 0));
  for (const int fills : roads_of(print, Role::internal_infill)) EXPECT_GT(fills, 0);
}

TEST(ReplanSlic3r, FindsTheSkirtThatWipes) {
  const GcodePrint print = found("slic3r-ooze.gcode");
  for (const int roads : roads_of(print, Role::skirt_brim)) EXPECT_GT(roads, 4);
  EXPECT_EQ(roads_of(print, Role::external_perimeter), std::vector<int>(6, 8));
}

TEST(ReplanSlic3r, SaysNoRolesThatItFound) {
  const std::string out = replanned_text(fixture("slic3r-plain.gcode"), {.protection = ReplanProtection::rampart}).text;
  EXPECT_NE(out.find(";RAMPART_WALL"), out.npos);
  for (const auto& [what, mm] : part_filament(read_gcode(out, ""))) EXPECT_EQ(what.second, Role::unknown);
}

TEST(ReplanSlic3r, KeepsRolesThatTheFileTells) {
  const std::string text = fixture("slic3r-verbose.gcode");
  EXPECT_TRUE(part_filament(read_gcode(replanned_text(text).text, "")).contains({0, Role::perimeter}));
}

TEST(ReplanSlic3r, RefusesWhatItWouldTakeForThePart) {
  const std::string text = fixture("slic3r-plain.gcode");
  EXPECT_ERROR(replanned_text(replaced(text, "; support_material = 0", "; support_material = 1")), "support_material");
  EXPECT_ERROR(replanned_text(replaced(text, "; brim_width = 0", "; brim_width = 4")), "brim_width");
  EXPECT_ERROR(replanned_text(text, {.removes_shield = true}), "shield");
}

TEST(ReplanSlic3r, WithoutMarksOfLayersSaysHowToGetThem) {
  std::string text = fixture("slic3r-plain.gcode");
  for (std::size_t at; (at = text.find("\n;LAYER_CHANGE")) != text.npos;) text.replace(at, 14, "\n; layer");
  EXPECT_ERROR(replanned_text(text), "layer_gcode");
}

}  // namespace
}  // namespace cleancolor
