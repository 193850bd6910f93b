#include "replan/storeys.hpp"

#include <gtest/gtest.h>

namespace cleancolor {
namespace {

/// A layer with a square of one extruder for each letter: 'a' at X 0, 'b' at X 20; 's' a support at X 40.
struct Drawn {
  double top_mm, height_mm;
  std::string has;
};

std::pair<Slices, Slices> drawn(const std::vector<Drawn>& layers) {
  Slices part, around;
  for (const Drawn& layer : layers) {
    Polygons own, all;
    for (const char c : layer.has) {
      const double x = c == 'a' ? 0 : c == 'b' ? 20 : 40;
      const Polygons square = rectangle({x, 0}, {x + 10, 10});
      append(all, square);
      if (c != 's') append(own, square);
    }
    part.slabs.push_back({layer.top_mm, layer.height_mm});
    part.regions.push_back({own});
    part.outlines.push_back(own);
    around.outlines.push_back(all);
  }
  return {part, around};
}

Storeys storeys_of(const std::vector<Drawn>& layers) {
  auto [part, around] = drawn(layers);
  return storeys(std::move(part), std::move(around));
}

std::vector<double> tops(const Storeys& s) {
  std::vector<double> all;
  for (const Slab& slab : s.part.slabs) all.push_back(slab.print_z_mm);
  return all;
}

double covered_mm2(const PackedPolygons& region) {
  return area_mm2(Polygons(region));
}

TEST(Storeys, AreTheLayersWhereEachStandsOnTheOneBefore) {
  const Storeys s = storeys_of({{0.2, 0.2, "as"}, {0.5, 0.3, "a"}, {0.6, 0.1, "ab"}});
  EXPECT_EQ(tops(s), (std::vector<double>{0.2, 0.5, 0.6}));
  EXPECT_EQ(s.of_layer, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(s.is_storey, (std::vector<bool>{true, true, true}));
  EXPECT_EQ(s.around.regions, s.part.regions);
}

TEST(Storeys, LeaveOutLayersOfSupportsBetweenThoseOfThePart) {
  const Storeys s = storeys_of({{0.3, 0.3, "as"}, {0.4, 0.1, "s"}, {0.6, 0.3, "a"}, {0.7, 0.1, "s"}, {0.9, 0.3, "a"}});
  EXPECT_EQ(tops(s), (std::vector<double>{0.3, 0.6, 0.9}));
  EXPECT_EQ(s.of_layer, (std::vector<std::size_t>{0, 0, 1, 1, 2}));
  EXPECT_EQ(s.is_storey, (std::vector<bool>{true, false, true, false, true}));
  // What they print is around the storey that is printed next.
  EXPECT_NEAR(covered_mm2(s.around.outlines[1]), 200, 1e-6);
  EXPECT_NEAR(covered_mm2(s.part.outlines[1]), 100, 1e-6);
}

TEST(Storeys, BeginAtTheBedBelowARaft) {
  const Storeys s = storeys_of({{0.3, 0.3, "s"}, {0.55, 0.25, "s"}, {0.6, 0.3, "s"}, {0.9, 0.3, "a"}, {1.2, 0.3, "a"}});
  EXPECT_EQ(tops(s), (std::vector<double>{0.3, 0.55, 0.9, 1.2}));
  double below_mm = 0;
  for (const Slab& slab : s.part.slabs) {
    EXPECT_NEAR(slab.print_z_mm - slab.height_mm, below_mm, 1e-9);
    below_mm = slab.print_z_mm;
  }
}

TEST(Storeys, HaveAllThatLiesAtTheirHeightWhateverItsLayers) {
  const Storeys s = storeys_of({{0.2, 0.2, "a"}, {0.25, 0.25, "b"}, {0.4, 0.2, "a"}, {0.5, 0.25, "b"}});
  EXPECT_EQ(tops(s), (std::vector<double>{0.2, 0.4, 0.5}));  // 0.05 mm would be too thin
  EXPECT_EQ(s.of_layer, (std::vector<std::size_t>{0, 0, 1, 2}));
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(covered_mm2(s.part.outlines[k]), 200, 1e-6) << k;
  EXPECT_NEAR(covered_mm2(s.part.outlines[2]), 100, 1e-6);  // nothing of a is above 0.4
}

}  // namespace
}  // namespace cleancolor
