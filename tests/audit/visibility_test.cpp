// Layers are 0.2 mm high and roads 0.4 mm wide unless a test says otherwise; so a surface lies 0.2 mm beside the
// centre line of its road.

#include "audit/visibility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

using namespace cleancolor;

namespace {

constexpr double layer_mm = 0.2, width_mm = 0.4, reach_mm = 25;

PartLayer layer(int i, std::vector<PartRoad> roads) {
  return {.bottom_mm = layer_mm * i, .top_mm = layer_mm * (i + 1), .roads = std::move(roads)};
}

/// The same roads in the layers [first, count), nothing below.
PrintedVisibility prism(const std::vector<PartRoad>& roads, int count, int first = 0, int threads = 2) {
  return {count, [&](int i) { return layer(i, i >= first ? roads : std::vector<PartRoad>{}); }, {}, threads};
}

/// Top of layer i.
double top(int i) {
  return layer_mm * (i + 1);
}

/// Two directions at right angles, turned anyhow.
struct Frame {
  Vec2 origin, u, v;
  Vec2 at(double a, double b) const { return origin + u * a + v * b; }
  Vec3 at(double a, double b, double z) const { return {at(a, b).x, at(a, b).y, z}; }
};
Frame random_frame(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double angle = 2 * std::numbers::pi * unit(random);
  return {{unit(random), unit(random)}, {std::cos(angle), std::sin(angle)}, {-std::sin(angle), std::cos(angle)}};
}

/// Parallel lines that fill a rectangle; the first runs along its side b = b1.
std::vector<PartRoad> block(const Frame& f, double a0, double a1, double b0, double b1) {
  std::vector<PartRoad> roads;
  for (double b = b1; b >= b0; b -= width_mm) roads.push_back({f.at(a0, b), f.at(a1, b), float(width_mm), 0});
  return roads;
}

struct Errors {
  double sum = 0, squares = 0;
  int count = 0;
  void add(double e) {
    sum += e;
    squares += e * e;
    ++count;
  }
  double mean() const { return sum / count; }
  double rms() const { return std::sqrt(squares / count); }
};

void expect_small(const Errors& e) {
  EXPECT_GT(e.count, 100);
  EXPECT_LT(std::abs(e.mean()), 0.03);
  EXPECT_LT(e.rms(), 0.06);
}

constexpr int turns = 8;

}  // namespace

TEST(Visibility, IsOneOnFlatWallsOfAnyAngle) {
  std::mt19937 random(1);
  Errors errors;
  for (int t = 0; t < turns; ++t) {
    const Frame f = random_frame(random);
    const auto v = prism(block(f, -30, 30, -3, 0), 160);
    // 26 mm above the bed: no ray meets it.
    for (double a = -3; a < 3; a += 0.17) errors.add(v.at(f.at(a, 0, top(133))) - 1);
  }
  expect_small(errors);
}

TEST(Visibility, IsOneOnSlopesOfAnyAngle) {
  std::mt19937 random(2);
  Errors errors;
  for (int t = 0; t < turns; ++t) {
    const Frame f = random_frame(random);
    const double mm_per_mm = 0.3 * (t + 1);  // the wall leans back so far for each mm of height: up to 67 degrees
    const auto leaning = [&](int i) {
      const double back = -mm_per_mm * layer_mm * (i - 80);
      return layer(i, block(f, -30, 30, back - 8, back));
    };
    const PrintedVisibility v(160, leaning, {}, 2);
    for (int i = 70; i < 90; ++i) errors.add(v.at(f.at(0.3 * (i - 80), -mm_per_mm * layer_mm * (i - 80), top(i))) - 1);
  }
  expect_small(errors);
}

