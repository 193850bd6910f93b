#include "orient/azimuth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "drawn_slices.hpp"
#include "model/check.hpp"
#include "model/read.hpp"
#include "sanitized.hpp"

using namespace cleancolor;
using namespace cleancolor::test;

namespace {

AzimuthOptions options_for(std::vector<Vec2> offsets, int threads = 1) {
  AzimuthOptions options;
  options.pace.resize(offsets.size());
  options.nozzle_offset_mm = std::move(offsets);
  options.threads = threads;
  return options;
}

const Polygons far_dot = rectangle({90, 90}, {90.5, 90.5});  // so that a second extruder prints at all

Vec2 displacement(Vec2 delta, int degrees) {
  const double a = -degrees * std::numbers::pi / 180;
  return {std::cos(a) * delta.x - std::sin(a) * delta.y, std::sin(a) * delta.x + std::cos(a) * delta.y};
}

/// Counts points of a fine grid in every layer: slow, and plainly the definition.
double counted_mm3(const Slices& slices, const std::vector<Vec2>& offsets, int degrees, double step_mm) {
  double volume = 0;
  for (std::size_t k = 0; k < slices.slabs.size(); ++k) {
    const Box<Vec2> box = bounds_mm(slices.outlines[k]);
    const auto colour = [&](Vec2 p) {
      for (std::size_t e = 0; e < offsets.size(); ++e)
        if (contains(slices.regions[k][e], to_nm(p))) return int(e);
      return -1;
    };
    for (double y = box.min.y + step_mm / 2; y < box.max.y; y += step_mm)
      for (double x = box.min.x + step_mm / 2; x < box.max.x; x += step_mm) {
        const int i = colour({x, y});
        if (i < 0) continue;
        for (int j = 0; j < int(offsets.size()); ++j) {
          if (j == i) continue;
          const Vec2 delta = offsets[std::size_t(j)] - offsets[std::size_t(i)];
          const int over = colour(Vec2{x, y} + displacement(delta, degrees));
          if (over >= 0 && over != j) volume += step_mm * step_mm * slices.slabs[k].height_mm;
        }
      }
  }
  return volume;
}

/// A blob of boxes and discs for each of `count` extruders, apart from each other.
Slices random_blobs(unsigned seed, int count, int layers) {
  std::mt19937 random(seed);
  const auto any = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  Slices slices;
  slices.slabs = slabs(layers, 1, 1);
  for (int k = 0; k < layers; ++k) {
    Polygons taken;
    std::vector<Polygons> regions;
    for (int e = 0; e < count; ++e) {
      Polygons blob;
      for (int i = 0; i < 3; ++i) {
        const Vec2 p{any(0, 30), any(0, 20)};
        const Polygons piece = i == 0 ? disc(p, any(2, 6), 40) : rectangle(p, p + Vec2{any(2, 12), any(2, 9)});
        blob = united(blob, piece);
      }
      regions.push_back(difference(blob, taken));
      taken = united(taken, blob);
    }
    slices.regions.push_back(packed(regions));
    slices.outlines.push_back(taken);
  }
  return slices;
}

}  // namespace

TEST(Interference, OfABoxIsItsOverlapWithItselfMoved) {
  // 40 x 17.3 mm in plan: one nozzle prints all of it, the other a speck far away.
  const Slices slices = drawn_slices({rectangle({3.1, 1}, {43.1, 18.3}), far_dot}, 10);
  const Azimuths found = azimuths(slices, options_for({{0, 0}, {25, 0}}));
  const double volume = 40 * 17.3 * 10;
  for (int a = 0; a < 360; ++a) {
    const Vec2 d = displacement({25, 0}, a);
    const double expected = std::max(0., 40 - std::abs(d.x)) * std::max(0., 17.3 - std::abs(d.y)) * 10;
    EXPECT_NEAR(found.interference_mm3[std::size_t(a)], expected, 0.01 * volume) << a;
  }
  EXPECT_NEAR(found.part_mm3, volume, 0.001 * volume);
}

TEST(Interference, OfADiscIsALens) {
  const double r = 20, d = 15;
  const Slices slices = drawn_slices({disc({50, 50}, r), far_dot}, 8);
  const Azimuths found = azimuths(slices, options_for({{0, 0}, {0, d}}));
  const double lens = 2 * r * r * std::acos(d / (2 * r)) - d / 2 * std::sqrt(4 * r * r - d * d);
  for (const double mm3 : found.interference_mm3) EXPECT_NEAR(mm3, lens * 8, 0.01 * std::numbers::pi * r * r * 8);
}

