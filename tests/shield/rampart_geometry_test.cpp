// The walls of every model: near the part but not too near, simple, and each on the wall below.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "paper_outlines.hpp"
#include "sanitized.hpp"
#include "shield/rampart.hpp"
#include "slice/slices.hpp"

namespace cleancolor {
namespace {

Polygons disc(Vec2 middle, double radius_mm) {
  Ring ring;
  for (int i = 0; i < 180; ++i) {
    const double a = 2 * std::numbers::pi * i / 180;
    ring.push_back(to_nm(middle + Vec2{radius_mm * std::cos(a), radius_mm * std::sin(a)}));
  }
  return {ring};
}

Rampart rampart_of(const std::vector<Polygons>& outlines, const RampartOptions& options, double height_mm = 0.3) {
  return rampart(packed(outlines), std::vector<double>(outlines.size(), height_mm), options);
}

/// Lines of rings, and whether a point is near one.
class Lines {
 public:
  explicit Lines(const Polygons& rings) {
    for (const Ring& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = to_mm(ring[i]), b = to_mm(ring[(i + 1) % ring.size()]);
        lines_.emplace_back(a, b);
      }
  }
  bool is_near(Vec2 p, double mm) const {
    return std::ranges::any_of(lines_, [&](const auto& line) {
      const Vec2 ab = line.second - line.first;
      const double l2 = length_squared(ab), t = l2 > 0 ? std::clamp(dot(p - line.first, ab) / l2, 0., 1.) : 0;
      return length_squared(p - (line.first + ab * t)) <= mm * mm;
    });
  }

 private:
  std::vector<std::pair<Vec2, Vec2>> lines_;
};

struct Hanging {
  double all_mm = 0, hanging_mm = 0, longest_mm = 0;
};

/// How much of the walls lies further than `step_mm` beside the walls below.
void add_hanging(const Polygons& wall, const Polygons& below, double step_mm, Hanging& sum) {
  const Lines lines(below);
  constexpr double spacing_mm = 0.25;
  for (const Ring& ring : wall) {
    double run_mm = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = to_mm(ring[i]), b = to_mm(ring[(i + 1) % ring.size()]);
      const int steps = std::max(1, int(std::ceil(distance(a, b) / spacing_mm)));
      for (int k = 0; k < steps; ++k) {
        const double mm = distance(a, b) / steps;
        sum.all_mm += mm;
        if (lines.is_near(lerp(a, b, (k + 0.5) / steps), step_mm)) {
          run_mm = 0;
          continue;
        }
        run_mm += mm;
        sum.hanging_mm += mm;
        sum.longest_mm = std::max(sum.longest_mm, run_mm);
      }
    }
  }
}

constexpr double rounding_mm = 0.001, simplification_mm = 0.02;

void expect_sound(const std::vector<Polygons>& outlines, const Rampart& rampart, const RampartOptions& options,
                  double height_mm) {
  ASSERT_EQ(rampart.walls.size(), outlines.size());
  std::vector<Hanging> hanging(std::size_t(options.walls));
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    ASSERT_EQ(rampart.walls[k].size(), std::size_t(options.walls));
    const Polygons room = offset(outlines[k], options.distance_mm - options.line_width_mm / 2, Corners::round);
    for (std::size_t w = 0; w < rampart.walls[k].size(); ++w) {
      const Polygons wall = rampart.walls[k][w];
      for (const Ring& ring : wall) {
        ASSERT_TRUE(ClipperLib::Orientation(ring)) << "a hole, layer " << k;
        ASSERT_EQ(united({ring}).size(), 1U) << "crosses itself, layer " << k;
      }
      ASSERT_EQ(united(wall).size(), wall.size()) << "islands overlap, layer " << k;
      ASSERT_LE(area_mm2(difference(room, wall)), 1e-3) << "too near to the part, layer " << k;
      if (w > 0) {
        ASSERT_LE(area_mm2(difference(offset(rampart.walls[k][w - 1], options.gap_mm - 0.2, Corners::round), wall)),
                  1e-3)
            << "walls too near to each other, layer " << k;
      }
      if (k == 0) continue;
      const Polygons below = rampart.walls[k - 1][w];
      add_hanging(wall, below, overhang_step_mm(height_mm, options) + simplification_mm + rounding_mm, hanging[w]);
      for (const Ring& ring : wall)
        ASSERT_FALSE(intersection({ring}, below).empty()) << "an island begins in mid-air, layer " << k;
    }
  }
  for (std::size_t w = 0; w < hanging.size(); ++w) {
    EXPECT_LE(hanging[w].hanging_mm, 0.02 * hanging[w].all_mm) << "wall " << w;
    EXPECT_LE(hanging[w].longest_mm, 2) << "wall " << w;
    if (options.conforming)
      testing::Test::RecordProperty(
          fmt::format("hanging_percent_{}_of_{}", w, options.walls),
          fmt::format("{:.3f}", 100 * hanging[w].hanging_mm / std::max(1., hanging[w].all_mm)));
  }
}

