// Facts on which PrusaSlicer, Slic3r and Cura agree, and which follow from the dimensions of simple bodies.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "model/settings.hpp"
#include "replay.hpp"
#include "slicing.hpp"

namespace cleancolor {
namespace {

using namespace test;

Box<Vec2> box_of_tool(const Printed& printed, int tool) {
  Box<Vec2> box;
  for (const PrintedRoad& road : printed.roads)
    if (road.tool == tool && is_of_the_model(road.role)) box.add(road.from), box.add(road.to);
  return box;
}

std::pair<double, double> heights_of_tool(const Printed& printed, int tool) {
  std::pair<double, double> range{1e9, -1e9};
  for (const PrintedRoad& road : printed.roads)
    if (road.tool == tool && is_of_the_model(road.role))
      range = {std::min(range.first, road.z), std::max(range.second, road.z)};
  return range;
}

/// The loops of one layer in printing order, outer ones as 1, inner ones as 0.
std::vector<int> loops_of_layer(const Printed& printed, int layer) {
  std::vector<int> result;
  for (const PrintedPath& path : paths_of(printed))
    if (path.layer == layer && path.role.ends_with("erimeter")) result.push_back(path.role == "External perimeter");
  return result;
}

/// An upright body over a drawing: '#' is solid, '.' empty; rows from the back to the front, cells of cell_mm.
Mesh drawn_body(const std::vector<std::string>& rows, double cell_mm, double height_mm) {
  Mesh mesh;
  const int height = int(rows.size()), width = int(rows.front().size());
  const auto solid = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < width && y < height && rows[std::size_t(height - 1 - y)][std::size_t(x)] == '#';
  };
  const auto quad = [&](std::array<Vec3, 4> corners) {  // counterclockwise from outside, in cells; z is 0 or 1
    const auto first = std::uint32_t(mesh.vertices.size());
    for (const Vec3 p : corners) mesh.vertices.push_back({p.x * cell_mm, p.y * cell_mm, p.z * height_mm});
    mesh.triangles.insert(mesh.triangles.end(), {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
  };
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      if (!solid(i, j)) continue;
      const double x = i, y = j;
      quad({{{x, y, 0}, {x, y + 1, 0}, {x + 1, y + 1, 0}, {x + 1, y, 0}}});
      quad({{{x, y, 1}, {x + 1, y, 1}, {x + 1, y + 1, 1}, {x, y + 1, 1}}});
      if (!solid(i, j - 1)) quad({{{x, y, 0}, {x + 1, y, 0}, {x + 1, y, 1}, {x, y, 1}}});
      if (!solid(i, j + 1)) quad({{{x + 1, y + 1, 0}, {x, y + 1, 0}, {x, y + 1, 1}, {x + 1, y + 1, 1}}});
      if (!solid(i - 1, j)) quad({{{x, y + 1, 0}, {x, y, 0}, {x, y, 1}, {x, y + 1, 1}}});
      if (!solid(i + 1, j)) quad({{{x + 1, y, 0}, {x + 1, y + 1, 0}, {x + 1, y + 1, 1}, {x + 1, y, 1}}});
    }
  return mesh;
}

Mesh cube(double side = 20) {
  return box_mesh({0, 0, 0}, {side, side, side});
}

Printed printed_cube(std::string& text, const std::vector<std::string>& set, const std::string& print = "") {
  const TestFolder folder;
  Config config = config_of({.printer = "generic", .print = print, .set = set});
  config.join_perimeters = false;  // as the peers do
  text = sliced(folder, {cube()}, config).text;
  return replayed(text, config);
}

class StackedCubes : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    config = config_of({.printer = GetParam(), .print = "paper"});
    config.join_perimeters = false;  // as the peers do
    result = sliced(folder, {cube(), box_mesh({0, 0, 20}, {20, 20, 40})}, config);
    printed = replayed(result.text, config);
    const std::vector<Vec2>& bed = config.bed_shape_mm;
    // The middle of what both nozzles reach.
    Box<Vec2> reach;
    for (const Vec2 p :
         config.extruders[1].extruder_printable_area_mm.empty() ? bed : config.extruders[1].extruder_printable_area_mm)
      reach.add(p);
    middle = reach.center();
  }

