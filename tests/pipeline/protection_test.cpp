// What slicing does against ooze by itself: it turns the parts, and builds a rampart; judged by the audit.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "audit/audit.hpp"
#include "model/options.hpp"
#include "model/settings.hpp"
#include "reader/read.hpp"
#include "replay.hpp"
#include "sanitized.hpp"
#include "slicing.hpp"

namespace cleancolor {
namespace {

using namespace test;

Config replicator(const std::vector<std::string>& set = {}) {
  return config_of({.printer = "replicator-dual", .set = set});
}

/// Two blocks side by side, one of each colour.
std::vector<std::filesystem::path> two_blocks(const TestFolder& folder, double width_mm, double depth_mm,
                                              double height_mm) {
  return {stl_file(folder, "left.stl", box_mesh({0, 0, 0}, {width_mm / 2, depth_mm, height_mm})),
          stl_file(folder, "right.stl", box_mesh({width_mm / 2, 0, 0}, {width_mm, depth_mm, height_mm}))};
}

Figures worst_figures(const Sliced& print) {
  const GcodePrint read = read_gcode(print.text, "out.gcode");
  AuditOptions options;
  options.threads = 1;
  options.scenarios.resize(1);
  return audit(read, audit_machine(read, {}), options).scenarios.front().total;
}

double rampart_mm3(const Sliced& print, const Config& config) {
  double filament_mm = 0;
  for (const PrintedRoad& r : replayed(print.text, config).roads)
    if (r.role == "Skirt/Brim") filament_mm += r.filament_mm;
  const double d = config.extruders.front().filament_diameter_mm;
  return filament_mm * std::numbers::pi / 4 * d * d;
}

TEST(Protection, OneColourIsNeitherTurnedNorWalledIn) {
  const TestFolder folder;
  const std::vector<std::filesystem::path> one{stl_file(folder, "bar.stl", box_mesh({0, 0, 0}, {60, 10, 3}))};
  SliceRequest request = request_for(one, replicator(), folder.path("out.gcode"));
  const Sliced untouched = sliced(request);
  request.azimuth_deg.reset();
  const Sliced automatic = sliced(request);
  EXPECT_TRUE(automatic.text == untouched.text);
  EXPECT_FALSE(automatic.summary.protection.azimuths);
  EXPECT_EQ(automatic.summary.protection.rampart, RampartShape::off);
  EXPECT_EQ(automatic.summary.protection.rampart_g, 0);
  // Nor where a rampart is asked for.
  request.config.rampart = RampartShape::vertical;
  EXPECT_EQ(sliced(request).summary.protection.rampart, RampartShape::off);
}

/// By layer, what plastic beside the part's is taken for when the print is read.
std::vector<std::set<Role>> auxiliary_roles(const Sliced& print) {
  const GcodePrint read = read_gcode(print.text, "out.gcode");
  std::vector<std::set<Role>> roles(read.layers.size());
  for (std::size_t i = 0; i < read.moves.size(); ++i)
    if (const GcodeMove& m = read.moves[i]; lays_plastic(read, i) && is_auxiliary(m.role) && m.role != Role::custom)
      roles[m.layer].insert(m.role);
  return roles;
}

TEST(Protection, RampartsAreReadAsSuchWhateverSkirtAndBrimAre) {
  const TestFolder folder;
  using enum Role;
  for (const char* option : {"skirt_height=1000", "brim_type=no_brim", "rampart_brim_width=0", "brim_width=3"}) {
    SCOPED_TRACE(option);
    const Config config = replicator({option});
    const auto roles =
        auxiliary_roles(sliced(request_for(two_blocks(folder, 30, 20, 2), config, folder.path("a.gcode"))));
    EXPECT_TRUE(roles.front().contains(rampart));
    EXPECT_EQ(roles.front().contains(skirt_brim), std::string(option) != "rampart_brim_width=0");
    for (std::size_t k = 1; k < roles.size(); ++k) EXPECT_EQ(roles[k], std::set{rampart}) << "layer " << k;
  }
  const auto bare = auxiliary_roles(sliced(request_for(
      two_blocks(folder, 30, 20, 2), replicator({"rampart=off", "skirt_height=3"}), folder.path("a.gcode"))));
  for (const std::set<Role>& roles : bare) EXPECT_FALSE(roles.contains(rampart));
}

TEST(Protection, NozzlesThatLeaveThePrintNeedNone) {
  const TestFolder folder;
  for (const IdleNozzle idle : {IdleNozzle::lifted, IdleNozzle::parked, IdleNozzle::docked}) {
    Config config = replicator();
    config.idle_nozzle = idle;
    SliceRequest request = request_for(two_blocks(folder, 30, 20, 2), config, folder.path("out.gcode"));
    request.azimuth_deg.reset();
    const Sliced result = sliced(request);
    EXPECT_FALSE(result.summary.protection.azimuths);
    EXPECT_EQ(result.summary.protection.rampart, RampartShape::off);
    request.config.rampart = RampartShape::conforming;
    EXPECT_EQ(sliced(request).summary.protection.rampart, RampartShape::conforming) << "where asked for";
  }
}

TEST(Protection, NozzlesThatTakeEachOthersPlaceHaveAWallEach) {
  const TestFolder folder;
  Config config = config_of({.printer = "klipper-idex"});
  config.rampart = RampartShape::conforming;
  const Sliced result = sliced(request_for(two_blocks(folder, 30, 20, 2), config, folder.path("out.gcode")));
  std::map<int, double> wall_mm;
  for (const PrintedRoad& r : replayed(result.text, config).roads)
    if (r.layer > 0 && r.role == "Skirt/Brim") wall_mm[r.tool] += distance(r.from, r.to);
  ASSERT_EQ(wall_mm.size(), 2U);
  EXPECT_GT(wall_mm[1], wall_mm[0] + 20) << "the outer one goes all around the inner one";
}

TEST(Protection, TheBrimCountsAsTheRamparts) {
  const TestFolder folder;
  const auto grams = [&](const std::string& width) {
    const Config config = replicator({"rampart_brim_width=" + width});
    return sliced(request_for(two_blocks(folder, 30, 20, 2), config, folder.path("out.gcode")))
        .summary.protection.rampart_g;
  };
  EXPECT_GT(grams("8"), grams("0") + 0.2);
}

TEST(Protection, ABarIsTurnedUntilTheOtherNozzleHoversBesideIt) {
  // 70 x 10 mm, nozzles 33 mm apart: nothing is met from asin(10 / 33) on, 17.6 degrees.
  const TestFolder folder;
  SliceRequest request = request_for(two_blocks(folder, 70, 10, 6), replicator(), folder.path("out.gcode"));
  request.azimuth_deg.reset();
  const Sliced result = sliced(request);
  EXPECT_NEAR(result.summary.protection.azimuth_deg, 18, 1.5);
  EXPECT_LT(worst_figures(result).smear_volume_print, 0.05);
  request.azimuth_deg = 0;
  request.config.rampart = RampartShape::off;
  EXPECT_GT(worst_figures(sliced(request)).smear_volume_print, 0.3);
}

TEST(Protection, AGivenAngleIsTaken) {
  const TestFolder folder;
  SliceRequest request = request_for(two_blocks(folder, 40, 10, 2), replicator(), folder.path("out.gcode"));
  request.azimuth_deg = 90;
  request.config.rampart = RampartShape::off;
  const Sliced result = sliced(request);
  EXPECT_EQ(result.summary.protection.azimuth_deg, 90);
  Box<Vec2> box;
  for (const PrintedRoad& r : replayed(result.text, request.config).roads)
    if (r.role == "External perimeter") box.add(r.to);
  EXPECT_NEAR(box.size().y, 40, 1);
  EXPECT_NEAR(box.size().x, 10, 1);
}

TEST(Protection, OnlyAnglesThatFitTheBedAreTaken) {
  // As long as the bed is wide: turned, it would stick out at front and back.
  const TestFolder folder;
  SliceRequest request = request_for(two_blocks(folder, 200, 10, 1), replicator(), folder.path("out.gcode"));
  request.azimuth_deg.reset();
  const Sliced result = sliced(request);
  EXPECT_LT(std::abs(result.summary.protection.azimuth_deg), 45);
  EXPECT_EQ(replayed(result.text, request.config).broken, std::vector<std::string>{});
}

TEST(Protection, ARampartWithoutRoomIsRefusedWithWhatToDo) {
  const TestFolder folder;
  const SliceRequest request = request_for(two_blocks(folder, 224, 144, 1), replicator(), folder.path("out.gcode"));
  EXPECT_ERROR(slice(request), "--rampart off");
  EXPECT_ERROR(slice(request), "--center");
  EXPECT_FALSE(std::filesystem::exists(request.output));
}

TEST(Protection, EachNozzlePrintsItsWallJustBeforeItsRun) {
  const TestFolder folder;
  for (const char* walls : {"double", "split"}) {
    const Config config = replicator({std::string("rampart_walls=") + walls});
    const Sliced result = sliced(request_for(two_blocks(folder, 30, 20, 3), config, folder.path("out.gcode")));
    int last_layer = -1, last_tool = -1;
    for (const PrintedRoad& r : replayed(result.text, config).roads) {
      if (r.layer > 0 && (r.tool != last_tool || r.layer != last_layer)) {
        EXPECT_EQ(r.role, "Skirt/Brim") << "layer " << r.layer << ", T" << r.tool;
      }
      last_layer = r.layer, last_tool = r.tool;
    }
    EXPECT_EQ(result.summary.tool_changes, result.summary.layers) << "one a layer, and one for priming";
  }
}

TEST(Protection, AtLayerStartAllWallsComeFirst) {
  const TestFolder folder;
  const Config config = replicator({"rampart_order=layer_start", "rampart_walls=double"});
  const Sliced result = sliced(request_for(two_blocks(folder, 30, 20, 3), config, folder.path("out.gcode")));
  int layer = -1;
  bool part = false;
  for (const PrintedRoad& r : replayed(result.text, config).roads) {
    if (r.layer != layer) part = false;
    layer = r.layer;
    part = part || r.role != "Skirt/Brim";
    EXPECT_FALSE(part && r.role == "Skirt/Brim") << "layer " << r.layer;
  }
}

TEST(Protection, TheRampartEndsWithTheLastButOneColour) {
  const TestFolder folder;
  const std::vector<std::filesystem::path> files{stl_file(folder, "a.stl", box_mesh({0, 0, 0}, {20, 20, 9})),
                                                 stl_file(folder, "b.stl", box_mesh({20, 0, 0}, {40, 20, 3}))};
  for (const bool heater_off : {true, false}) {
    const Config config = replicator({std::string("heater_off_after_last_use=") + (heater_off ? "1" : "0")});
    const Sliced result = sliced(request_for(files, config, folder.path("out.gcode")));
    double top_mm = 0;
    for (const PrintedRoad& r : replayed(result.text, config).roads)
      if (r.role == "Skirt/Brim") top_mm = std::max(top_mm, r.z);
    EXPECT_NEAR(top_mm, heater_off ? 3 : 9, 0.31) << "a hot nozzle needs it to the end";
  }
}

TEST(Protection, ThreeNozzlesHaveThreeWalls) {
  const TestFolder folder;
  Config config = config_of({.printer = "generic-dual-marlin"});
  set_extruder_count(config, 3);
  config.extruders[2].nozzle_offset_mm = {0, 20};
  config.rampart_brim_width_mm = 0;
  std::vector<std::filesystem::path> files = two_blocks(folder, 30, 20, 2);
  files.push_back(stl_file(folder, "third.stl", box_mesh({0, 20, 0}, {30, 30, 2})));
  SliceRequest request = request_for(files, config, folder.path("out.gcode"));
  const Sliced result = sliced(request);
  std::map<int, Box<Vec2>> walls;
  for (const PrintedRoad& r : replayed(result.text, config).roads)
    if (r.role == "Skirt/Brim" && r.layer == 2) walls[r.tool].add(r.to);
  ASSERT_EQ(walls.size(), 3U);
  EXPECT_NEAR(walls[1].size().x, walls[0].size().x + 8, 0.2);
  EXPECT_NEAR(walls[2].size().x, walls[1].size().x + 8, 0.2);
  request.azimuth_deg.reset();
  EXPECT_TRUE(sliced(request).summary.protection.azimuths);
}

TEST(Protection, WallsOfALayerInWhichNobodyPrintsAreAHotNozzles) {
  // The first ends at 2 mm, the other two leave a gap above it: the walls go on, and not by the one that is off.
  const TestFolder folder;
  Config config = config_of({.printer = "generic-dual-marlin"});
  set_extruder_count(config, 3);
  config.extruders[2].nozzle_offset_mm = {0, 20};
  const auto two = [](double x) {
    return joined(box_mesh({x, 0, 0}, {x + 10, 10, 2}), box_mesh({x, 0, 4}, {x + 10, 10, 6}));
  };
  const std::vector<std::filesystem::path> files{stl_file(folder, "a.stl", box_mesh({0, 0, 0}, {10, 10, 2})),
                                                 stl_file(folder, "b.stl", two(10)),
                                                 stl_file(folder, "c.stl", two(20))};
  const Sliced result = sliced(request_for(files, config, folder.path("out.gcode")));
  double gap_wall_mm = 0;
  for (const PrintedRoad& r : replayed(result.text, config).roads) {
    if (r.tool == 0) {
      EXPECT_LT(r.z, 2.2);
    }
    if (r.z > 2.5 && r.z < 3.5) gap_wall_mm += distance(r.from, r.to);
  }
  EXPECT_GT(gap_wall_mm, 100);
}

TEST(Protection, ABrimThatTheRampartLeavesNoRoomForIsCutWithAWarning) {
  const TestFolder folder;
  SliceRequest request = request_for(two_blocks(folder, 30, 20, 2),
                                     replicator({"brim_type=outer_only", "brim_width=8"}), folder.path("out.gcode"));
  EXPECT_NE(sliced(request).warnings.find("brim_width: 1."), std::string::npos);
  request.config.rampart = RampartShape::off;
  EXPECT_EQ(sliced(request).warnings.find("brim_width"), std::string::npos);
}

class ProtectionOfModel : public testing::TestWithParam<const char*> {};

TEST_P(ProtectionOfModel, KeepsIdleNozzlesOffAndStaysOnTheBed) {
  if (!shared_models_are_there()) GTEST_SKIP() << "needs the models of " << CLEANCOLOR_SHARED;
  SKIP_LARGE_WHERE_SANITIZED(GetParam());
  const Model& model = model_named(GetParam());
  const TestFolder folder;
  SliceRequest request = request_for(model, replicator(), folder.path("out.gcode"));
  request.config.rampart = RampartShape::off;
  request.config.planner = Planner::plain;
  const Figures plain = worst_figures(sliced(request));
  request.config.rampart = RampartShape::automatic;
  request.azimuth_deg.reset();
  const Sliced walled = sliced(request);
  request.config.planner = Planner::clean;
  const Sliced safe = sliced(request);
  const Printed printed = replayed(safe.text, request.config);
  EXPECT_EQ(printed.broken, std::vector<std::string>{});
  for (const PrintedRoad& r : printed.roads) {
    ASSERT_LE(std::abs(r.to.x), 112.5);
    ASSERT_LE(std::abs(r.to.y), 72.5);
  }
  // An eighth, or nothing worth mentioning; with the planner a twentieth of all, and few holes and seams that are seen.
  EXPECT_LE(worst_figures(walled).smear_volume_print, std::max(0.2, plain.smear_volume_print / 8));
  const Figures clean = worst_figures(safe);
  EXPECT_LE(clean.smear_volume(), std::max(0.2, plain.smear_volume() / 20));
  EXPECT_LE(clean.hole_volume, plain.hole_volume / 2);
  EXPECT_LE(clean.zippers_visible, plain.zippers_visible / 2);
  request.config.rampart = RampartShape::vertical;
  const Sliced vertical = sliced(request);
  EXPECT_LT(rampart_mm3(safe, request.config), rampart_mm3(vertical, request.config));
}

INSTANTIATE_TEST_SUITE_P(Paper, ProtectionOfModel,
                         testing::Values("4-cones", "crystal", "dragon-heart", "robot-ice", "rose", "spot-cow",
                                         "two-color-world-50mm"),
                         [](const auto& of) {
                           std::string name = of.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace cleancolor
