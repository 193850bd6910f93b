// Samples of every dialect, written by hand after the slicers' sources and documentation; docs/gcode-dialects.md says
// which dialects were also read in real files.

#include <gtest/gtest.h>

#include <map>

#include "reader/read.hpp"

namespace cleancolor {
namespace {

GcodePrint sample(const std::string& name) {
  return read_gcode_file(std::string(CLEANCOLOR_ROOT) + "/tests/reader/samples/" + name + ".gcode");
}

/// The roles that each tool lays, in their order, repeats left out.
std::map<int, std::vector<Role>> roles_by_tool(const GcodePrint& print) {
  std::map<int, std::vector<Role>> roles;
  for (const GcodeMove& move : print.moves) {
    if (move.width_mm <= 0) continue;
    auto& of_tool = roles[move.feeds];
    if (of_tool.empty() || of_tool.back() != move.role) of_tool.push_back(move.role);
  }
  return roles;
}

using Roles = std::map<int, std::vector<Role>>;

TEST(Samples, Simplify3D) {
  const GcodePrint print = sample("simplify3d");
  EXPECT_EQ(print.facts.dialect, Dialect::simplify3d);
  EXPECT_EQ(print.facts.producer, "Simplify3D 4.1.2");
  EXPECT_EQ(roles_by_tool(print),
            (Roles{{0, {Role::skirt_brim, Role::external_perimeter, Role::perimeter, Role::solid_infill}},
                   {1, {Role::external_perimeter, Role::internal_infill, Role::wipe_tower}}}));
  ASSERT_EQ(print.layers.size(), 1u);
  EXPECT_DOUBLE_EQ(print.layers[0].z_mm, 0.2);
  EXPECT_EQ(print.facts.filament_diameter_mm, (std::vector<double>{1.75, 2.85, 1.75, 1.75, 1.75, 1.75}));
  EXPECT_EQ(print.facts.filament_density_g_cm3[1], 1.04);
  EXPECT_DOUBLE_EQ(print.facts.told_time_s, 60);
  EXPECT_TRUE(print.unknown.empty());
}

TEST(Samples, KISSlicer) {
  const GcodePrint print = sample("kisslicer");
  EXPECT_EQ(print.facts.dialect, Dialect::kisslicer);
  EXPECT_EQ(print.facts.producer, "KISSlicer 1.6.3");
  EXPECT_EQ(print.facts.nozzle_offset_mm, (std::vector<Vec2>{{0, 0}, {25, 0.5}}));
  EXPECT_FALSE(print.facts.offsets_in) << "left to the plastic";
  EXPECT_EQ(print.facts.filament_diameter_mm, (std::vector<double>{2.85, 1.75}));
  EXPECT_DOUBLE_EQ(print.facts.told_time_s, 90);
  EXPECT_EQ(roles_by_tool(print),
            (Roles{{0, {Role::skirt_brim, Role::external_perimeter, Role::perimeter, Role::internal_infill}},
                   {1, {Role::wipe_tower, Role::external_perimeter, Role::support}}}))
      << "'Destring Prime' ends no path";
  EXPECT_FLOAT_EQ(float(print.layers.at(0).height_mm), 0.2F);
  EXPECT_TRUE(print.unknown.empty());
}

TEST(Samples, BambuStudio) {
  const GcodePrint print = sample("bambustudio");
  EXPECT_EQ(print.facts.producer, "BambuStudio 01.09.05.51");
  EXPECT_EQ(print.facts.dialect, Dialect::bambustudio);
  EXPECT_EQ(roles_by_tool(print), (Roles{{0, {Role::perimeter, Role::external_perimeter}},
                                         {1, {Role::custom, Role::wipe_tower, Role::top_solid_infill}}}));
  EXPECT_EQ(print.facts.filament_colour, (std::vector<std::string>{"#FFFFFF", "#C12E1F"}));
  EXPECT_EQ(print.facts.offsets_in, OffsetsIn::firmware) << "offsets that are all alike are no offsets";
  EXPECT_TRUE(print.facts.nozzle_offset_mm.empty());
  EXPECT_EQ(print.facts.config_kind, "orcaslicer");
  EXPECT_DOUBLE_EQ(print.facts.told_time_s, 9 * 60 + 41);
  EXPECT_TRUE(print.moves.back().arc);
  EXPECT_EQ(print.tools, 2) << "T255 and T1000 select nothing";
}

TEST(Samples, OrcaSlicer) {
  const GcodePrint print = sample("orcaslicer");
  EXPECT_EQ(print.facts.dialect, Dialect::orcaslicer);
  EXPECT_EQ(print.facts.producer, "OrcaSlicer 2.1.1");
  EXPECT_EQ(roles_by_tool(print), (Roles{{0, {Role::perimeter, Role::external_perimeter, Role::internal_infill}},
                                         {1, {Role::wipe_tower, Role::external_perimeter, Role::support_interface}}}));
  EXPECT_EQ(print.facts.nozzle_offset_mm, (std::vector<Vec2>{{0, 0}, {18, 0}}));
  EXPECT_EQ(print.facts.offsets_in, OffsetsIn::slicer);
  EXPECT_DOUBLE_EQ(print.facts.told_time_s, 65);
  EXPECT_FALSE(print.facts.marlin);
  EXPECT_TRUE(print.unknown.empty());
}

TEST(Samples, CuraForUltimaker) {
  const GcodePrint print = sample("cura-griffin");
  EXPECT_EQ(print.facts.dialect, Dialect::cura);
  EXPECT_EQ(print.facts.producer, "Cura 5.6.0");
  EXPECT_EQ(print.facts.filament_diameter_mm, (std::vector<double>{2.85}));
  EXPECT_EQ(roles_by_tool(print),
            (Roles{{0, {Role::skirt_brim, Role::perimeter, Role::external_perimeter, Role::solid_infill}},
                   {1, {Role::wipe_tower, Role::external_perimeter}}}));
  EXPECT_FALSE(print.facts.marlin);
  EXPECT_DOUBLE_EQ(print.facts.told_time_s, 65.2);
}

TEST(Samples, CuraForMarlin) {
  const GcodePrint print = sample("cura-marlin");
  EXPECT_EQ(print.facts.producer, "Cura 4.13.0");
  EXPECT_EQ(roles_by_tool(print), (Roles{{0, {Role::external_perimeter, Role::internal_infill}},
                                         {1, {Role::external_perimeter, Role::support_interface}}}));
  EXPECT_TRUE(print.facts.marlin);
  EXPECT_FALSE(print.facts.offsets_in) << "Cura does not say";
  EXPECT_TRUE(print.unknown.empty());
}

TEST(Samples, PrusaSlicer) {
  const GcodePrint print = sample("prusaslicer");
  EXPECT_EQ(print.facts.producer, "PrusaSlicer 2.5.0");
  EXPECT_EQ(roles_by_tool(print), (Roles{{0, {Role::custom, Role::skirt_brim, Role::overhang_perimeter}},
                                         {1, {Role::wipe_tower, Role::external_perimeter, Role::support_interface}}}));
  ASSERT_EQ(print.layers.size(), 2u);
  EXPECT_DOUBLE_EQ(print.layers[1].z_mm, 0.6);
  EXPECT_FLOAT_EQ(float(print.layers[1].height_mm), 0.3F);
  EXPECT_EQ(print.facts.nozzle_offset_mm, (std::vector<Vec2>{{0, 0}, {33, 0}}));
  EXPECT_EQ(print.facts.offsets_in, OffsetsIn::slicer);
  EXPECT_EQ(print.facts.filament_colour, (std::vector<std::string>{"#0000FF", "#00FF00"}));
  EXPECT_DOUBLE_EQ(print.facts.told_time_s, 3600 + 7 * 60 + 8);
  EXPECT_TRUE(print.facts.marlin);
  EXPECT_EQ(print.facts.config_kind, "prusaslicer");
  EXPECT_TRUE(print.unknown.empty());
}

TEST(Samples, Slic3rWithVerboseComments) {
  const GcodePrint print = sample("slic3r");
  EXPECT_EQ(print.facts.producer, "Slic3r 1.3.0");
  EXPECT_EQ(roles_by_tool(print), (Roles{{0, {Role::skirt_brim, Role::perimeter, Role::internal_infill}},
                                         {1, {Role::perimeter, Role::support}}}));
  EXPECT_EQ(print.facts.nozzle_offset_mm, (std::vector<Vec2>{{0, 0}, {33, 0}}));
  EXPECT_TRUE(print.facts.filament_density_g_cm3.empty()) << "0 is none";
  EXPECT_FALSE(print.facts.marlin);
  EXPECT_TRUE(print.unknown.empty());
}

TEST(Samples, SuperSlicer) {
  const GcodePrint print = sample("superslicer");
  EXPECT_EQ(print.facts.dialect, Dialect::superslicer);
  EXPECT_EQ(roles_by_tool(print), (Roles{{0, {Role::external_perimeter, Role::gap_fill}},
                                         {1, {Role::top_solid_infill, Role::ironing, Role::wipe_tower}}}));
  EXPECT_EQ(print.facts.nozzle_offset_mm, (std::vector<Vec2>{{0, 0}, {14, 0}}));
  EXPECT_TRUE(print.facts.per_minute_limits) << "RepRapFirmware's M203 is in mm/min";
}

TEST(Samples, IdeaMaker) {
  const GcodePrint print = sample("ideamaker");
  EXPECT_EQ(print.facts.dialect, Dialect::ideamaker);
  EXPECT_EQ(roles_by_tool(print),
            (Roles{{0, {Role::skirt_brim, Role::external_perimeter, Role::perimeter, Role::solid_infill}},
                   {1, {Role::external_perimeter, Role::internal_infill}}}));
  EXPECT_EQ(print.facts.producer, "ideaMaker 4.3.1.6452");
  EXPECT_DOUBLE_EQ(print.facts.told_time_s, 321);
  EXPECT_TRUE(print.unknown.empty());
}

}  // namespace
}  // namespace cleancolor