double length_of(const Rampart& rampart) {
  double sum = 0;
  for (const auto& walls : rampart.walls)
    for (const Polygons& wall : unpacked(walls)) sum += length_mm(wall);
  return sum;
}

}  // namespace

TEST(Rampart, AroundADiscIsADisc) {
  const RampartOptions options;
  const Rampart r = rampart_of(std::vector<Polygons>(5, disc({50, 50}, 10)), options);
  for (const auto& walls : r.walls)
    for (std::size_t w = 0; w < 2; ++w) {
      const Ring ring = Polygons(walls[w]).front();
      for (const Point p : ring) EXPECT_NEAR(distance(to_mm(p), {50, 50}), 12.1 + 4. * double(w), 0.1);
    }
}

TEST(Rampart, FollowsAConeAndLeavesPlasticOut) {
  std::vector<Polygons> cone;
  for (int k = 0; k < 60; ++k) cone.push_back(disc({0, 0}, 30 - 0.2 * k));  // steps smaller than an overhang's
  RampartOptions options;
  const Rampart conforming = rampart_of(cone, options);
  expect_sound(cone, conforming, options, 0.3);
  EXPECT_NEAR(bounds_mm(conforming.walls.back()[0]).size().x / 2, 30 - 0.2 * 59 + 2.1, 0.15);
  options.conforming = false;
  const Rampart vertical = rampart_of(cone, options);
  EXPECT_EQ(vertical.walls.front()[0], vertical.walls.back()[0]);
  EXPECT_LT(length_of(conforming), 0.9 * length_of(vertical));
}

TEST(Rampart, CarriesAWideCapFromTheBed) {
  // A mushroom: the cap's walls come down to the bed, one step further in on every layer.
  std::vector<Polygons> mushroom(40, disc({0, 0}, 4));
  for (int k = 30; k < 40; ++k) mushroom[std::size_t(k)] = disc({0, 0}, 20);
  const RampartOptions options;
  const Rampart r = rampart_of(mushroom, options);
  expect_sound(mushroom, r, options, 0.3);
  const double step = overhang_step_mm(0.3, options);
  EXPECT_NEAR(bounds_mm(r.walls[0][0]).size().x / 2, 22.1 - 30 * step, 0.3);
  EXPECT_NEAR(bounds_mm(r.walls[20][0]).size().x / 2, 22.1 - 10 * step, 0.3);
}

TEST(Rampart, LeansInNoFasterThanWallsCarry) {
  // A wide foot under a thin mast.
  std::vector<Polygons> mast(40, disc({0, 0}, 3));
  for (int k = 0; k < 5; ++k) mast[std::size_t(k)] = disc({0, 0}, 20);
  const RampartOptions options;
  const Rampart r = rampart_of(mast, options);
  expect_sound(mast, r, options, 0.3);
  const double step = overhang_step_mm(0.3, options);
  EXPECT_NEAR(bounds_mm(r.walls[14][0]).size().x / 2, 22.1 - 10 * step, 0.3);
}