TEST(Interference, OfABarIsZeroWhereItLiesAcrossTheNozzles) {
  // 60 x 10 mm, nozzles 20 mm apart: free from where 20 sin(a) > 10 on, at 30 degrees.
  const Slices slices = drawn_slices({rectangle({0, 0}, {60, 10}), far_dot}, 5);
  const Azimuths found = azimuths(slices, options_for({{0, 0}, {20, 0}}));
  EXPECT_EQ(found.interference_mm3[31], 0);
  EXPECT_GT(found.interference_mm3[28], 0);
  ASSERT_TRUE(found.least_interference_deg);
  EXPECT_NEAR(*found.least_interference_deg, 30, 1);
  EXPECT_EQ(found.exposure_s[45], 0);
}

TEST(Interference, OfRandomShapesIsWhatCountingPointsGives) {
  for (unsigned seed = 1; seed <= unsigned(test::trials(4)); ++seed)
    for (const int count : {2, 3}) {
      std::vector<Vec2> offsets{{0, 0}, {11, 2}, {-4, 9}};
      offsets.resize(std::size_t(count));
      const Slices slices = random_blobs(seed, count, 4);
      const Azimuths found = azimuths(slices, options_for(offsets));
      for (const int a : {0, 37, 90, 171, 255})
        EXPECT_NEAR(found.interference_mm3[std::size_t(a)], counted_mm3(slices, offsets, a, 0.2), 0.01 * found.part_mm3)
            << "seed " << seed << ", " << count << " extruders, " << a << " degrees";
    }
}

TEST(Interference, OfTwoNozzlesIsTheSameHalfATurnOn) {
  const Azimuths found = azimuths(random_blobs(7, 2, 3), options_for({{0, 0}, {9, 0}}));
  for (std::size_t a = 0; a < 180; ++a) EXPECT_EQ(found.interference_mm3[a], found.interference_mm3[a + 180]);
}

TEST(Exposure, OfATallBoxIsTheTimeOverItsWalls) {
  // 40 x 20 mm, 200 mm high; everywhere 0.1 s/mm2. Moved by (10, 0), tips are over the half millimetre along three
  // walls: 2 x 30 mm + 20 mm long. Near the bed they are not in full sight, and of rays along a wall some hit its
  // cells.
  const Slices slices = drawn_slices({rectangle({0, 0}, {40, 20}), far_dot}, 200, 1);
  AzimuthOptions options = options_for({{0, 0}, {10, 0}});
  options.pace.assign(2, {.shell_mm = 0, .shell_s_mm2 = 0, .inner_s_mm2 = 0.1});
  const Azimuths found = azimuths(slices, options);
  const double expected = (2 * 30 + 20) * 0.5 * 0.1 * 200;
  EXPECT_LT(found.exposure_s[0], expected);
  EXPECT_GT(found.exposure_s[0], 0.85 * expected);
  // Beyond the box, nothing; and twice the time is twice the exposure.
  options.nozzle_offset_mm[1] = {41, 0};
  EXPECT_EQ(azimuths(slices, options).exposure_s[0], 0);
  options.nozzle_offset_mm[1] = {10, 0};
  options.pace[0].inner_s_mm2 = 0.2;
  EXPECT_NEAR(azimuths(slices, options).exposure_s[0], 2 * found.exposure_s[0], 1e-6 * expected);
}

TEST(Exposure, CountsPerimetersByTheirOwnPace) {
  // The whole disc of 5 mm is nearer than 6 mm to its border.
  const Slices slices = drawn_slices({disc({20, 20}, 5), far_dot}, 30, 1);
  AzimuthOptions options = options_for({{0, 0}, {4, 0}});
  options.pace.assign(2, {.shell_mm = 6, .shell_s_mm2 = 0.3, .inner_s_mm2 = 0});
  const double all_shell = azimuths(slices, options).exposure_s[0];
  options.pace.assign(2, {.shell_mm = 0, .shell_s_mm2 = 0, .inner_s_mm2 = 0.3});
  EXPECT_NEAR(azimuths(slices, options).exposure_s[0], all_shell, 1e-6);
  EXPECT_GT(all_shell, 0);
}

