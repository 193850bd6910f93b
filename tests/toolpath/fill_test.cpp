#include "toolpath/fill.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "base/edge_rows.hpp"
#include "toolpath/link.hpp"
#include "toolpath/regions.hpp"

namespace cleancolor {
namespace {

constexpr double spacing = 0.3356;

std::vector<Path> fill_of(const Polygons& region, FillPattern pattern, double density, double z = 1) {
  return filled(
      region,
      {.pattern = pattern, .density = density, .angle_rad = std::numbers::pi / 4, .z_mm = z, .spacing_mm = spacing},
      plain_roads().internal_infill);
}

const auto all_patterns = {FillPattern::rectilinear, FillPattern::grid, FillPattern::gyroid, FillPattern::concentric};

Polygons keyhole() {
  return difference(united(nested_squares({40}), rectangle({40, 15}, {60, 25})), rectangle({10, 10}, {25, 30}));
}

TEST(Fill, NeverLeavesTheRegion) {
  for (const FillPattern pattern : all_patterns)
    for (const double density : {0.1, 0.2, 0.5, 1.0}) {
      SCOPED_TRACE(testing::Message() << "pattern " << int(pattern) << " density " << density);
      const EdgeRows inside(offset(keyhole(), 1e-4));
      for (const Path& path : fill_of(keyhole(), pattern, density))
        for (std::size_t i = 0; i < path.segments(); ++i) {
          const Vec2 a = path.points[i], b = path.points[(i + 1) % path.points.size()];
          EXPECT_TRUE(inside.contains(lerp(a, b, 0.5))) << a.x << ',' << a.y << " to " << b.x << ',' << b.y;
        }
    }
}

// Lines alone give the density; links along the border add to it, the margin inside the border takes away.
TEST(Fill, LaysAsMuchLineAsTheDensityAsks) {
  const Polygons region = nested_squares({200});
  const double area = area_mm2(region);
  for (const FillPattern pattern : all_patterns)
    for (const double density : {0.1, 0.2, 0.4}) {
      SCOPED_TRACE(testing::Message() << "pattern " << int(pattern) << " density " << density);
      double length = 0;
      for (int i = 0; i < 12; ++i)  // over the gyroid's period
        length += total_length_mm(filled(region,
                                         {.pattern = pattern,
                                          .density = density,
                                          .z_mm = i * 2.44 * spacing / density / 12,
                                          .spacing_mm = spacing,
                                          .max_link_mm = 0},
                                         plain_roads().internal_infill)) /
                  12;
      EXPECT_NEAR(length * spacing / area, density, density * 0.06);
    }
}

TEST(Fill, AtFullDensityCoversTheRegion) {
  for (const Polygons& region : {nested_squares({10}), keyhole()}) {
    const double volume = total_volume_mm3(fill_of(region, FillPattern::rectilinear, 1));
    EXPECT_NEAR(volume / (area_mm2(region) * 0.3), 1, 0.06);
  }
}

TEST(Fill, OfAConvexRegionIsOnePath) {
  EXPECT_EQ(fill_of(nested_squares({30}), FillPattern::rectilinear, 1).size(), 1u);
  EXPECT_LE(fill_of(nested_squares({30}), FillPattern::rectilinear, 0.2).size(), 2u);
}

TEST(Fill, LinesLieAtTheSamePlacesInEveryIsland) {
  // Two islands of one region: sparse lines must be collinear, so that layers stack on each other.
  const auto offsets_at = [](const Polygons& region) {
    std::vector<double> offsets;
    for (const Path& path :
         filled(region, {.density = 0.2, .spacing_mm = spacing, .max_link_mm = 0}, plain_roads().internal_infill))
      offsets.push_back(std::remainder(path.points[0].y, spacing / 0.2));
    return offsets;
  };
  const auto a = offsets_at(rectangle({0, 0}, {20, 20})), b = offsets_at(rectangle({103.7, 41.1}, {120, 60}));
  for (const double x : b) EXPECT_NEAR(x, a.front(), 1e-6);
}

TEST(Fill, OfNothingOrOfLessThanARoadIsNothing) {
  for (const FillPattern pattern : all_patterns) {
    EXPECT_TRUE(fill_of({}, pattern, 0.2).empty());
    EXPECT_TRUE(fill_of(rectangle({0, 0}, {10, 0.2}), pattern, 0.2).empty());
  }
}

TEST(FillAngle, TurnsByARightAngleFromLayerToLayer) {
  Config config;
  config.fill_angle_deg = 30;
  EXPECT_NEAR(fill_angle_rad(config, 0), std::numbers::pi / 6, 1e-12);
  EXPECT_NEAR(fill_angle_rad(config, 1) - fill_angle_rad(config, 0), std::numbers::pi / 2, 1e-12);
}

// A 10 x 10 square with three vertical lines; ends numbered as they are met.
std::vector<std::vector<Vec2>> three_lines_linked(double max_link_mm) {
  static const std::vector<std::vector<Vec2>> rings = {{{0, 0}, {10, 0}, {10, 10}, {0, 10}}};
  const Border border(rings);
  std::vector<BorderLine> lines;
  for (int i = 0; i < 3; ++i) {
    const double x = 2 + 3 * i;
    lines.push_back({{{x, 0}, {x, 10}}, border.place(0, 0, {x, 0}), border.place(0, 2, {x, 10}), i});
  }
  return linked(lines, border, max_link_mm);
}

TEST(Linked, JoinsNeighboursInZigzag) {
  const auto paths = three_lines_linked(4);
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_EQ(paths[0], (std::vector<Vec2>{{2, 0}, {2, 10}, {5, 10}, {5, 0}, {8, 0}, {8, 10}}));
}

TEST(Linked, LeavesLinesApartThatAreTooFar) {
  EXPECT_EQ(three_lines_linked(2.9).size(), 3u);
}

TEST(Linked, NeverClosesARing) {
  // Long links allow going round the corners; still every line is in exactly one open path.
  const auto paths = three_lines_linked(100);
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_NE(paths[0].front(), paths[0].back());
}

}  // namespace
}  // namespace cleancolor