// A ray that leaves the wall at height h in a direction with vertical part -s meets the bed after h / s. All vertical
// parts from -1 to 1 are equally frequent, so the share of rays that end on the bed within reach is (1 - h / reach)
// / 2.
TEST(Visibility, OfAWallGrowsWithItsHeightOverTheBed) {
  std::mt19937 random(3);
  Errors errors;
  for (int t = 0; t < turns; ++t) {
    const Frame f = random_frame(random);
    const auto v = prism(block(f, -30, 30, -3, 0), 160);
    for (int i = 2; i < 120; i += 3) errors.add(v.at(f.at(0.1 * t, 0, top(i))) - (1 + top(i) / reach_mm) / 2);
  }
  expect_small(errors);
}

// Likewise of a wall that another one meets at a right angle, at a distance s from it: (1 + s / reach) / 2.
TEST(Visibility, IsAboutHalfInTheCornerOfTwoWalls) {
  std::mt19937 random(4);
  Errors errors;
  for (int t = 0; t < turns; ++t) {
    const Frame f = random_frame(random);
    auto roads = block(f, -3, 30, -3, 0);
    for (const PartRoad& r : block({f.origin, f.v, f.u}, -3, 30, -3, 0)) roads.push_back(r);
    const auto v = prism(roads, 265);
    for (double s = 0.2; s < 6; s += 0.21) errors.add(v.at(f.at(0.2 + s, 0, top(133))) - (1 + s / reach_mm) / 2);
  }
  expect_small(errors);
}

// From a ceiling at height h all rays go down, and those steeper than h / reach end on the bed: h / reach is open.
TEST(Visibility, OfTheUndersideOfAWidePlateIsItsHeightByTheReach) {
  const Frame f{{0.13, 0.2}, {1, 0}, {0, 1}};
  for (const int first : {25, 50, 75}) {
    const auto v = prism(block(f, -35, 35, -35, 35), first + 10, first);
    EXPECT_NEAR(v.at(f.at(0.3, 0.2, top(first))), layer_mm * first / reach_mm, 0.05);
  }
}

TEST(Visibility, IsOneOnTopOfAPlate) {
  const Frame f{{0.13, 0.2}, {0.8, 0.6}, {-0.6, 0.8}};
  const auto v = prism(block(f, -10, 10, -10, 10), 13);
  for (double a = -9; a < 9; a += 0.7) EXPECT_GT(v.at(f.at(a, 0.3 * a, top(12))), 0.95);
}

// The cross-section of a groove 1.2 mm wide and 19 mm deep is open for an angle of 2 atan(0.6 / 19) of pi: 0.02.
TEST(Visibility, IsSmallAtTheBottomOfADeepGroove) {
  const Frame f{{0.3, 0.1}, {0.96, 0.28}, {-0.28, 0.96}};
  auto sides = block(f, -30, 30, -4, 0);
  for (const PartRoad& r : block(f, -30, 30, 1.6, 5.6)) sides.push_back(r);
  const auto floor = block(f, -30, 30, -4, 5.6);
  const PrintedVisibility v(100, [&](int i) { return layer(i, i < 5 ? floor : sides); }, {}, 2);
  EXPECT_LT(v.at(f.at(0.2, 0.8, top(4))), 0.1);
  EXPECT_GT(v.at(f.at(0.2, 0, top(99))), 0.8) << "at its brim";
}

TEST(Visibility, IsNoneBehindAnotherRoad) {
  std::mt19937 random(5);
  for (int t = 0; t < turns; ++t) {
    const Frame f = random_frame(random);
    const auto v = prism(block(f, -30, 30, -3, 0), 60);
    for (double a = -3; a < 3; a += 0.3) {
      EXPECT_GT(v.at(f.at(a, 0, top(30))), 0.5) << "outer line";
      EXPECT_EQ(v.at(f.at(a, -1 * width_mm, top(30))), 0) << "the line behind it";
      EXPECT_EQ(v.at(f.at(a, -3 * width_mm, top(30))), 0);
    }
  }
}