TEST(Exposure, OfABuriedColourIsNone) {
  // Nozzle 1 prints the core of a block that nozzle 0 prints around and above: over the core nobody sees a smear. All
  // exposure comes from the walls, which the core's own printing reaches nowhere.
  const Polygons core = rectangle({10, 10}, {30, 30});
  Slices slices = drawn_slices({difference(rectangle({0, 0}, {40, 40}), core), core}, 20, 1);
  for (std::size_t k = 15; k < slices.regions.size(); ++k) slices.regions[k] = {rectangle({0, 0}, {40, 40}), {}};
  AzimuthOptions options = options_for({{0, 0}, {5, 0}});
  options.pace[0] = {.shell_mm = 0, .shell_s_mm2 = 0, .inner_s_mm2 = 0};  // only nozzle 1 takes time
  options.pace[1] = {.shell_mm = 0, .shell_s_mm2 = 0, .inner_s_mm2 = 1};
  const Azimuths found = azimuths(slices, options);
  for (const double s : found.exposure_s) EXPECT_EQ(s, 0);
  EXPECT_GT(found.interference_mm3[0], 0);
}

TEST(Azimuth, OfOneExtruderIsNoTurn) {
  const Azimuths found = azimuths(drawn_slices({rectangle({0, 0}, {40, 20}), {}}, 10), options_for({{0, 0}, {33, 0}}));
  EXPECT_EQ(found.best_deg, 0);
  EXPECT_EQ(found.least_interference_deg, 0);
  for (std::size_t a = 0; a < 360; ++a) EXPECT_EQ(found.exposure_s[a] + found.interference_mm3[a], 0);
}

TEST(Azimuth, IsTheSmallestTurnOfEquals) {
  EXPECT_EQ(azimuths(drawn_slices({disc({0, 0}, 30), far_dot}, 10), options_for({{0, 0}, {20, 0}})).best_deg, 0);
  // A bar that must turn by 30 degrees either way turns to the left.
  const Slices bar = drawn_slices({rectangle({0, 0}, {60, 10}), far_dot}, 5);
  EXPECT_GT(azimuths(bar, options_for({{0, 0}, {20, 0}})).best_deg.value(), 0);
}

TEST(Azimuth, IsNoTurnWhereATurnBringsLittle) {
  int not_worth_it = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const Azimuths found = azimuths(random_blobs(2, 2, seed), options_for({{0, 0}, {8, 0}}));
    const double least = std::ranges::min(found.exposure_s), all = std::ranges::max(found.exposure_s);
    const double chosen = found.exposure_s[std::size_t((*found.best_deg + 360) % 360)];
    if (found.exposure_s[0] <= 1.4 * least + 0.01 * all) {
      EXPECT_EQ(found.best_deg, 0);
      not_worth_it += found.exposure_s[0] > 1.25 * least + 0.01 * all;
    } else {
      EXPECT_LE(chosen, 1.25 * least + 0.01 * all);
    }
  }
  EXPECT_GT(not_worth_it, 0) << "no seed shows the rule";
}

TEST(Azimuth, CandidatesAreDeepValleysAndNoTurn) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    AzimuthOptions options = options_for({{0, 0}, {8, 0}});
    if (seed % 3 == 0) options.fits = [](int degrees) { return degrees > 200 && degrees < 320; };
    const Azimuths found = azimuths(random_blobs(2, 2, seed), options);
    const double all = std::ranges::max(found.exposure_s);
    double least = INFINITY;
    for (std::size_t a = 0; a < 360; ++a)
      if (found.fits[a]) least = std::min(least, found.exposure_s[a]);
    ASSERT_FALSE(found.candidates_deg.empty());
    EXPECT_EQ(at_azimuth(found.exposure_s, found.candidates_deg.front()), least);
    for (const int deg : found.candidates_deg) {
      EXPECT_TRUE(found.fits[azimuth_slot(deg)]);
      EXPECT_LE(at_azimuth(found.exposure_s, deg), (deg == 0 ? 3 : 1.5) * least + 0.01 * all);
    }
    const bool has_none = std::ranges::find(found.candidates_deg, 0) == found.candidates_deg.end();
    EXPECT_EQ(has_none, !found.fits[0] || found.exposure_s[0] > 3 * least + 0.01 * all);
  }
}

