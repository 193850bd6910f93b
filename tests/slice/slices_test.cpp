#include "slice/slices.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "model/meshes.hpp"
#include "slice/contours.hpp"

namespace cleancolor {
namespace {

Part part(Mesh mesh, int extruder, std::string name = "part") {
  Part p;
  p.name = std::move(name);
  p.mesh = std::move(mesh);
  p.extruder = extruder;
  return p;
}

Mesh cylinder(int sides, double radius, double height) {
  Mesh mesh;
  for (const double z : {0.0, height}) {
    mesh.vertices.push_back({0, 0, z});
    for (int i = 0; i < sides; ++i) {
      const double a = 2 * std::numbers::pi * i / sides;
      mesh.vertices.push_back({radius * std::cos(a), radius * std::sin(a), z});
    }
  }
  const auto n = std::uint32_t(sides);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 1 + i, b = 1 + (i + 1) % n, top = n + 1;
    mesh.triangles.insert(mesh.triangles.end(),
                          {{0, b, a}, {top, top + a, top + b}, {a, b, top + b}, {a, top + b, top + a}});
  }
  return mesh;
}

TEST(Slabs, CutEachLayerAtItsMiddle) {
  const auto at = [](double top, double first, double height) { return slabs(top, first, height); };
  EXPECT_EQ(at(20, 0.25, 0.25).size(), 80u);
  EXPECT_EQ(at(20, 0.35, 0.3).size(), 66u);
  EXPECT_EQ(at(40, 0.3, 0.3).size(), 133u);  // stacked cubes: the last layer's middle is below 40
  EXPECT_NEAR(at(40, 0.3, 0.3).back().print_z_mm, 39.9, 1e-9);
  EXPECT_EQ(at(20, 0.2, 0.2).size(), 100u);
  EXPECT_NEAR(at(20, 0.2, 0.2).back().print_z_mm, 20, 1e-9);
  EXPECT_EQ(at(20, 0.1, 0.1).size(), 200u);
}

TEST(Slabs, BeginWithTheFirstLayerAndGrowByConstantSteps) {
  const auto layers = slabs(10, 0.35, 0.3);
  EXPECT_DOUBLE_EQ(layers[0].print_z_mm, 0.35);
  EXPECT_DOUBLE_EQ(layers[0].height_mm, 0.35);
  for (std::size_t i = 1; i < layers.size(); ++i)
    EXPECT_NEAR(layers[i].print_z_mm - layers[i - 1].print_z_mm, 0.3, 1e-9);
}

TEST(Slabs, OfSomethingFlatterThanHalfALayerAreNone) {
  EXPECT_TRUE(slabs(0.1, 0.3, 0.3).empty());
}

TEST(CrossSection, OfACubeAtItsBottomAndTopIsItsSquare) {
  const Mesh cube = box_mesh({0, 0, 5}, {20, 20, 25});
  for (const double z : {5.0, 15.0, 25.0}) EXPECT_NEAR(area_mm2(cross_section(cube, z)), 400, 1e-6) << z;
  EXPECT_TRUE(cross_section(cube, 4.999).empty());
  EXPECT_TRUE(cross_section(cube, 25.001).empty());
}

TEST(CrossSection, RunsCounterclockwiseAroundSolidAndClockwiseAroundHoles) {
  const Mesh shell = joined(box_mesh({0, 0, 0}, {20, 20, 20}), inside_out(box_mesh({5, 5, 5}, {15, 15, 15})));
  const Polygons section = PlaneCuts(shell, std::vector<double>{10.0}).rings(0);
  ASSERT_EQ(section.size(), 2u);
  EXPECT_NEAR(area_mm2(section), 400 - 100, 1e-6);
  EXPECT_EQ(ClipperLib::Orientation(section[0]), !ClipperLib::Orientation(section[1]));
}

TEST(CrossSection, UnitesBodiesThatInterpenetrate) {
  const Mesh two = joined(box_mesh({0, 0, 0}, {10, 10, 10}), box_mesh({5, 5, 0}, {15, 15, 10}));
  EXPECT_NEAR(area_mm2(cross_section(two, 5)), 175, 1e-6);
}

// One triangle among others: which of its corners touch the plane decides what it adds to the contour.
TEST(CrossSection, TakesATriangleThatTouchesThePlaneOnce) {
  const auto edges = [](double a, double b, double c) {
    Mesh mesh;
    mesh.vertices = {{3, 4, a}, {8, 5, b}, {1, 9, c}, {4, 6, -100}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
    return PlaneCuts(mesh, std::vector<double>{20.0}).rings(0);
  };
  EXPECT_TRUE(edges(20, 15, 10).empty());   // one corner from below: nothing
  EXPECT_EQ(edges(20, 20, 20).size(), 1u);  // the top face: taken just below
  EXPECT_EQ(edges(28, 20, 30).size(), 1u);
  for (const auto& ring : edges(22, 20, 20)) EXPECT_EQ(ring.size(), 3u);
}

TEST(Slices, OfACylinderFollowTheCircle) {
  const Part p = part(cylinder(1000, 10, 10), 0);
  const Slices layers = slices(std::span(&p, 1), {.first_layer_height_mm = 0.2, .layer_height_mm = 0.2});
  ASSERT_EQ(layers.slabs.size(), 50u);
  Ring circle;
  for (int i = 0; i < 1000; ++i) {
    const double a = 2 * std::numbers::pi * i / 1000;
    circle.push_back(to_nm({10 * std::cos(a), 10 * std::sin(a)}));
  }
  for (const auto& layer : layers.regions) {
    ASSERT_EQ(layer[0].size(), 1u);
    const double both = area_mm2(intersection(layer[0], {circle}));
    const double apart = area_mm2(layer[0]) + area_mm2(circle) - 2 * both;
    EXPECT_LE(apart / area_mm2(circle), 0.002);
  }
}

TEST(Slices, OfTwoColoursThatShareACurvedFaceTouchWithoutGapOrOverlap) {
  // A peg in a hole: the same 200-gon from both sides, but with other vertex numbers and another start.
  const Mesh peg = cylinder(200, 8, 10);
  Mesh hole = inside_out(peg);
  std::rotate(hole.triangles.begin(), hole.triangles.begin() + 77, hole.triangles.end());
  const Part parts[] = {part(joined(box_mesh({-15, -15, 0}, {15, 15, 10}), hole), 0), part(peg, 1)};
  const Slices layers = slices(parts, {.extruders = 2});
  for (std::size_t k = 0; k < layers.slabs.size(); ++k) {
    const std::vector<Polygons> regions = unpacked(layers.regions[k]);
    EXPECT_NEAR(area_mm2(regions[0]) + area_mm2(regions[1]), 900, 1e-6);
    EXPECT_NEAR(area_mm2(intersection(regions[0], regions[1])), 0, 1e-6);
    EXPECT_EQ(layers.outlines[k].size(), 1u);  // no slit between them
    EXPECT_LT(regions[1][0].size(), 120u);     // and both were thinned out
  }
}

TEST(Slices, RefuseAWideOverlapAndSayWhereAndWhatToDo) {
  const Part parts[] = {part(box_mesh({0, 0, 0}, {20, 20, 20}), 0, "left.stl"),
                        part(box_mesh({15, 0, 0}, {35, 20, 20}), 1, "right.stl")};
  const std::string text = refusal([&] { slices(parts, {.extruders = 2}); });
  for (const char* word : {"left.stl", "right.stl", "100.00 mm2", "--overlap", "extruder 2"})
    EXPECT_TRUE(says(text, word));
}

TEST(Slices, GiveAWideOverlapToTheOneThatWasAskedFor) {
  const Part parts[] = {part(box_mesh({0, 0, 0}, {20, 20, 20}), 0), part(box_mesh({15, 0, 0}, {35, 20, 20}), 1)};
  const auto areas = [&](Overlap rule) {
    Warnings warnings;
    const Slices layers = slices(parts, {.extruders = 2, .overlap = rule}, warnings.progress);
    EXPECT_TRUE(warnings.contain("overlap"));
    return std::pair(area_mm2(layers.regions[10][0]), area_mm2(layers.regions[10][1]));
  };
  EXPECT_NEAR(areas(Overlap::first).first, 400, 1e-6);
  EXPECT_NEAR(areas(Overlap::first).second, 300, 1e-6);
  EXPECT_NEAR(areas(Overlap::last).first, 300, 1e-6);
  EXPECT_NEAR(areas(Overlap::last).second, 400, 1e-6);
}

TEST(Slices, MendANarrowOverlapWithAWarning) {
  const Part parts[] = {part(box_mesh({0, 0, 0}, {20, 20, 20}), 0), part(box_mesh({19.97, 0, 0}, {40, 20, 20}), 1)};
  Warnings warnings;
  const Slices layers = slices(parts, {.extruders = 2}, warnings.progress);
  EXPECT_TRUE(warnings.contain("overlap by less than 0.05 mm, 12."));  // 0.03 x 20 x 20
  EXPECT_NEAR(area_mm2(layers.regions[5][1]), 20 * 20, 1e-3);
}

TEST(Slices, AcceptASharedFaceAndAGapOfAMicrometreInSilence) {
  for (const double gap : {0.0, 0.001}) {
    const Part parts[] = {part(box_mesh({0, 0, 0}, {20, 20, 20}), 0),
                          part(box_mesh({20 + gap, 0, 0}, {40, 20, 20}), 1)};
    Warnings warnings;
    slices(parts, {.extruders = 2}, warnings.progress);
    EXPECT_EQ(warnings.all(), "");
  }
}

TEST(Slices, WarnOfWhatBeginsInMidAir) {
  const Part parts[] = {part(box_mesh({0, 0, 0}, {10, 10, 20}), 0), part(box_mesh({20, 0, 10}, {30, 10, 20}), 1)};
  Warnings warnings;
  slices(parts, {.extruders = 2}, warnings.progress);
  EXPECT_TRUE(warnings.contain("1 piece begins in mid-air"));
}

TEST(Slices, RefuseWhatIsFlatterThanHalfALayer) {
  const Part p = part(box_mesh({0, 0, 0}, {10, 10, 0.05}), 0);
  EXPECT_TRUE(says(refusal([&] { slices(std::span(&p, 1), {}); }), "0.050 mm high"));
}

TEST(Slices, CloseCracksButNotGapsNorWhatAnotherExtruderPrints) {
  // A 20 mm block in two halves with a crack of 0.06 mm between them; then a gap of 0.2 mm; then the crack is filled.
  const auto halves = [](double gap) {
    return joined(box_mesh({0, 0, 0}, {10, 20, 5}), box_mesh({10 + gap, 0, 0}, {20, 20, 5}));
  };
  const Part cracked = part(halves(0.06), 0), gapped = part(halves(0.2), 0);
  EXPECT_NEAR(area_mm2(slices(std::span(&cracked, 1), {}).regions[3][0]), 400, 0.01);
  EXPECT_EQ(slices(std::span(&cracked, 1), {}).regions[3][0].size(), 1u);
  EXPECT_NEAR(area_mm2(slices(std::span(&cracked, 1), {.closing_radius_mm = 0}).regions[3][0]), 400 - 0.06 * 20, 1e-6);
  EXPECT_NEAR(area_mm2(slices(std::span(&gapped, 1), {}).regions[3][0]), 400 - 0.2 * 20, 1e-6);
  const Part filled[] = {part(halves(0.06), 0), part(box_mesh({10, 0, 0}, {10.06, 20, 5}), 1)};
  const Slices both = slices(filled, {.extruders = 2});
  EXPECT_NEAR(area_mm2(both.regions[3][1]), 0.06 * 20, 1e-6);
  EXPECT_NEAR(area_mm2(both.regions[3][0]), 400 - 0.06 * 20, 1e-3);
}

TEST(Slices, CloseACrackUpToItsEnds) {
  // A plate with a slit of 0.08 x 2 mm in it, turned so that its ends are not square to anything.
  Mesh slit = inside_out(box_mesh({-1, -0.04, -1}, {1, 0.04, 6}));
  for (Vec3& v : slit.vertices) v = {10 + 0.8 * v.x - 0.6 * v.y, 10 + 0.6 * v.x + 0.8 * v.y, v.z < 0 ? 0.0 : 5.0};
  const Part plate = part(joined(box_mesh({0, 0, 0}, {20, 20, 5}), slit), 0);
  for (const auto& layer : slices(std::span(&plate, 1), {}).regions) {
    EXPECT_EQ(layer[0].size(), 1u);
    EXPECT_NEAR(area_mm2(layer[0]), 400, 1e-3);
  }
}

TEST(Slices, CompensationMovesTheOutsideButNotTheBorderBetweenColours) {
  const Part parts[] = {part(box_mesh({0, 0, 0}, {20, 20, 5}), 0), part(box_mesh({20, 0, 0}, {40, 20, 5}), 1)};
  for (const double delta : {0.2, -0.2}) {
    const Slices layers = slices(parts, {.extruders = 2, .xy_size_compensation_mm = delta});
    const Polygons left = layers.regions[3][0], right = layers.regions[3][1];
    EXPECT_NEAR(area_mm2(left) + area_mm2(right), (40 + 2 * delta) * (20 + 2 * delta), 1e-6);
    EXPECT_NEAR(area_mm2(intersection(left, right)), 0, 1e-9);
    const Polygons middle = rectangle({19, 9}, {21, 11});
    EXPECT_NEAR(bounds_mm(intersection(left, middle)).max.x, 20, 1e-6);
    EXPECT_NEAR(bounds_mm(intersection(right, middle)).min.x, 20, 1e-6);
  }
}

TEST(Slices, ElephantFootSparesWhatItWouldEatUp) {
  const Part p = part(joined(box_mesh({0, 0, 0}, {20, 20, 5}), box_mesh({30, 0, 0}, {30.3, 20, 5})), 0);
  const Slices layers = slices(std::span(&p, 1), {.elefant_foot_compensation_mm = 0.2});
  EXPECT_NEAR(area_mm2(layers.regions[0][0]), 19.6 * 19.6 + 0.3 * 20, 1e-3);
  EXPECT_NEAR(area_mm2(layers.regions[1][0]), 400 + 0.3 * 20, 1e-3);
}

TEST(Slices, AreTheSameOnAnyNumberOfThreads) {
  const Part parts[] = {part(cylinder(300, 12, 30), 0), part(cylinder(300, 12, 30), 0)};
  const Slices one = slices(parts, {.threads = 1}), four = slices(parts, {.threads = 4});
  EXPECT_EQ(one.regions, four.regions);
}

}  // namespace
}  // namespace cleancolor
