#include "toolpath/skins.hpp"

#include <gtest/gtest.h>

#include "toolpath/regions.hpp"

namespace cleancolor {
namespace {

std::vector<std::vector<Polygons>> layers(int count, const std::vector<Polygons>& regions) {
  return std::vector<std::vector<Polygons>>(std::size_t(count), regions);
}

double solid_area(const FillAreas& a) {
  return area_mm2(a.top) + area_mm2(a.bottom) + area_mm2(a.bridge) + area_mm2(a.solid);
}

TEST(Skins, OfACubeAreItsFirstAndLastThreeLayers) {
  const Slices cube = slices_of(layers(20, {nested_squares({20})}));
  const Config config = plain_config();
  for (int k = 0; k < 20; ++k) {
    SCOPED_TRACE(k);
    const FillAreas areas = areas_of(cube, k, config)[0];
    const bool skin = k < 3 || k >= 17;
    EXPECT_EQ(solid_area(areas) > 0, skin);
    EXPECT_EQ(areas.sparse.empty(), skin);
    EXPECT_EQ(!areas.top.empty(), k == 19);
    EXPECT_EQ(!areas.bottom.empty(), k == 0);
    EXPECT_TRUE(areas.bridge.empty());
  }
}

TEST(Skins, NeedNoSkinUnderAnotherColourUnlessInterfacesAreAskedFor) {
  auto regions = layers(10, {nested_squares({20}), {}});
  for (int k = 5; k < 10; ++k) regions[std::size_t(k)] = {{}, nested_squares({20})};
  const Slices stacked = slices_of(regions);
  Config config = plain_config(2);
  EXPECT_EQ(solid_area(areas_of(stacked, 4, config)[0]), 0);
  EXPECT_EQ(solid_area(areas_of(stacked, 5, config)[1]), 0);
  config.interface_shells = true;
  EXPECT_GT(area_mm2(areas_of(stacked, 4, config)[0].top), 300);
  EXPECT_GT(area_mm2(areas_of(stacked, 5, config)[1].bridge), 300);
}

TEST(Skins, ReachThreeMillimetresUnderWhatStandsOnThem) {
  // A 30 mm plate with a 10 mm tower on it: the open ring around the tower is grown under the tower by 3 mm.
  auto regions = layers(10, {nested_squares({30})});
  const Polygons tower = rectangle({10, 10}, {20, 20});
  for (int k = 5; k < 10; ++k) regions[std::size_t(k)] = {tower};
  const FillAreas areas = areas_of(slices_of(regions), 4, plain_config())[0];
  EXPECT_NEAR(area_mm2(areas.sparse), 4 * 4, 0.1);  // only the middle of the tower stays open
  EXPECT_NEAR(area_mm2(intersection(areas.top, tower)), 100 - 16, 0.1);
}

TEST(Skins, TurnSmallSparseIslandsSolid) {
  const Slices bar = slices_of(layers(20, {nested_squares({9})}));
  Config config = plain_config();
  EXPECT_GT(area_mm2(areas_of(bar, 10, config)[0].sparse), 0);
  config.solid_infill_below_area_mm2 = 70;
  EXPECT_EQ(area_mm2(areas_of(bar, 10, config)[0].sparse), 0);
  EXPECT_GT(area_mm2(areas_of(bar, 10, config)[0].solid), 0);
}

TEST(Skins, AreasOfALayerAreDisjointAndCoverTheFill) {
  auto regions = layers(12, {nested_squares({30})});
  for (int k = 4; k < 8; ++k) regions[std::size_t(k)] = {nested_squares({30, 12})};
  for (int k = 8; k < 12; ++k) regions[std::size_t(k)] = {rectangle({0, 0}, {30, 14})};
  const Slices slices = slices_of(regions);
  const Config config = plain_config();
  for (int k = 0; k < 12; ++k) {
    SCOPED_TRACE(k);
    const FillAreas a = areas_of(slices, k, config)[0];
    const double parts = solid_area(a) + area_mm2(a.sparse);
    Polygons all;
    for (const Polygons* p : {&a.top, &a.bottom, &a.bridge, &a.solid, &a.sparse}) all = united(all, *p);
    EXPECT_NEAR(area_mm2(all), parts, 0.01);
    EXPECT_NEAR(area_mm2(all), area_mm2(layer_shells(slices, k, config)[0].fill), 0.2);
  }
}

TEST(Skins, HangingSurfacesAreBridges) {
  auto regions = layers(10, {nested_squares({30, 20})});
  for (int k = 5; k < 10; ++k) regions[std::size_t(k)] = {nested_squares({30})};
  const FillAreas roof = areas_of(slices_of(regions), 5, plain_config())[0];
  EXPECT_GT(area_mm2(roof.bridge), 20 * 20);
  EXPECT_TRUE(areas_of(slices_of(regions), 0, plain_config())[0].bridge.empty());
}

TEST(Skins, AtFullDensityEverythingIsSolid) {
  Config config = plain_config();
  config.fill_density = 1;
  const FillAreas areas = areas_of(slices_of(layers(20, {nested_squares({20})})), 10, config)[0];
  EXPECT_TRUE(areas.sparse.empty());
  EXPECT_GT(area_mm2(areas.solid), 300);
}

TEST(Skins, OfNoLayersAreNone) {
  Config config = plain_config();
  config.top_solid_layers = config.bottom_solid_layers = 0;
  const Slices cube = slices_of(layers(5, {nested_squares({20})}));
  for (int k = 0; k < 5; ++k) EXPECT_EQ(solid_area(areas_of(cube, k, config)[0]), 0);
}

}  // namespace
}  // namespace cleancolor