TEST(Visibility, OfARoadIsTheSameAcrossItsWidth) {
  const Frame f{{0.3, 0.1}, {0.96, 0.28}, {-0.28, 0.96}};
  const auto v = prism(block(f, -30, 30, -3, 0), 60);
  const Vec2 a = f.at(-30, 0), b = f.at(30, 0);
  const double middle = v.at(f.at(1, 0, top(30)));
  EXPECT_GT(middle, 0.5);
  for (const double aside : {-0.2, -0.1, 0.1, 0.2})
    EXPECT_NEAR(v.at(f.at(1, aside, top(30)), a, b), middle, 1e-9) << aside;
  EXPECT_NEAR(v.at(f.at(31, 0, top(30)), a, b), v.at(f.at(30, 0, top(30))), 1e-9) << "behind its end";
}

// A box of one line, 0.4 mm wide, with a gap of 0.2 mm at its seam; a line across its hollow.
TEST(Visibility, DoesNotEnterAHollowThroughAThinWall) {
  std::mt19937 random(6);
  for (int t = 0; t < turns; ++t) {
    const Frame f = random_frame(random);
    const std::vector<Vec2> corners = {f.at(0.2, 0), f.at(20, 0), f.at(20, 20), f.at(0, 20), f.at(0, 0)};
    std::vector<PartRoad> walls;
    for (std::size_t k = 0; k + 1 < corners.size(); ++k)
      walls.push_back({corners[k], corners[k + 1], float(width_mm), 0});
    auto hollow = walls;
    hollow.push_back({f.at(3, 10), f.at(17, 10), float(width_mm), 0});
    const auto lid = block(f, 0, 20, 0, 20);
    const PrintedVisibility v(60, [&](int i) { return layer(i, i < 3 || i >= 57 ? lid : hollow); }, {}, 2);
    EXPECT_EQ(v.at(f.at(8, 10, top(30))), 0);
    EXPECT_GT(v.at(f.at(8, 0, top(30))), 0.5);
  }
}

TEST(Visibility, IsOneFarAwayAndWithoutAnyRoad) {
  const auto v = prism({{{0, 0}, {5, 0}, float(width_mm), 0}}, 10);
  EXPECT_EQ(v.at({100, 0, 1}), 1);
  EXPECT_EQ(v.at({0, 0, 1000}), 1);
  EXPECT_EQ(v.at({-1e9, 1e12, -5}), 1);
  EXPECT_EQ(prism({}, 10).at({0, 0, 1}), 1);
  EXPECT_EQ(prism({}, 0).at({0, 0, 1}), 1);
}

namespace {

/// How far p is from the plastic of roads that stand as prisms up to top_mm; 0 or less inside. Not more than the truth.
double clearance(const std::vector<PartRoad>& roads, double top_mm, Vec3 p) {
  double nearest = 1e9;
  for (const PartRoad& r : roads) {
    const Vec2 q{p.x, p.y}, ab = r.b_mm - r.a_mm;
    const double t = std::clamp(dot(q - r.a_mm, ab) / dot(ab, ab), 0., 1.);
    nearest = std::min(nearest, distance(q, r.a_mm + ab * t) - double(r.width_mm) / 2);
  }
  return std::max(nearest, p.z - top_mm);
}

/// Share of random rays over the half sphere about the horizontal normal that meet neither plastic nor bed.
double cast(const std::vector<PartRoad>& roads, double top_mm, Vec3 p, Vec2 normal, std::mt19937& random) {
  std::normal_distribution<double> bell;
  constexpr int rays = 400;
  int open = 0;
  for (int k = 0; k < rays; ++k) {
    Vec3 d{bell(random), bell(random), bell(random)};
    d = d * (1 / length(d));
    if (d.x * normal.x + d.y * normal.y < 0) d = d * -1;
    double way = 0.002;
    for (double free = 1; way < reach_mm && free > 1e-4; way += std::max(free, 1e-3)) {
      const Vec3 q = p + d * way;
      free = std::min(clearance(roads, top_mm, q), q.z);
    }
    open += way >= reach_mm;
  }
  return double(open) / rays;
}

}  // namespace

