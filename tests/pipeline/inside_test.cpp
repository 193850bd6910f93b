// Plastic stays inside the outline, for shapes that have led it astray.

#include <gtest/gtest.h>

#include "model/settings.hpp"
#include "replay.hpp"
#include "slicing.hpp"

namespace cleancolor {
namespace {

using namespace test;

/// An upright prism over a convex outline that runs counterclockwise.
Mesh prism(const std::vector<Vec2>& outline, double bottom, double top) {
  Mesh mesh;
  const auto n = std::uint32_t(outline.size());
  for (const double z : {bottom, top})
    for (const Vec2 p : outline) mesh.vertices.push_back({p.x, p.y, z});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    mesh.triangles.insert(mesh.triangles.end(), {{i, next, n + next}, {i, n + next, n + i}});
    if (i > 1) mesh.triangles.insert(mesh.triangles.end(), {{0, i, i - 1}, {n, n + i - 1, n + i}});
  }
  return mesh;
}

// ..####..
// .######.   corners cut by 1 mm: the ceiling over sparse infill must not grow sharp corners again
// ########
// .######.
// ..####..
TEST(Inside, SolidOverSparseInfillKeepsToCutCorners) {
  const std::vector<Vec2> outline = {{1, 0}, {29, 0}, {30, 1}, {30, 29}, {29, 30}, {1, 30}, {0, 29}, {0, 1}};
  const TestFolder folder;
  const Config config = config_of({.printer = "generic", .set = {"fill_density=10%", "top_solid_layers=2"}});
  const Sliced result = sliced(folder, {prism(outline, 0, 4)}, config);
  const Printed printed = replayed(result.text, config);
  int bridges = 0;
  for (const PrintedRoad& road : printed.roads) {
    bridges += road.role == "Bridge infill";
    if (!is_of_the_model(road.role)) continue;
    // The prism stands in the middle of the bed; its cut corners lie 29 mm from there as one walks along X and Y.
    const Vec2 p = road.to - Vec2{100, 100};
    ASSERT_LE(std::abs(p.x) + std::abs(p.y), 29.01) << road.role << " at " << p.x << " " << p.y;
  }
  EXPECT_GT(bridges, 10);
}

TEST(Inside, AFillTooSmallForALineIsNotTravelledTo) {
  // A cone: the solid rings under its flank break up into crumbs.
  std::vector<Vec2> circle;
  for (int i = 0; i < 60; ++i) circle.push_back({15 * std::cos(i * 0.10471976), 15 * std::sin(i * 0.10471976)});
  Mesh cone = prism(circle, 0, 40);
  for (Vec3& p : cone.vertices)
    if (p.z > 0) p = {p.x * 0.1, p.y * 0.1, p.z};
  const TestFolder folder;
  const Config config = config_of({.printer = "generic", .print = "paper"});
  const Printed printed = replayed(sliced(folder, {cone}, config).text, config);
  EXPECT_EQ(printed.broken, std::vector<std::string>{});
  for (const PrintedPath& path : paths_of(printed))
    EXPECT_GT(path.length_mm, 0.1) << path.role << " in layer " << path.layer;
}

TEST(FirstLayer, WithNothingInItIsRefusedAndLeavesNoFile) {
  std::vector<Vec2> circle;
  for (int i = 0; i < 60; ++i) circle.push_back({5 * std::cos(i * 0.10471976), 5 * std::sin(i * 0.10471976)});
  Mesh on_its_tip = prism(circle, 0, 100);
  for (Vec3& p : on_its_tip.vertices)
    if (p.z == 0) p = {p.x * 1e-4, p.y * 1e-4, 0};
  const TestFolder folder;
  Config config = config_of({.printer = "generic", .set = {"brim_width=5"}});
  SliceRequest request = request_for({stl_file(folder, "tip.stl", on_its_tip)}, config, folder.path("tip.gcode"));
  request.preview = folder.path("tip.png");
  EXPECT_ERROR(slice(request), "stands on a tip");
  EXPECT_FALSE(std::filesystem::exists(request.output));
  EXPECT_FALSE(std::filesystem::exists(request.preview));
}

TEST(FirstLayer, IsBegunWithTheOnlyExtruderThatPrints) {
  const TestFolder folder;
  const Config config = config_of({.printer = "generic-dual-marlin"});
  SliceRequest request =
      request_for({stl_file(folder, "cube.stl", box_mesh({0, 0, 0}, {10, 10, 2}))}, config, folder.path("cube.gcode"));
  request.files[0].extruder = 1;
  const Sliced result = sliced(request);
  EXPECT_EQ(result.text.find("\nT0"), std::string::npos);
  EXPECT_NE(result.text.find("\nT1"), std::string::npos);
}

}  // namespace
}  // namespace cleancolor