TEST(Azimuth, IsOneThatHasRoom) {
  const Slices bar = drawn_slices({rectangle({0, 0}, {60, 10}), far_dot}, 5);
  AzimuthOptions options = options_for({{0, 0}, {20, 0}});
  options.fits = [](int degrees) { return degrees > 200 && degrees < 320; };
  const Azimuths found = azimuths(bar, options);
  ASSERT_TRUE(found.best_deg && found.least_interference_deg);
  EXPECT_LT(*found.best_deg, -40);
  EXPECT_EQ(found.interference_mm3[std::size_t(360 + *found.least_interference_deg)], 0);
  options.fits = [](int) { return false; };
  EXPECT_FALSE(azimuths(bar, options).best_deg);
}

TEST(Azimuth, IsTheSameForAnyNumberOfThreads) {
  const Slices slices = random_blobs(3, 3, 5);
  const std::vector<Vec2> offsets{{0, 0}, {8, 0}, {0, 8}};
  const Azimuths one = azimuths(slices, options_for(offsets, 1));
  for (const int threads : {2, 3}) {
    const Azimuths more = azimuths(slices, options_for(offsets, threads));
    EXPECT_EQ(one.exposure_s, more.exposure_s);
    EXPECT_EQ(one.interference_mm3, more.interference_mm3);
    EXPECT_EQ(one.best_deg, more.best_deg);
  }
}

TEST(Azimuth, PaceIsThatOfWallsAndInfill) {
  Config config;
  config.perimeters = 2;
  config.perimeter_extrusion_width = {0.5, false};
  config.perimeter_speed_mm_s = 40;
  config.infill_extrusion_width = {0.5, false};
  config.infill_speed_mm_s = 80;
  config.fill_density = 0.25;
  const Pace found = pace(config, 0);
  EXPECT_NEAR(found.shell_mm, 1, 1e-12);
  EXPECT_NEAR(found.shell_s_mm2, 1 / (0.5 * 40), 1e-12);
  EXPECT_NEAR(found.inner_s_mm2, 0.25 / (0.5 * 80), 1e-12);
}

TEST(Azimuth, NothingAtAllIsNoTurn) {
  const Azimuths found = azimuths(drawn_slices({{}, {}}, 3), options_for({{0, 0}, {33, 0}}));
  EXPECT_EQ(found.best_deg, 0);
  EXPECT_EQ(found.part_mm3, 0);
}

TEST(Azimuth, FreesRobotIceOfAllInterference) {
  const auto folder = std::filesystem::path(CLEANCOLOR_SHARED) / "models" / "paper";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "needs the models of " << CLEANCOLOR_SHARED;
  std::vector<Part> parts;
  for (const char* colour : {"robot", "crust"})
    for (Part& part : read_model(folder / (std::string("robot-ice_") + colour + ".stl"))) {
      part.mesh = checked(std::move(part.mesh), part.name);
      part.extruder = int(parts.size());
      parts.push_back(std::move(part));
    }
  double floor_mm = 1e9;
  for (const Part& part : parts)
    for (const Vec3& p : part.mesh.vertices) floor_mm = std::min(floor_mm, p.z);
  for (Part& part : parts)
    for (Vec3& p : part.mesh.vertices) p.z -= floor_mm;
  const Slices slices = cleancolor::slices(parts, {.extruders = 2});
  const Azimuths found = azimuths(slices, options_for({{0, 0}, {33, 0}}));
  EXPECT_GT(found.interference_mm3[0], 0.1 * found.part_mm3) << "it is wider than the nozzles are apart";
  ASSERT_TRUE(found.best_deg);
  EXPECT_EQ(found.interference_mm3[std::size_t((*found.least_interference_deg + 360) % 360)], 0);
  EXPECT_LT(found.exposure_s[std::size_t((*found.best_deg + 360) % 360)], 0.011 * found.exposure_s[0]);
}

TEST(AzimuthPicture, ShowsBothCurvesAndChoices) {
  const std::string svg = azimuth_svg(azimuths(random_blobs(3, 2, 3), options_for({{0, 0}, {8, 0}})));
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  for (const char* colour : {"rgb(83.529412%,36.862745%,0%)", "rgb(0%,44.705882%,69.803922%)"}) {
    // A curve, a spoke, a disc and a line in the legend.
    int found = 0;
    for (std::size_t at = svg.find(colour); at != std::string::npos; at = svg.find(colour, at + 1)) ++found;
    EXPECT_EQ(found, 4) << colour;
  }
}
