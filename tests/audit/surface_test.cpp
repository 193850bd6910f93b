#include "audit/surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace cleancolor;

namespace {

constexpr float half = 0.2f;

SurfaceRoad part(Vec2 a, Vec2 b, int nozzle, bool visible, std::uint32_t order = 0) {
  return {a, b, half, order, std::uint8_t(nozzle), true, visible};
}

SurfaceRoad auxiliary(Vec2 a, Vec2 b, std::uint32_t order) {
  return {a, b, half, order, 1, false, false};
}

std::vector<SurfacePiece> pieces(const LayerSurface& surface, const SurfaceWay& way) {
  SurfaceScratch scratch;
  std::vector<SurfacePiece> found;
  surface.along(way, scratch, found);
  return found;
}

/// The way goes along X from 0 to 10, so a share of 0.1 is 1 mm.
constexpr SurfaceWay along_x{{0, 0}, {10, 0}, 0, 100};

double distance_to(const SurfaceRoad& r, Vec2 p) {
  const Vec2 d = r.b_mm - r.a_mm;
  const double l2 = dot(d, d);
  return distance(p, lerp(r.a_mm, r.b_mm, l2 > 0 ? std::clamp(dot(p - r.a_mm, d) / l2, 0., 1.) : 0.));
}

/// What is on top at a point, by looking at all roads; roads.size(): nothing.
std::size_t top_at(const std::vector<SurfaceRoad>& roads, Vec2 p, const SurfaceWay& way) {
  const auto key = [&](const SurfaceRoad& r) {
    return std::tuple(!r.part, r.part && r.nozzle == way.nozzle, !r.visible, r.drive_order);
  };
  std::size_t best = roads.size();
  for (std::size_t i = 0; i < roads.size(); ++i) {
    if (distance_to(roads[i], p) > double(roads[i].half_width_mm)) continue;
    if (!roads[i].part && roads[i].drive_order >= way.move) continue;
    if (best == roads.size() || key(roads[i]) < key(roads[best])) best = i;
  }
  return best;
}

}  // namespace

TEST(LayerSurface, CrossesARoadOverItsWidth) {
  // Across at 90 degrees: from x = 4.8 to 5.2.
  const auto found = pieces(LayerSurface({part({5, -3}, {5, 3}, 1, true)}), along_x);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].begin, 0.48, 1e-6);
  EXPECT_NEAR(found[0].end, 0.52, 1e-6);
  EXPECT_TRUE(found[0].visible);
  EXPECT_EQ(found[0].nozzle, 1);
}

TEST(LayerSurface, CrossesRoundEndsAndDiscsAlongTheirChord) {
  // The road ends 0.12 mm below the way: the chord of a circle of 0.2 mm at 0.12 is 2 x 0.16 = 0.32 mm.
  const auto end = pieces(LayerSurface({part({5, -3}, {5, -0.12}, 1, true)}), along_x);
  ASSERT_EQ(end.size(), 1u);
  EXPECT_NEAR(end[0].begin, 0.484, 1e-6);
  EXPECT_NEAR(end[0].end, 0.516, 1e-6);
  const auto disc = pieces(LayerSurface({part({5, 0.12}, {5, 0.12}, 1, true)}), along_x);
  ASSERT_EQ(disc.size(), 1u);
  EXPECT_NEAR(disc[0].begin, 0.484, 1e-6);
  EXPECT_NEAR(disc[0].end, 0.516, 1e-6);
}

TEST(LayerSurface, FollowsARoadThatItLiesOn) {
  // From 0.2 mm before its begin to 0.2 mm behind its end.
  const auto found = pieces(LayerSurface({part({2, 0}, {7, 0}, 1, true)}), along_x);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].begin, 0.18, 1e-6);
  EXPECT_NEAR(found[0].end, 0.72, 1e-6);
}

TEST(LayerSurface, ATipThatStandsIsOverAllOrNothing) {
  const LayerSurface surface({part({5, -3}, {5, 3}, 1, true)});
  const auto on = pieces(surface, {{5.1, 0}, {5.1, 0}, 0, 100});
  ASSERT_EQ(on.size(), 1u);
  EXPECT_EQ(on[0].begin, 0);
  EXPECT_EQ(on[0].end, 1);
  EXPECT_TRUE(pieces(surface, {{5.3, 0}, {5.3, 0}, 0, 100}).empty());
}

// Roads 0.4 mm wide that cross the way at these places; each begins where the one before it is still there.
TEST(LayerSurface, PartLiesOverAuxiliaryForeignOverOwnVisibleOverInner) {
  const auto at = [](double x) { return std::pair{Vec2{x, -3}, Vec2{x, 3}}; };
  const auto [a1, a2] = at(5.0);
  const auto [b1, b2] = at(5.3);
  const auto [c1, c2] = at(5.6);
  const auto [d1, d2] = at(5.9);
  const auto [e1, e2] = at(6.2);
  const LayerSurface surface({auxiliary(a1, a2, 1), part(b1, b2, 0, false), part(c1, c2, 0, true),
                              part(d1, d2, 1, false), part(e1, e2, 1, true)});
  const auto found = pieces(surface, along_x);
  ASSERT_EQ(found.size(), 5u);
  const double begins[] = {4.8, 5.1, 5.4, 5.7, 6.0};
  for (std::size_t i = 0; i < 5; ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(found[i].road, i);
    EXPECT_NEAR(found[i].begin, begins[i] / 10, 1e-6);
    EXPECT_NEAR(found[i].end, i < 4 ? begins[i + 1] / 10 : 0.64, 1e-6);
  }
}

