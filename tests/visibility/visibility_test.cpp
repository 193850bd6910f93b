#include "visibility/visibility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cleancolor {
namespace {

SurfaceVisibility of(const std::vector<Polygons>& layers, double voxel_mm = 0.5, int threads = 2) {
  const std::vector<double> heights(layers.size(), 0.2);
  return SurfaceVisibility(layers, heights, {.voxel_mm = voxel_mm, .threads = threads});
}

std::vector<Polygons> prism(const Polygons& outline, int layers) {
  return std::vector<Polygons>(std::size_t(layers), outline);
}

TEST(SurfaceVisibility, OfATopIsOneAndOfAWallOverTheBedHalfOfTheSky) {
  const SurfaceVisibility v = of(prism(rectangle({0, 0}, {20, 20}), 300));
  EXPECT_NEAR(v.at({10, 10, 60}), 1, 0.03);
  EXPECT_NEAR(v.at({0.2, 10, 50}), 1, 0.05);  // higher than rays are long
  EXPECT_NEAR(v.at({0.2, 10, 0.2}), 0.5, 0.05);
}

TEST(SurfaceVisibility, DeepInsideIsNothing) {
  const SurfaceVisibility v = of(prism(rectangle({0, 0}, {20, 20}), 100));
  EXPECT_EQ(v.at({10, 10, 10}), 0);
  EXPECT_EQ(v.at({3, 10, 10}), 0);
}

TEST(SurfaceVisibility, OfAGrooveFollowsItsDepth) {
  // Between two high walls 4 mm apart, each 40 mm high and long: at depth d the sky above the wall opposite.
  Polygons walls = rectangle({0, 0}, {10, 60});
  for (const Ring& ring : rectangle({14, 0}, {24, 60})) walls.push_back(ring);
  const SurfaceVisibility v = of(prism(walls, 200), 0.25);
  double before = 2;
  for (const double depth : {1., 3., 6., 12., 20.}) {
    const double at = v.at({9.8, 30, 40 - depth});
    EXPECT_LT(at, before) << depth;
    before = at;
  }
  EXPECT_LT(before, 0.2);
  EXPECT_NEAR(v.at({0.2, 30, 36}), 1, 0.05) << "the outer side";
}

TEST(SurfaceVisibility, AThinWallHidesWhatStandsBehindIt) {
  // Walls of 0.3 mm in both directions around a tower.
  Polygons outline = rectangle({0, 0}, {20, 20});
  for (Ring ring : rectangle({0.3, 0.3}, {19.7, 19.7})) {
    ClipperLib::ReversePath(ring);
    outline.push_back(ring);
  }
  for (const Ring& ring : rectangle({8, 8}, {12, 12})) outline.push_back(ring);
  std::vector<Polygons> layers = prism(outline, 100);
  layers.back() = rectangle({0, 0}, {20, 20});  // a lid
  const SurfaceVisibility v = of(layers);
  EXPECT_LT(v.at({8.2, 10, 10}), 0.02);
  EXPECT_GT(v.at({0.15, 10, 10}), 0.5);
}

TEST(SurfaceVisibility, IsTheSameForAnyNumberOfThreads) {
  const auto layers = prism(rectangle({0, 0}, {13.3, 7.1}), 50);
  const SurfaceVisibility one = of(layers, 0.5, 1), four = of(layers, 0.5, 4);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p{std::fmod(i * 0.37, 14.), std::fmod(i * 0.71, 8.), std::fmod(i * 0.13, 11.)};
    EXPECT_EQ(one.at(p), four.at(p));
  }
}

TEST(SurfaceVisibility, OfNothingIsOne) {
  EXPECT_EQ(of({}).at({1, 2, 3}), 1);
  EXPECT_EQ(of({{}, {}}).at({1, 2, 3}), 1);
}

}  // namespace
}  // namespace cleancolor
