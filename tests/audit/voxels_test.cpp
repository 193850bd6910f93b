#include "audit/part_voxels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>

#include "audit/voxel_surface.hpp"

using namespace cleancolor;

namespace {

double distance_to(const CellRoad& r, Vec2 p) {
  const Vec2 ab = r.b - r.a;
  const double l2 = dot(ab, ab);
  const double t = l2 > 0 ? std::clamp(dot(p - r.a, ab) / l2, 0., 1.) : 0;
  return distance(p, r.a + ab * t);
}

/// A solid cube of 4 mm by two nozzles: the lower half by 0, the upper by 1.
PartLayer cube_layer(int i) {
  PartLayer l{.bottom_mm = 0.2 * i, .top_mm = 0.2 * (i + 1), .roads = {}};
  for (int k = 0; k < 10; ++k)
    l.roads.push_back({{0.2, 0.2 + 0.4 * k}, {3.8, 0.2 + 0.4 * k}, 0.4f, std::uint8_t(i >= 10)});
  return l;
}

Voxels cube() {
  return part_voxels(part_roads(20, cube_layer, 1), {.size_mm = 0.5}, true, 1);
}

}  // namespace

TEST(CellsOfRoad, AreThoseWithTheirMiddleOnTheRoadAndThoseUnderItsLine) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-2, 22), width(0, 3);
  for (int t = 0; t < 300; ++t) {
    SCOPED_TRACE(t);
    const CellRoad road{{place(random), place(random)}, {place(random), place(random)}, width(random)};
    std::array<std::array<bool, 20>, 18> covered{};
    std::vector<CellSpan> spans;
    cells_of_road(road, 20, 18, spans);
    for (const CellSpan& s : spans)
      for (int x = s.first; x <= s.last; ++x) covered.at(std::size_t(s.y)).at(std::size_t(x)) = true;
    // Every cell that the line runs through, from end to end.
    for (int k = 0; k <= 2000; ++k) {
      const Vec2 p = lerp(road.a, road.b, k / 2000.);
      if (p.x < 0 || p.y < 0 || p.x >= 20 || p.y >= 18) continue;
      EXPECT_TRUE(covered[std::size_t(p.y)][std::size_t(p.x)]);
    }
    for (int y = 0; y < 18; ++y)
      for (int x = 0; x < 20; ++x) {
        const double d = distance_to(road, {x + 0.5, y + 0.5});
        // None that the road does not touch at all: half a diagonal further.
        if (d < road.half_width - 1e-9) {
          EXPECT_TRUE(covered[std::size_t(y)][std::size_t(x)]);
        } else if (d > road.half_width + 0.708) {
          EXPECT_FALSE(covered[std::size_t(y)][std::size_t(x)]);
        }
      }
  }
}

TEST(Flood, ReachesWhatASlowFloodReaches) {
  std::mt19937 random(2);
  for (int t = 0; t < 100; ++t) {
    SCOPED_TRACE(t);
    const int row = 1 + int(random() % 90), plane = 64 * (1 + int(random() % 8)), planes = 1 + int(random() % 5);
    const bool flat = planes == 1;
    const int cells = plane * planes;
    BitWords solid(std::size_t(cells / 64)), reached(solid.size());
    std::vector<char> slow(std::size_t(cells), 0);
    for (int i = 0; i < cells; ++i)
      if (random() % 100 < 45) fill_bits(solid, i, i, true);
    std::vector<int> todo;
    for (int k = 0; k < 3; ++k) {
      const int i = int(random() % unsigned(cells));
      if (bit(solid, i)) continue;
      fill_bits(reached, i, i, true);
      slow[std::size_t(i)] = 1;
      todo.push_back(i);
    }
    while (!todo.empty()) {
      const int i = todo.back();
      todo.pop_back();
      for (const int d : {1, -1, row, -row, flat ? 0 : plane, flat ? 0 : -plane}) {
        const int j = i + d;
        if (j < 0 || j >= cells || bit(solid, j) || slow[std::size_t(j)]) continue;
        slow[std::size_t(j)] = 1;
        todo.push_back(j);
      }
    }
    flood(reached, solid, row, flat ? 0 : plane);
    for (int i = 0; i < cells; ++i) ASSERT_EQ(bit(reached, i), bool(slow[std::size_t(i)])) << i;
  }
}

// A spiral of walls, one cell wide, is the longest way that there is.
TEST(Flood, FollowsASpiralToItsEnd) {
  constexpr int side = 127;
  BitWords solid((side * side + 63) / 64), reached(solid.size());
  fill_bits(solid, 0, std::int64_t(64 * solid.size()) - 1, true);
  int x = 0, y = 0, dx = 1, dy = 0, length = side - 1;
  fill_bits(solid, 0, 0, false);
  for (int leg = 0; length > 0; ++leg) {
    for (int k = 0; k < length; ++k) {
      x += dx, y += dy;
      fill_bits(solid, y * side + x, y * side + x, false);
    }
    std::swap(dx, dy);
    dx = -dx;
    if (leg >= 2 && leg % 2 == 0) length -= 2;
  }
  fill_bits(reached, 0, 0, true);
  flood(reached, solid, side, 0);
  EXPECT_TRUE(bit(reached, y * side + x));
}

TEST(Voxels, OfACubeFillItAndKnowTheirNozzle) {
  const Voxels v = cube();
  int solid = 0, upper = 0;
  for (std::int64_t i = 0; i < std::int64_t(v.solid.size()) * 64; ++i) {
    solid += bit(v.solid, i);
    upper += bit(v.solid, i) && v.nozzle(i) == 1;
    EXPECT_FALSE(bit(v.solid, i) && bit(v.outside, i));
  }
  EXPECT_EQ(solid, 8 * 8 * 8);
  EXPECT_EQ(upper, 8 * 8 * 4);
}

TEST(VoxelSurface, OfACubeHasFiveSidesOfSquares) {
  const VoxelSurface s = voxel_surface(cube(), 0);
  ASSERT_EQ(s.quads.size(), 5u * 8 * 8);
  // Seen from outside: the vectors of the areas point away from the middle of the cube.
  std::array<double, 3> highest{};
  for (const auto& q : s.quads) {
    const Vec3 a = s.vertices_mm[q[0]], b = s.vertices_mm[q[1]], c = s.vertices_mm[q[2]];
    const Vec3 area = cross(b - a, c - a), out = (a + c) * 0.5 - Vec3{2, 2, 2};
    EXPECT_NEAR(length(area), 0.25, 1e-9);
    EXPECT_NEAR(dot(area, out), 0.25 * 2, 1e-6);
    highest[2] = std::max(highest[2], a.z);
  }
  EXPECT_NEAR(highest[2], 4, 1e-6);
  EXPECT_EQ(std::count(s.nozzle.begin(), s.nozzle.end(), 1), 4 * 8 * 4 + 8 * 8);
}

TEST(VoxelSurface, IsClosedButForTheBed) {
  const VoxelSurface s = voxel_surface(cube());
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& q : s.quads)
    for (std::size_t k = 0; k < 4; ++k) ++edges[{q[k], q[(k + 1) % 4]}];
  int open = 0;
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    open += !edges.contains({edge.second, edge.first});
  }
  EXPECT_EQ(open, 4 * 8) << "around the bed";
}