TEST(Visibility, AgreesWithManyRandomRaysThroughTheExactRoads) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  Errors errors;
  constexpr int layers = 60;
  for (int t = 0; t < 6; ++t) {
    // Four blocks, anyhow turned and placed, each with one side to look at.
    std::vector<Frame> frames;
    std::vector<PartRoad> roads;
    for (int k = 0; k < 4; ++k) {
      frames.push_back(random_frame(random));
      frames.back().origin = {16 * unit(random), 16 * unit(random)};
      for (const PartRoad& r : block(frames.back(), -4, 4, -2, 0)) roads.push_back(r);
    }
    const auto v = prism(roads, layers);
    for (const Frame& f : frames)
      for (int k = 0; k < 12; ++k) {
        const double a = 7 * unit(random) - 3.5;
        const int i = 5 + int(50 * unit(random));
        const Vec3 surface = f.at(a, width_mm / 2 + 1e-3, top(i));
        // Where blocks touch or overlap the side is no surface.
        if (clearance(roads, top(layers), f.at(a, 1.2, top(i))) <= 0.9) continue;
        errors.add(v.at(f.at(a, 0, top(i))) - cast(roads, top(layers - 1), surface, f.v, random));
      }
  }
  expect_small(errors);
}

TEST(Visibility, IsTheSameForAnyNumberOfThreads) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<PartRoad> roads;
  for (int k = 0; k < 40; ++k)
    roads.push_back({{20 * unit(random), 20 * unit(random)}, {20 * unit(random), 20 * unit(random)}, 0.4f, 0});
  const auto one = prism(roads, 40, 0, 1), three = prism(roads, 40, 0, 3), seven = prism(roads, 40, 0, 7);
  int partly = 0;
  for (const PartRoad& r : roads)
    for (int i = 0; i < 40; i += 7) {
      const Vec2 m = lerp(r.a_mm, r.b_mm, 0.3);
      const double value = one.at({m.x, m.y, top(i)});
      EXPECT_EQ(value, three.at({m.x, m.y, top(i)}));
      EXPECT_EQ(value, seven.at({m.x, m.y, top(i)}));
      partly += value > 0 && value < 1;
    }
  EXPECT_GT(partly, 100);
}

TEST(Visibility, TakesLargerVoxelsWhereRoadsLieFarApart) {
  const PrintedVisibility v(
      2, [](int i) { return layer(i, {{{0, 0}, {1, 0}, 0.4f, 0}, {{1e4, 1e4}, {1e4, 9999}, 0.4f, 0}}); }, {}, 2);
  EXPECT_GT(v.voxel_mm(), 0.5);
  EXPECT_GT(v.at({1e4, 1e4, 0.4}), 0);
}

TEST(Visibility, BearsOddRoads) {
  const std::vector<PartRoad> odd = {{{0, 0}, {0, 0}, 0.4f, 0},
                                     {{0, 0}, {5, 0}, 0.f, 15},
                                     {{0, 0}, {5, 1e-300}, 1e30f, 0},
                                     {{1, 1}, {1, 1 + 1e-12}, -1.f, 3}};
  const PrintedVisibility v(
      3, [&](int i) { return PartLayer{.bottom_mm = i == 2 ? -1e4 : 5., .top_mm = i == 1 ? -3. : 5.2, .roads = odd}; },
      {}, 2);
  EXPECT_GE(v.at({0, 0, 5}), 0);
}

TEST(Visibility, StopsWhenInterrupted) {
  const Progress progress{.interrupted = [] { return true; }};
  EXPECT_ANY_THROW(PrintedVisibility(3, [](int i) { return layer(i, {{{0, 0}, {1, 0}, 0.4f, 0}}); }, {}, 2, progress));
}
