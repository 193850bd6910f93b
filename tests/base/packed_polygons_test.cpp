#include "base/packed_polygons.hpp"

#include <gtest/gtest.h>

namespace cleancolor {
namespace {

TEST(PackedPolygons, GiveBackTheSameRingsToTheLastNanometre) {
  const Polygons island = difference(rectangle({-12.345678, 0}, {20, 7.000001}), rectangle({1, 1}, {2, 2}));
  const Polygons far{{{-2147483648, -1}, {2147483647, 0}, {1, 2147483647}}};
  for (const Polygons& region : {island, far, Polygons{}, Polygons{{}, rectangle({0, 0}, {1, 1}).front()}}) {
    const PackedPolygons packed = region;
    EXPECT_EQ(Polygons(packed), region);
    EXPECT_EQ(packed.size(), region.size());
    EXPECT_EQ(packed.empty(), region.empty());
  }
}

TEST(PackedPolygons, AreEqualWhereTheRingsAre) {
  const Polygons square = rectangle({0, 0}, {1, 1});
  EXPECT_EQ(PackedPolygons(square), PackedPolygons(square));
  EXPECT_NE(PackedPolygons(square), PackedPolygons(rectangle({0, 0}, {1, 2})));
  // The same points in one ring or in two are not the same.
  const Polygons two{{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 0}, {1, 1}}};
  const Polygons one{{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 0}, {1, 1}}};
  EXPECT_NE(PackedPolygons(two), PackedPolygons(one));
}

TEST(PackedPolygons, MoveWhatLiesTooFarAwayToTheBorder) {
  const Polygons far{{{-9'000'000'000, 5}, {9'000'000'000, 5}, {0, 9}}};
  const Polygons kept = PackedPolygons(far);
  EXPECT_EQ(kept, (Polygons{{{-2'147'483'648, 5}, {2'147'483'647, 5}, {0, 9}}}));
}

TEST(PackedPolygons, OfAllLayersHaveTheBoxOfWhatIsNotEmpty) {
  const std::vector<PackedPolygons> layers =
      packed(std::vector{rectangle({0, 0}, {1, 1}), {}, rectangle({5, -2}, {6, 0})});
  EXPECT_EQ(bounds_mm(layers).min, (Vec2{0, -2}));
  EXPECT_EQ(bounds_mm(layers).max, (Vec2{6, 1}));
  EXPECT_TRUE(bounds_mm(std::vector<PackedPolygons>(3)).empty());
}

}  // namespace
}  // namespace cleancolor
