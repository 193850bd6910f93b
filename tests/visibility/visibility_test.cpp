#include "visibility/visibility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cleancolor {
namespace {

SurfaceVisibility of(const std::vector<Polygons>& layers, double voxel_mm = 0.5, int threads = 2) {
  const std::vector<double> heights(layers.size(), 0.2);
  return SurfaceVisibility(packed(layers), heights, {.voxel_mm = voxel_mm, .threads = threads});
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

SurfaceVisibility seen(const std::vector<Polygons>& layers, const ViewBias& view, int threads = 2) {
  const std::vector<double> heights(layers.size(), 0.2);
  return SurfaceVisibility(packed(layers), heights, {.threads = threads, .view = view, .opaque = {}});
}

Vec2 towards(double degrees) {
  return {std::cos(degrees * std::numbers::pi / 180), std::sin(degrees * std::numbers::pi / 180)};
}

TEST(SurfaceVisibility, OfACubeIsHighestTowardsTheView) {
  const auto cube = prism(rectangle({0, 0}, {30, 30}), 300);
  for (const double weight : {0.25, 0.6, 1.}) {
    const SurfaceVisibility v = seen(cube, {towards(0), weight});
    EXPECT_NEAR(v.at({29.9, 15, 45}), 1, 0.05);
    EXPECT_NEAR(v.at({0.1, 15, 45}), 1 - weight, 0.05);
    EXPECT_NEAR(v.at({15, 29.9, 45}), 1 - weight / 2, 0.05);
    EXPECT_NEAR(v.at({15, 0.1, 45}), 1 - weight / 2, 0.05);
    EXPECT_NEAR(v.at({15, 15, 60}), 1 - weight / 2, 0.05);
    EXPECT_EQ(v.at({15, 15, 30}), 0) << "deep inside";
  }
  // A wall sees a share of angle / 180 of the directions that lead there: of 90 + turn here.
  for (const double turn : {30., 60., 120., 150.}) {
    const SurfaceVisibility v = seen(cube, {towards(turn), 0.8});
    EXPECT_NEAR(v.at({29.9, 15, 45}), 1 - 0.8 * turn / 180, 0.06) << turn;
  }
}

TEST(SurfaceVisibility, StaysBetweenNoneAndOneWithAView) {
  const auto cube = prism(rectangle({0, 0}, {12, 7}), 40);
  for (int turn = 0; turn < 360; turn += 15) {
    const SurfaceVisibility all = seen(cube, {}), v = seen(cube, {towards(turn), 1});
    for (int i = 0; i < 200; ++i) {
      const Vec3 p{std::fmod(i * 0.37, 14.) - 1, std::fmod(i * 0.71, 9.) - 1, std::fmod(i * 0.13, 9.)};
      EXPECT_GE(v.at(p), 0);
      EXPECT_LE(v.at(p), all.at(p)) << "a view only takes away";
    }
  }
}

TEST(SurfaceVisibility, OfAViewWithoutWeightIsThatFromAllAround) {
  const auto layers = prism(rectangle({0, 0}, {13.3, 7.1}), 50);
  const SurfaceVisibility all = of(layers), v = seen(layers, {towards(40), 0});
  const SurfaceVisibility one = seen(layers, {towards(40), 0.7}, 1), four = seen(layers, {towards(40), 0.7}, 4);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p{std::fmod(i * 0.37, 14.), std::fmod(i * 0.71, 8.), std::fmod(i * 0.13, 11.)};
    EXPECT_EQ(all.at(p), v.at(p));
    EXPECT_EQ(one.at(p), four.at(p));
  }
}

SurfaceVisibility translucent(const std::vector<Polygons>& layers, const std::vector<Polygons>& opaque,
                              int threads = 2) {
  const std::vector<double> heights(layers.size(), 0.2);
  return SurfaceVisibility(packed(layers), heights, {.threads = threads, .view = {}, .opaque = packed(opaque)});
}

TEST(TranslucentPlastic, LetsLessLightThroughTheDeeperAPlaceLies) {
  const auto block = prism(rectangle({0, 0}, {30, 30}), 200);
  const SurfaceVisibility v = translucent(block, std::vector<Polygons>(200));
  for (const double t : {1., 2., 5.}) {
    // The surface is known to half a voxel.
    const double tolerance = std::exp(0.26 / t) - 1;
    for (const double d : {0.5, 1., 2., 4.}) {
      const double wall = v.at({0.1, 15, 20}) * std::exp(-d / t);
      EXPECT_NEAR(v.below({d, 15, 20}, t), wall, tolerance * wall + 0.02) << "below a wall: " << d << ", " << t;
      const double top = v.at({15, 15, 40}) * std::exp(-d / t);
      EXPECT_NEAR(v.below({15, 15, 40 - d}, t), top, tolerance * top + 0.02) << "below a top: " << d << ", " << t;
    }
  }
  EXPECT_EQ(v.below({15, 15, 20}, 20), 0) << "more than 10 mm";
  EXPECT_EQ(v.below({8, 15, 20}, 1), 0) << "less than can be told from nothing";
}

TEST(TranslucentPlastic, IsHiddenBehindOpaquePlastic) {
  // From left to right: 3 mm opaque, 24 mm translucent.
  const auto block = prism(rectangle({0, 0}, {27, 30}), 200);
  const SurfaceVisibility v = translucent(block, prism(rectangle({0, 0}, {3, 30}), 200));
  EXPECT_EQ(v.below({4, 15, 20}, 2), 0) << "12 mm below the nearest clear surface";
  EXPECT_NEAR(v.below({25, 15, 20}, 2), v.at({27, 15, 20}) * std::exp(-1), 0.1);
  // A plate of it in the middle: what lies behind cannot be seen straight through.
  const SurfaceVisibility plate = translucent(block, prism(rectangle({2, 3}, {3, 27}), 200));
  EXPECT_EQ(plate.below({5, 15, 20}, 3), 0);
  EXPECT_GT(plate.below({1, 15, 20}, 3), 0.5);
}

TEST(TranslucentPlastic, IsTheSameForAnyNumberOfThreads) {
  const auto layers = prism(rectangle({0, 0}, {13.3, 7.1}), 50);
  const auto opaque = prism(rectangle({4, 2}, {9, 5}), 50);
  const SurfaceVisibility one = translucent(layers, opaque, 1), four = translucent(layers, opaque, 4);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p{std::fmod(i * 0.37, 14.), std::fmod(i * 0.71, 8.), std::fmod(i * 0.13, 11.)};
    EXPECT_EQ(one.below(p, 2), four.below(p, 2));
  }
}

}  // namespace
}  // namespace cleancolor