TEST(Rampart, ObjectsApartHaveTheirOwnAndShareWhereTheyTouch) {
  const auto islands_at = [](double between_mm) {
    const Polygons both = united(disc({0, 0}, 5), disc({10 + between_mm, 0}, 5));
    const Rampart r = rampart_of(std::vector<Polygons>(4, both), {});
    return std::pair{r.walls[1][0].size(), r.walls[1][1].size()};
  };
  EXPECT_EQ(islands_at(20), (std::pair<std::size_t, std::size_t>{2, 2}));
  EXPECT_EQ(islands_at(8), (std::pair<std::size_t, std::size_t>{2, 1}));
  EXPECT_EQ(islands_at(2), (std::pair<std::size_t, std::size_t>{1, 1}));
}

TEST(Rampart, AnArmThatBeginsInMidAirIsWalledFromTheBed) {
  std::vector<Polygons> arm(50, disc({0, 0}, 6));
  for (int k = 35; k < 50; ++k) arm[std::size_t(k)] = united(arm[std::size_t(k)], rectangle({0, -2}, {30, 2}));
  const RampartOptions options;
  const Rampart r = rampart_of(arm, options);
  expect_sound(arm, r, options, 0.3);
  EXPECT_GT(bounds_mm(r.walls[0][0]).max.x, 25) << "something stands below the arm's end";
}

TEST(Rampart, SpecksOfThePartAreKeptAway) {
  const Polygons speck = rectangle({40, 0}, {40.15, 0.15});
  const Rampart r = rampart_of(std::vector<Polygons>(3, united(disc({0, 0}, 6), speck)), {});
  EXPECT_EQ(r.walls[1][0].size(), 2U);
  EXPECT_TRUE(contains(r.walls[1][0], to_nm({41.9, 0})));
}

TEST(Rampart, LayersWithoutAnythingHaveWallsWhereThoseAboveNeedThem) {
  std::vector<Polygons> floating(10);
  floating[7] = floating[8] = floating[9] = disc({0, 0}, 8);
  const Rampart r = rampart_of(floating, {});
  for (const auto& walls : r.walls) EXPECT_EQ(walls[0].size(), 1U);
  EXPECT_TRUE(rampart_of(std::vector<Polygons>(3), {}).walls[0][0].empty());
  EXPECT_TRUE(rampart({}, {}, {}).walls.empty());
}

namespace {

struct PaperModel {
  const char *name, *first, *second;
};

void PrintTo(const PaperModel& model, std::ostream* out) {
  *out << model.name;
}

class RampartOfModel : public testing::TestWithParam<PaperModel> {};

TEST_P(RampartOfModel, IsSound) {
  if (!std::filesystem::exists(std::filesystem::path(CLEANCOLOR_SHARED) / "models"))
    GTEST_SKIP() << "needs the models of " << CLEANCOLOR_SHARED;
  SKIP_LARGE_WHERE_SANITIZED(GetParam().name);
  for (const double layer_mm : {0.3, 0.6}) {
    const std::vector<Polygons> outlines =
        unpacked(paper_outlines(GetParam().name, GetParam().first, GetParam().second, layer_mm));
    for (const int walls : {2, 3}) {
      RampartOptions options{.walls = walls};
      const Rampart conforming = rampart_of(outlines, options, layer_mm);
      expect_sound(outlines, conforming, options, layer_mm);
      options.conforming = false;
      const Rampart vertical = rampart_of(outlines, options, layer_mm);
      if (walls == 3) expect_sound(outlines, vertical, options, layer_mm);
      EXPECT_LT(length_of(conforming), length_of(vertical));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Paper, RampartOfModel,
                         testing::Values(PaperModel{"4-cones", "white", "black"},
                                         PaperModel{"crystal", "white", "black"},
                                         PaperModel{"dragon-heart", "body", "accent"},
                                         PaperModel{"robot-ice", "robot", "crust"},
                                         PaperModel{"rose", "petals", "green"}, PaperModel{"spot-cow", "light", "dark"},
                                         PaperModel{"two-color-world-50mm", "ocean", "land"}),
                         [](const auto& of) {
                           std::string name = of.param.name;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace cleancolor
