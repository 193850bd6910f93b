#include "model/check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "meshes.hpp"
#include "model/edges.hpp"
#include "model/shells.hpp"

namespace cleancolor {
namespace {

const Mesh cube = box_mesh({0, 0, 0}, {20, 20, 20});

bool is_closed(const Mesh& mesh) {
  const std::vector<EdgeUse> uses = edge_uses(mesh);
  for (std::size_t i = 0, n = 0; i < uses.size(); i += n) {
    n = edge_size(uses, i);
    if (edge_balance(std::span(uses).subspan(i, n)) != 0) return false;
  }
  return true;
}

TEST(Check, LeavesASoundMeshAsItIs) {
  Warnings warnings;
  const Mesh mesh = checked(cube, "cube", warnings.progress);
  EXPECT_EQ(mesh.triangles, cube.triangles);
  EXPECT_EQ(warnings.texts.size(), 0) << warnings.all();
}

TEST(Check, WeldsTrianglesThatComeWithVerticesOfTheirOwn) {
  Warnings warnings;
  const Mesh mesh = checked(soup(cube), "cube", warnings.progress);
  EXPECT_EQ(mesh.vertices.size(), 8);
  EXPECT_DOUBLE_EQ(volume_mm3(mesh), 8000);
  EXPECT_EQ(warnings.texts.size(), 0) << warnings.all();
}

TEST(Check, JoinsVerticesThatRoundingHasParted) {
  Mesh parted = soup(cube);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-2e-5, 2e-5);
  for (Vec3& p : parted.vertices) p = p + Vec3{noise(random), noise(random), noise(random)};
  Warnings warnings;
  const Mesh mesh = checked(parted, "cube", warnings.progress);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_NEAR(volume_mm3(mesh), 8000, 0.1);
  EXPECT_TRUE(warnings.contain("joined")) << warnings.all();
}

TEST(Check, TurnsAMeshThatIsInsideOut) {
  Warnings warnings;
  EXPECT_DOUBLE_EQ(volume_mm3(checked(inside_out(cube), "cube", warnings.progress)), 8000);
  EXPECT_TRUE(warnings.contain("1 shell was inside out")) << warnings.all();
}

TEST(Check, TurnsTheFewTrianglesThatFaceTheWrongWay) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Mesh mixed = cube;
    for (int k = 0; k < 3; ++k) {
      Triangle& t = mixed.triangles[random() % mixed.triangles.size()];
      std::swap(t[1], t[2]);
    }
    const Mesh mesh = checked(mixed, "cube");
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_DOUBLE_EQ(volume_mm3(mesh), 8000);
  }
}

TEST(Check, KeepsACavity) {
  const Mesh hollow = joined(cube, inside_out(box_mesh({6, 6, 6}, {14, 14, 14})));
  Warnings warnings;
  EXPECT_DOUBLE_EQ(volume_mm3(checked(hollow, "hollow", warnings.progress)), 8000 - 512);
  EXPECT_EQ(warnings.texts.size(), 0) << warnings.all();
}

TEST(Check, TurnsACavityTogetherWithTheShellAroundIt) {
  const Mesh hollow = inside_out(joined(cube, inside_out(box_mesh({6, 6, 6}, {14, 14, 14}))));
  Warnings warnings;
  EXPECT_DOUBLE_EQ(volume_mm3(checked(hollow, "hollow", warnings.progress)), 8000 - 512);
  EXPECT_TRUE(warnings.contain("2 shells were inside out")) << warnings.all();
}

TEST(Check, TurnsOnlyTheBodyThatIsInsideOut) {
  const Mesh two = joined(cube, inside_out(box_mesh({30, 0, 0}, {40, 10, 10})));
  EXPECT_DOUBLE_EQ(volume_mm3(checked(two, "two")), 9000);
}

TEST(Check, ClosesFlatHolesOfAnySize) {
  Mesh open = cube;
  open.triangles.erase(open.triangles.begin(), open.triangles.begin() + 2);
  Warnings warnings;
  const Mesh mesh = checked(open, "cube", warnings.progress);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_DOUBLE_EQ(volume_mm3(mesh), 8000);
  EXPECT_TRUE(warnings.contain("1 hole closed")) << warnings.all();
}

TEST(Check, ClosesHolesThatMeetInAVertex) {
  // Two triangles of the bottom gone that touch in its middle: their rims together pass the middle twice.
  Mesh open = cube;
  open.triangles.erase(open.triangles.begin(), open.triangles.begin() + 2);
  open.vertices.push_back({10, 10, 0});
  open.triangles.push_back({0, 8, 1});
  open.triangles.push_back({3, 8, 2});
  const Mesh mesh = checked(open, "cube");
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_DOUBLE_EQ(volume_mm3(mesh), 8000);
}

TEST(Check, RefusesLargeHolesThatAreNotFlat) {
  Mesh open = cube;  // bottom and front are gone: the rim is bent
  open.triangles.erase(open.triangles.begin() + 4, open.triangles.begin() + 6);
  open.triangles.erase(open.triangles.begin(), open.triangles.begin() + 2);
  Warnings warnings;
  EXPECT_TRUE(says(refusal([&] { checked(open, "cube", warnings.progress); }), "cube: the surface is open: 1 hole"));
  EXPECT_EQ(warnings.texts.size(), 0) << "a refusal is one message: " << warnings.all();
}

