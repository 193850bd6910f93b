#include "base/edge_rows.hpp"

#include <gtest/gtest.h>

#include <random>

namespace cleancolor {
namespace {

/// Overlapping boxes and triangles, united: outlines and holes of all kinds.
Polygons random_region(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> at(0, 50), size(1, 15);
  Polygons region;
  for (int i = 0; i < 12; ++i) {
    const Vec2 a{at(random), at(random)};
    Ring triangle{to_nm(a), to_nm(a + Vec2{size(random), size(random)}), to_nm(a + Vec2{-size(random), size(random)})};
    if (!ClipperLib::Orientation(triangle)) ClipperLib::ReversePath(triangle);
    region = i % 3 == 2 ? difference(region, {triangle}) : united(region, {triangle});
  }
  return region;
}

TEST(EdgeRows, ContainsWhatPointInPolygonContains) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const Polygons region = random_region(seed);
    const EdgeRows rows(region);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(-5, 70);
    for (int i = 0; i < 300; ++i) {
      const Vec2 p{at(random), at(random)};
      EXPECT_EQ(rows.contains(p), contains(region, to_nm(p))) << p.x << ' ' << p.y;
    }
  }
}

// The slow and obvious way: a line as a very thin rectangle, intersected with the region.
TEST(EdgeRows, ClipsLinesAsThinRectanglesAreClipped) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const Polygons region = random_region(seed);
    const EdgeRows rows(region);
    const double y = 3.3 + seed, width = 1e-3;
    double clipped_mm = 0;
    const std::vector<Vec2> line = {{-10, y}, {11.7, y}, {33.1, y}, {90, y}};
    for (const auto& piece : rows.clipped(line))
      for (std::size_t i = 1; i < piece.size(); ++i) clipped_mm += distance(piece[i - 1], piece[i]);
    const double oracle = area_mm2(intersection(rectangle({-10, y - width / 2}, {90, y + width / 2}), region)) / width;
    EXPECT_NEAR(clipped_mm, oracle, 0.01);
  }
}

TEST(EdgeRows, NearestEdgeIsTheOneBesideThePoint) {
  const EdgeRows rows(rectangle({0, 0}, {10, 10}));
  const EdgeRows::Edge* edge = rows.nearest({10.0005, 4}, 1e-3);
  ASSERT_NE(edge, nullptr);
  EXPECT_EQ(edge->a.x, 10);
  EXPECT_EQ(edge->b.x, 10);
  EXPECT_EQ(rows.nearest({5, 5}, 1), nullptr);
}

TEST(EdgeRows, OfNothingContainNothing) {
  const EdgeRows rows{Polygons{}};
  EXPECT_FALSE(rows.contains({0, 0}));
  EXPECT_TRUE(rows.clipped({{0, 0}, {1, 1}}).empty());
  EXPECT_EQ(rows.nearest({0, 0}, 1), nullptr);
}

}  // namespace
}  // namespace cleancolor
