#include "azimuth_trial.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "model/settings.hpp"
#include "slicing.hpp"

namespace cleancolor {
namespace {

using namespace test;

Polygons turned_by(const Polygons& region, int degrees) {
  Polygons result = region;
  for (Ring& ring : result)
    for (Point& p : ring) p = to_nm(turned(to_mm(p), degrees * std::numbers::pi / 180));
  return result;
}

/// A bar along X of two colours, the first so long that the second nozzle comes to hang over it; 12 layers high.
Slices bar(int degrees) {
  Slices slices;
  for (int k = 0; k < 12; ++k) {
    slices.slabs.push_back({.print_z_mm = 0.3 * (k + 1), .height_mm = 0.3});
    const Polygons left = turned_by(rectangle({-45, -4}, {15, 4}), degrees);
    const Polygons right = turned_by(rectangle({15, -4}, {25, 4}), degrees);
    slices.regions.push_back({left, right});
    slices.outlines.push_back(united(left, right));
  }
  return slices;
}

std::vector<AzimuthTrial> trials(const Slices& slices, const std::vector<int>& turned_by_deg, int threads = 1) {
  const Config config = config_of({.printer = "replicator-dual"});
  return azimuth_trials(slices, Use(slices), config, turned_by_deg, {.layers = 8, .threads = threads});
}

TEST(AzimuthTrial, TurnsABarSoThatIdleNozzlesHangBesideIt) {
  const auto found = trials(bar(0), {0, 90});
  EXPECT_GT(found[0].smear_mm3, 4 * found[1].smear_mm3 + 0.1);
  EXPECT_EQ(cleanest(found), 90);
}

TEST(AzimuthTrial, OfATurnIsThatOfTheTurnedPart) {
  for (const int degrees : {30, 90}) {
    SCOPED_TRACE(degrees);
    const AzimuthTrial turned = trials(bar(0), {degrees}).front(), stands = trials(bar(degrees), {0}).front();
    EXPECT_NEAR(turned.smear_mm3, stands.smear_mm3, 0.25 * stands.smear_mm3 + 0.05);
    EXPECT_NEAR(turned.hole_mm3, stands.hole_mm3, 0.25 * stands.hole_mm3 + 0.05);
  }
}

TEST(AzimuthTrial, IsTheSameForAnyNumberOfThreads) {
  const auto one = trials(bar(0), {0, 45}), three = trials(bar(0), {0, 45}, 3);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].smear_mm3, three[i].smear_mm3);
    EXPECT_EQ(one[i].hole_mm3, three[i].hole_mm3);
  }
}

TEST(AzimuthTrial, IsNoTurnWhereThatBringsLittle) {
  const auto chosen = [](double untouched_mm3, double turned_mm3) {
    return cleanest(std::vector<AzimuthTrial>{{.turned_by_deg = 40, .smear_mm3 = turned_mm3},
                                              {.turned_by_deg = 0, .smear_mm3 = untouched_mm3}});
  };
  EXPECT_EQ(chosen(1, 0.95), 0);
  EXPECT_EQ(chosen(1, 0.8), 40);
}

}  // namespace
}  // namespace cleancolor