TEST(Check, DropsTrianglesPresentTwice) {
  Mesh twice = cube;
  twice.triangles.insert(twice.triangles.end(), cube.triangles.begin(), cube.triangles.end());
  Warnings warnings;
  const Mesh mesh = checked(twice, "cube", warnings.progress);
  EXPECT_EQ(mesh.triangles.size(), 12);
  EXPECT_TRUE(warnings.contain("12 triangles were present twice")) << warnings.all();
}

TEST(Check, DropsTrianglesWithoutArea) {
  Mesh more = cube;
  more.triangles.push_back({1, 1, 2});
  Warnings warnings;
  EXPECT_EQ(checked(more, "cube", warnings.progress).triangles.size(), 12);
  EXPECT_TRUE(warnings.contain("1 triangle without area")) << warnings.all();
}

TEST(Check, AcceptsBodiesThatMeetInAnEdge) {
  Warnings warnings;
  const Mesh mesh = checked(joined(cube, box_mesh({20, 20, 0}, {30, 30, 20})), "two", warnings.progress);
  EXPECT_DOUBLE_EQ(volume_mm3(mesh), 10'000);
  EXPECT_TRUE(warnings.contain("four or more")) << warnings.all();
}

TEST(Check, AcceptsBodiesThatMeetInAVertex) {
  Warnings warnings;
  const Mesh mesh = checked(joined(cube, box_mesh({20, 20, 20}, {30, 30, 30})), "two", warnings.progress);
  EXPECT_DOUBLE_EQ(volume_mm3(mesh), 9000);
  EXPECT_TRUE(warnings.contain("touch in 1 vertex")) << warnings.all();
}

TEST(Check, WarnsOfBodiesThatOverlapButNotOfOnesThatShareAFace) {
  Warnings overlapping, touching;
  checked(joined(cube, box_mesh({10, 10, 10}, {30, 30, 30})), "two", overlapping.progress);
  EXPECT_TRUE(overlapping.contain("united")) << overlapping.all();
  checked(joined(cube, box_mesh({20, 5, 5}, {30, 15, 15})), "two", touching.progress);
  EXPECT_FALSE(touching.contain("united")) << touching.all();
}

TEST(Check, RefusesWhatEnclosesNoVolume) {
  const Mesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  EXPECT_TRUE(says(refusal([&] { checked(triangle, "t"); }), "flat"));
  EXPECT_TRUE(says(refusal([&] { checked(box_mesh({0, 0, 0}, {20, 20, 0}), "t"); }), "flat"));
  EXPECT_TRUE(says(refusal([&] { checked(Mesh{}, "t"); }), "no triangles"));
}

TEST(Check, RefusesASurfaceWithOneSide) {
  // A Moebius strip of 8 quads: the last joins the first turned over.
  Mesh strip;
  for (int i = 0; i < 8; ++i) {
    const double a = i * 3.14159265 / 4, half = a / 2;
    for (const double side : {-1.0, 1.0})
      strip.vertices.push_back({(10 + side * std::cos(half)) * std::cos(a), (10 + side * std::cos(half)) * std::sin(a),
                                side * std::sin(half)});
  }
  for (std::uint32_t i = 0; i < 8; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * i + 1;
    const std::uint32_t c = i == 7 ? 1 : a + 2, d = i == 7 ? 0 : b + 2;
    strip.triangles.push_back({a, c, b});
    strip.triangles.push_back({b, c, d});
  }
  EXPECT_TRUE(says(refusal([&] { checked(strip, "strip"); }), "one side"));
}

TEST(Check, RefusesNumbersThatAreNotFinite) {
  Mesh broken = cube;
  broken.vertices[3].y = std::nan("");
  EXPECT_TRUE(says(refusal([&] { checked(broken, "cube"); }), "not finite"));
}

TEST(Winding, IsOneInsideZeroOutsideAndMinusOneInsideAnInwardShell) {
  std::vector<std::uint32_t> all(12);
  for (std::uint32_t i = 0; i < 12; ++i) all[i] = i;
  EXPECT_NEAR(winding(cube, all, {10, 10, 10}), 1, 1e-9);
  EXPECT_NEAR(winding(cube, all, {10, 10, 30}), 0, 1e-9);
  EXPECT_NEAR(winding(inside_out(cube), all, {1, 2, 3}), -1, 1e-9);
}

TEST(Edges, ComeInOrderWithAllTheirSidesTogether) {
  const std::vector<EdgeUse> uses = edge_uses(cube);
  ASSERT_EQ(uses.size(), 36);
  EXPECT_TRUE(std::is_sorted(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.half_edge) < std::tie(b.low, b.high, b.half_edge);
  }));
  std::size_t edges = 0;
  for (std::size_t i = 0; i < uses.size(); i += edge_size(uses, i)) ++edges;
  EXPECT_EQ(edges, 18);  // 12 of the cube, 6 diagonals
}

}  // namespace
}  // namespace cleancolor