  TestFolder folder;
  Config config;
  Sliced result;
  Printed printed;
  Vec2 middle;
};

// The lower one's top layer is cut at 19.95, below the border, and ends at 20.1.
TEST_P(StackedCubes, AreEachPrintedByTheirOwnTool) {
  EXPECT_EQ(result.summary.layers, 133);
  EXPECT_EQ(heights_of_tool(printed, 0), (std::pair{0.3, 20.1}));
  EXPECT_EQ(heights_of_tool(printed, 1), (std::pair{20.4, 39.9}));
}

TEST_P(StackedCubes, ChangeToolsOnce) {
  // And once more after the upper cube's nozzle was primed, which the peers leave out.
  EXPECT_EQ(result.summary.tool_changes, 2);
  EXPECT_EQ(printed.tools, (std::vector{1, 0, 1}));
  config.rampart = RampartShape::off;
  config.skirts = 0;
  config.prime_line_length_mm = 0;
  result = sliced(folder, {cube(), box_mesh({0, 0, 20}, {20, 20, 40})}, config);
  printed = replayed(result.text, config);
  EXPECT_EQ(result.summary.tool_changes, 1);
  EXPECT_EQ(printed.tools, (std::vector{0, 1}));
}

TEST_P(StackedCubes, LieWhereTheModelIsForBothNozzles) {
  for (const int tool : {0, 1}) {
    const Box<Vec2> box = box_of_tool(printed, tool);
    for (const double edge : {middle.x - box.min.x, box.max.x - middle.x, middle.y - box.min.y, box.max.y - middle.y})
      EXPECT_NEAR(edge, 9.8, 0.002) << "tool " << tool;
  }
}

TEST_P(StackedCubes, HaveLoopsAsLongAsThePeers) {
  // Centre lines 4 x 19.6 and 4 x (19.6 - 2 x 0.3356), each cut by 0.15 nozzles at the seam.
  std::map<std::string_view, int> count;
  for (const PrintedPath& path : paths_of(printed)) {
    if (!path.role.ends_with("erimeter")) continue;
    const bool outer = path.role == "External perimeter";
    EXPECT_NEAR(path.length_mm, outer ? 78.34 : 75.655, 0.02) << path.role << " in layer " << path.layer;
    ++count[outer ? "outer" : "inner"];
  }
  EXPECT_EQ(count["outer"], 133);
  EXPECT_EQ(count["inner"], 133);
}