TEST(LayerSurface, OfOneKindTheRoadPrintedFirstLiesOnTop) {
  const auto found =
      pieces(LayerSurface({part({5.2, -3}, {5.2, 3}, 1, true, 7), part({5, -3}, {5, 3}, 1, true, 9)}), along_x);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].road, 1u);
  EXPECT_NEAR(found[0].end, 0.50, 1e-6);
  EXPECT_EQ(found[1].road, 0u);
}

TEST(LayerSurface, AuxiliaryPlasticThatIsNotPrintedYetIsNotThere) {
  const LayerSurface surface({auxiliary({5, -3}, {5, 3}, 50)});
  EXPECT_EQ(pieces(surface, {{0, 0}, {10, 0}, 0, 51}).size(), 1u);
  EXPECT_TRUE(pieces(surface, {{0, 0}, {10, 0}, 0, 50}).empty());
  EXPECT_EQ(pieces(LayerSurface({part({5, -3}, {5, 3}, 1, true, 50)}), {{0, 0}, {10, 0}, 0, 1}).size(), 1u)
      << "the part counts as a whole layer";
}

TEST(LayerSurface, OfNothingHasNothing) {
  EXPECT_TRUE(pieces(LayerSurface(), along_x).empty());
  EXPECT_TRUE(LayerSurface().roads().empty());
}

TEST(LayerSurface, TellsWhatAPointwiseLookAtAllRoadsTells) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const double extent = seed % 3 == 0 ? 500 : 12;  // far apart: the table of cells wraps round
    const auto anywhere = [&] {
      return Vec2{std::uniform_real_distribution(0., extent)(random), std::uniform_real_distribution(0., 12.)(random)};
    };
    const auto below = [&](int n) { return int(random() % unsigned(n)); };
    std::vector<SurfaceRoad> roads;
    for (int i = 0; i < 80; ++i) {
      const Vec2 a = anywhere();
      const Vec2 b = below(5) == 0 ? anywhere() : below(9) == 0 ? a : a + Vec2{below(40) / 10., below(40) / 10. - 2};
      roads.push_back({a, b, 0.1f * float(1 + below(12)), std::uint32_t(below(40)), std::uint8_t(below(3)),
                       below(4) > 0, below(2) == 0});
      roads.back().visible = roads.back().visible && roads.back().part;
    }
    const LayerSurface surface(roads);
    SurfaceScratch scratch;
    for (int w = 0; w < 20; ++w) {
      const SurfaceWay way{anywhere(), anywhere(), below(3), std::uint32_t(below(50))};
      std::vector<SurfacePiece> found;
      surface.along(way, scratch, found);
      for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_LT(found[i].begin, found[i].end);
        ASSERT_TRUE(i == 0 || found[i].begin >= found[i - 1].end);
      }
      for (int s = 0; s < 200; ++s) {
        const double t = (s + 0.5) / 200;
        const Vec2 p = lerp(way.a_mm, way.b_mm, t);
        // Next to a border either answer is right.
        const auto borders = [&](const SurfaceRoad& r) {
          return std::abs(distance_to(r, p) - double(r.half_width_mm)) < 1e-3;
        };
        if (std::ranges::any_of(roads, borders)) continue;
        const auto piece = std::ranges::find_if(
            found, [&](const SurfacePiece& f) { return f.begin <= float(t) && float(t) <= f.end; });
        const std::size_t top = top_at(roads, p, way);
        ASSERT_EQ(piece == found.end(), top == roads.size()) << t;
        if (piece == found.end()) continue;
        EXPECT_EQ(piece->road, top) << t;
        EXPECT_EQ(piece->nozzle, roads[top].nozzle);
        EXPECT_EQ(piece->part, roads[top].part);
        EXPECT_EQ(piece->visible, roads[top].visible);
      }
    }
  }
}

// Two roads 20 m apart, and one across: cells and ways must not follow the distance.
TEST(LayerSurface, RoadsFarApartCostNoMoreThanOthers) {
  const LayerSurface surface({part({-10000, 0}, {-9999, 0}, 1, true), part({10000, 5}, {9999, 5}, 1, true),
                              part({0, -10000}, {0, 10000}, 1, true)});
  SurfaceScratch scratch;
  std::vector<SurfacePiece> found;
  surface.along({{-10000, 0}, {10000, 0}, 0, 0}, scratch, found);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[1].begin, 0.5, 1e-3);
  EXPECT_LT(scratch.work, 10'000u);
}

TEST(LayerSurface, WidthsBeyondReasonAreCapped) {
  const auto found = pieces(LayerSurface({{{5, -3}, {5, 3}, 1e9f, 0, 1, true, true}}), along_x);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].begin, 0.25, 1e-6);
  EXPECT_NEAR(found[0].end, 0.75, 1e-6);
}
