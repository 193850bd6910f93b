#include "model/placement.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "meshes.hpp"
#include "model/reach.hpp"

namespace cleancolor {
namespace {

Part box_part(Vec3 min, Vec3 max, int extruder = 0) {
  return {"box", box_mesh(min, max), extruder, {}, {}};
}

Config placed_printer() {
  Config config;
  config.bed_shape_mm = {{0, 0}, {200, 0}, {200, 100}, {0, 100}};
  config.max_print_height_mm = 150;
  config.extruders.resize(2);
  return config;
}

Box<Vec3> box_of(const std::vector<Part>& parts) {
  Box<Vec3> box;
  for (const Part& part : parts)
    for (const Vec3& p : part.mesh.vertices) box.add(p);
  return box;
}

TEST(Place, CentresAllPartsTogetherAndDropsThemTogether) {
  std::vector<Part> parts = {box_part({0, 0, -5}, {20, 20, 15}), box_part({20, 0, 0}, {40, 20, 15}, 1)};
  Warnings warnings;
  place(parts, placed_printer(), {}, warnings.progress);
  EXPECT_EQ(bounds(parts[0].mesh).min, (Vec3{80, 40, 0}));
  EXPECT_EQ(bounds(parts[1].mesh).min, (Vec3{100, 40, 5}));
  EXPECT_TRUE(warnings.contain("5.00 mm below the bed")) << warnings.all();
}

TEST(Place, UsesTheAreaThatAllNeededNozzlesReach) {
  Config config = placed_printer();
  config.extruders[0].extruder_printable_area_mm = {{0, 0}, {150, 0}, {150, 100}, {0, 100}};
  config.extruders[1].extruder_printable_area_mm = {{50, 0}, {200, 0}, {200, 100}, {50, 100}};
  std::vector<Part> one = {box_part({0, 0, 0}, {20, 20, 20})};
  place(one, config, {});
  EXPECT_DOUBLE_EQ(box_of(one).center().x, 75);
  std::vector<Part> both = {box_part({0, 0, 0}, {20, 20, 20}), box_part({20, 0, 0}, {40, 20, 20}, 1)};
  place(both, config, {});
  EXPECT_DOUBLE_EQ(box_of(both).center().x, 100);
}

TEST(Place, RefusesAPartOutOfReachOfItsOwnNozzle) {
  Config config = placed_printer();
  config.extruders[1].extruder_printable_area_mm = {{50, 0}, {200, 0}, {200, 100}, {50, 100}};
  std::vector<Part> parts = {box_part({40, 40, 0}, {60, 60, 20}, 1)};
  Placement keep;
  keep.keep = true;
  EXPECT_TRUE(says(refusal([&] { place(parts, config, keep); }), "extruder 2 reaches only X 50.0"));
}

TEST(Reach, IsTheAreaOfTheNozzleWithinTheBed) {
  Config config = placed_printer();
  config.extruders[1].extruder_printable_area_mm = {{250, -50}, {50, -50}, {50, 60}, {250, 60}};  // clockwise
  EXPECT_EQ(area_mm2(reach(config, 1)), 150 * 60);
  EXPECT_EQ(bounds_mm(reach(config, 1)).max, (Vec2{200, 60}));
}

TEST(Reach, IsTheWholeBedForNozzlesOnOneCarriageThatNameNoArea) {
  Config config = placed_printer();
  config.extruders[1].nozzle_offset_mm = {33, 0};
  for (const int extruder : {0, 1}) EXPECT_EQ(area_mm2(reach(config, extruder)), 200 * 100);
}

TEST(Place, RefusesWhatIsTooLargeAndSaysBothSizes) {
  std::vector<Part> parts = {box_part({0, 0, 0}, {400, 20, 20})};
  EXPECT_TRUE(says(refusal([&] { place(parts, placed_printer(), {}); }),
                   "400.0 x 20.0 x 20.0 mm, but the print volume is 200.0 x 100.0 x 150.0 mm"));
}

TEST(Place, KeepsPartsInsideTheBedAlsoWhereTheyArePrintedLarger) {
  Config config = placed_printer();
  config.xy_size_compensation_mm = 2;
  std::vector<Part> fits = {box_part({0, 0, 0}, {196, 20, 20})}, too_long = {box_part({0, 0, 0}, {197, 20, 20})};
  place(fits, config, {});
  EXPECT_TRUE(says(refusal([&] { place(too_long, config, {}); }), "201.0 x 24.0 x 20.0 mm (with xy_size_comp"));
  std::vector<Part> at_the_edge = {box_part({1, 40, 0}, {11, 50, 20})};
  Placement keep;
  keep.keep = true;
  EXPECT_TRUE(says(refusal([&] { place(at_the_edge, config, keep); }), "X -1.0 to 13.0"));
}

TEST(Place, TurnsBeforeItCentres) {
  std::vector<Part> parts = {box_part({0, 0, 0}, {20, 150, 20})};
  Placement turned;
  turned.rotate_deg = 90;
  place(parts, placed_printer(), turned);
  EXPECT_EQ(box_of(parts).size(), (Vec3{150, 20, 20}));
  EXPECT_DOUBLE_EQ(volume_mm3(parts[0].mesh), 60'000);
}

TEST(Place, ScalesVolumesByTheCube) {
  std::vector<Part> parts = {box_part({-5, -5, -5}, {5, 5, 5})};
  Placement placement;
  placement.scale = 2;
  placement.rotate_deg = 30;
  place(parts, placed_printer(), placement);
  EXPECT_NEAR(volume_mm3(parts[0].mesh), 8000, 1e-9);
  EXPECT_NEAR(box_of(parts).size().x, 20 * (std::sqrt(3.0) + 1) / 2, 1e-9);
}

TEST(Place, ObeysCenterAndNoCenter) {
  std::vector<Part> parts = {box_part({10, 10, 10}, {20, 20, 20})};
  Placement keep;
  keep.keep = true;
  place(parts, placed_printer(), keep);
  EXPECT_EQ(box_of(parts).min, (Vec3{10, 10, 0}));
  Placement there;
  there.center_mm = Vec2{50, 60};
  place(parts, placed_printer(), there);
  EXPECT_EQ(box_of(parts).min, (Vec3{45, 55, 0}));
  there.center_mm = Vec2{1e300, 0};
  EXPECT_TRUE(says(refusal([&] { place(parts, placed_printer(), there); }), "reaches only"));
}

TEST(Place, RefusesTheCornersOfARoundBed) {
  Config config = placed_printer();
  config.bed_shape_mm.clear();
  for (int i = 0; i < 72; ++i)
    config.bed_shape_mm.push_back(
        {100 * std::cos(i * std::numbers::pi / 36), 100 * std::sin(i * std::numbers::pi / 36)});
  std::vector<Part> fits = {box_part({0, 0, 0}, {140, 140, 10})}, sticks_out = {box_part({0, 0, 0}, {145, 145, 10})};
  place(fits, config, {});
  EXPECT_NEAR(box_of(fits).center().x, 0, 1e-6);
  EXPECT_TRUE(says(refusal([&] { place(sticks_out, config, {}); }), "reaches only"));
}

TEST(Place, WarnsOfPartsFarOffTheBedButNotOfOnesDrawnAroundTheOrigin) {
  std::vector<Part> far = {box_part({490, 490, 0}, {510, 510, 20})}, around = {box_part({-10, -10, 0}, {10, 10, 20})};
  Warnings of_far, of_around;
  place(far, placed_printer(), {}, of_far.progress);
  place(around, placed_printer(), {}, of_around.progress);
  EXPECT_TRUE(of_far.contain("outside the bed")) << of_far.all();
  EXPECT_EQ(of_around.texts.size(), 0) << of_around.all();
}

}  // namespace
}  // namespace cleancolor