INSTANTIATE_TEST_SUITE_P(OffsetsInFirmwareAndSlicer, StackedCubes,
                         testing::Values("replicator-dual", "generic-dual-marlin", "generic-dual-klipper",
                                         "rrf-toolchanger"),
                         [](const auto& of) {
                           std::string name = of.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Offsets, PositionInTheFileIsModelMinusOffsetWhereTheSlicerSubtracts) {
  const TestFolder folder;
  const std::vector<Mesh> meshes = {cube(), box_mesh({0, 0, 20}, {20, 20, 40})};
  Config config = config_of({.printer = "generic-dual-klipper", .print = "paper"});
  config.extruders[1].nozzle_offset_mm = {24.6, -1.3};
  Config none = config;
  none.offsets_in = OffsetsIn::firmware;  // read as if X and Y were the model's
  const Printed in_file = replayed(sliced(folder, meshes, config).text, none);
  const Printed in_model = replayed(sliced(folder, meshes, none).text, none);
  const Box<Vec2> file = box_of_tool(in_file, 1), model = box_of_tool(in_model, 1);
  EXPECT_NEAR(file.min.x, model.min.x - 24.6, 0.0015);
  EXPECT_NEAR(file.max.y, model.max.y + 1.3, 0.0015);
  EXPECT_EQ(box_of_tool(in_file, 0).min, box_of_tool(in_model, 0).min);
}

/// The loops of one layer in printing order, as in loops_of_layer.
std::vector<int> loops_of(const Mesh& mesh, int perimeters) {
  const TestFolder folder;
  const Config config =
      config_of({.printer = "generic", .set = {"perimeters=" + std::to_string(perimeters), "join_perimeters=0"}});
  return loops_of_layer(replayed(sliced(folder, {mesh}, config).text, config), 4);
}

TEST(SquaresWithHoles, ASquareHasItsLoopsFromTheInsideOut) {
  EXPECT_EQ(loops_of(drawn_body({"#"}, 100, 2), 3), (std::vector{0, 0, 1}));
}

TEST(SquaresWithHoles, AHoleHasAsManyLoopsAsTheSquareAroundIt) {
  const Mesh mesh = drawn_body({"#####",  //
                                "#####",  //
                                "##.##",  //
                                "#####",  //
                                "#####"},
                               20, 2);
  EXPECT_EQ(loops_of(mesh, 3), (std::vector{0, 0, 1, 0, 0, 1}));
}

TEST(SquaresWithHoles, ARingInARingHasTwelveLoops) {
  const Mesh mesh = drawn_body({"#########",  //
                                "#.......#",  //
                                "#.#####.#",  //
                                "#.#...#.#",  //
                                "#.#...#.#",  //
                                "#.#...#.#",  //
                                "#.#####.#",  //
                                "#.......#",  //
                                "#########"},
                               11, 2);
  EXPECT_EQ(loops_of(mesh, 3), (std::vector{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}));
}

TEST(SquaresWithHoles, FiveHolesOfTwoLoopsHaveTwelve) {
  const Mesh mesh = drawn_body({"#######",  //
                                "#.###.#",  //
                                "#######",  //
                                "###.###",  //
                                "#######",  //
                                "#.###.#",  //
                                "#######"},
                               7, 2);
  EXPECT_EQ(loops_of(mesh, 2), (std::vector{0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1}));
}

TEST(SquaresWithHoles, PrintTheOuterLoopFirstWhereAskedTo) {
  const TestFolder folder;
  const Config config = config_of({.printer = "generic", .set = {"perimeters=3", "external_perimeters_first=1"}});
  const Printed printed = replayed(sliced(folder, {box_mesh({0, 0, 0}, {50, 50, 2})}, config).text, config);
  EXPECT_EQ(loops_of_layer(printed, 4), (std::vector{1, 0, 0}));
}

TEST(Cube, IsSolidInAsManyLayersAtTopAndBottomAsAsked) {
  std::string text;
  for (const int top : {2, 3}) {
    SCOPED_TRACE(top);
    const Printed printed = printed_cube(
        text, {"layer_height=0.25", "first_layer_height=0.25", "bottom_solid_layers=1",
               "top_solid_layers=" + std::to_string(top), "solid_infill_below_area=0", "fill_density=15%"});
    ASSERT_EQ(printed.layer_z_mm.size(), 80u);
    std::set<int> solid, sparse;
    for (const PrintedRoad& road : printed.roads) {
      if (road.role == "Internal infill") sparse.insert(road.layer);
      if (road.role == "Solid infill" || road.role == "Top solid infill" || road.role == "Bridge infill")
        solid.insert(road.layer);
    }
    const std::set<int> expected = top == 2 ? std::set{0, 78, 79} : std::set{0, 77, 78, 79};
    EXPECT_EQ(solid, expected);
    EXPECT_EQ(sparse.size(), 80 - expected.size());
    for (const int layer : sparse) EXPECT_FALSE(solid.contains(layer)) << layer;
  }
}

TEST(Cube, HasThreeLoopsInEachOf66LayersAtThePeersDefaults) {
  std::string text;
  const Printed printed = printed_cube(text, {"layer_height=0.3", "first_layer_height=0.35", "perimeters=3"});
  ASSERT_EQ(printed.layer_z_mm.size(), 66u);
  EXPECT_DOUBLE_EQ(printed.layer_z_mm.front(), 0.35);
  for (std::size_t k = 1; k < 66; ++k) EXPECT_NEAR(printed.layer_z_mm[k] - printed.layer_z_mm[k - 1], 0.3, 1e-6);
  for (int k = 0; k < 66; ++k) EXPECT_EQ(loops_of_layer(printed, k), (std::vector{0, 0, 1})) << k;
}

TEST(Cube, Of20mmIsPrintedUpToExactly20mm) {
  std::string text;
  const Printed printed = printed_cube(text, {"layer_height=0.2", "first_layer_height=0.2"});
  EXPECT_EQ(heights_of_tool(printed, 0), (std::pair{0.2, 20.0}));
}

TEST(Cube, FeedsEqualFilamentPerMillimetreOfEqualRoads) {
  std::string text;
  const Printed printed = printed_cube(text, {}, "paper");
  // 0.3 (0.4 - 0.3 (1 - pi / 4)) of plastic out of a filament of 1.75 mm.
  const double expected = 0.3 * (0.4 - 0.3 * (1 - std::numbers::pi / 4)) / (std::numbers::pi / 4 * 1.75 * 1.75);
  for (const PrintedRoad& road : printed.roads) {
    const double length = distance(road.from, road.to);
    if (road.role == "Bridge infill" || length < 5) continue;
    EXPECT_NEAR(road.filament_mm / length, expected, 0.01 * expected) << road.role;
  }
}

TEST(Progress, NeverPassesThe100PercentAtWhichFirmwareMayEndThePrint) {
  const TestFolder folder;
  for (const char* printer : {"replicator-dual", "generic-dual-marlin", "generic-dual-klipper", "rrf-toolchanger"}) {
    SCOPED_TRACE(printer);
    const Config config = config_of({.printer = printer});
    const Sliced result = sliced(folder, {cube(), box_mesh({20, 0, 0}, {40, 20, 20})}, config);
    const Printed printed = replayed(result.text, config);
    ASSERT_GT(printed.percents.size(), 10u);
    EXPECT_EQ(printed.percents.front(), 0);
    EXPECT_EQ(printed.percents.back(), 100);
    EXPECT_TRUE(std::is_sorted(printed.percents.begin(), printed.percents.end()));
    EXPECT_EQ(std::count(printed.percents.begin(), printed.percents.end(), 100), 1);
    EXPECT_FALSE(printed.roads_after_100_percent);
  }
}

/// Where the outer loops begin, from the middle of the bed.
std::vector<Vec2> seams(SeamPosition position) {
  const TestFolder folder;
  Config config = config_of({.printer = "generic", .set = {"layer_height=0.3", "first_layer_height=0.3"}});
  config.seam_position = position;
  config.join_perimeters = false;
  const Printed printed = replayed(sliced(folder, {cube()}, config).text, config);
  std::vector<Vec2> result;
  for (const PrintedPath& path : paths_of(printed))
    if (path.role == "External perimeter") result.push_back(path.points.front() - Vec2{100, 100});
  return result;
}

bool is_corner(Vec2 p) {
  return std::abs(p.x) > 9.5 && std::abs(p.y) > 9.5;
}

TEST(Seam, AlignedStaysInOneCorner) {
  const auto at = seams(SeamPosition::aligned);
  ASSERT_EQ(at.size(), 67u);
  for (const Vec2 p : at) EXPECT_TRUE(is_corner(p) && distance(p, at.front()) < 0.5) << p.x << " " << p.y;
}

TEST(Seam, RearLiesAtTheBack) {
  const auto at = seams(SeamPosition::rear);
  ASSERT_EQ(at.size(), 67u);
  for (const Vec2 p : at) EXPECT_GT(p.y, 9.5);
}

TEST(Seam, NearestPrefersCorners) {
  const auto at = seams(SeamPosition::nearest);
  ASSERT_EQ(at.size(), 67u);
  for (const Vec2 p : at) EXPECT_TRUE(is_corner(p)) << p.x << " " << p.y;
}

TEST(Seam, RandomIsSpreadOverAllSides) {
  std::map<std::pair<bool, bool>, int> quadrants;
  for (const Vec2 p : seams(SeamPosition::random)) ++quadrants[{p.x > 0, p.y > 0}];
  ASSERT_EQ(quadrants.size(), 4u);
  for (const auto& [quadrant, count] : quadrants) EXPECT_GT(count, 6);
}

}  // namespace
}  // namespace cleancolor
