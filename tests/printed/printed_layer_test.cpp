#include "printed/printed_layer.hpp"

#include <gtest/gtest.h>

#include <random>

#include "explain/drawn_plan.hpp"

namespace cleancolor {
namespace {

Drawing one_nozzle() {
  Drawing d(drawn_machine({{0, 0}}));
  d.layer(0);
  return d;
}

TEST(PrintedLayer, HasAPathForEachRunInPrintingOrder) {
  Drawing d = one_nozzle();
  draw_loop(d.wall(), {0, 0}, {10, 10});
  d.infill().road({1, 1}, {9, 9}).lay({9, 8});
  const PrintedLayer layer = printed(d);
  ASSERT_EQ(layer.runs.size(), 2u);
  const Path &loop = layer.runs[0].path, &fill = layer.runs[1].path;
  EXPECT_TRUE(loop.closed);
  EXPECT_EQ(loop.points.size(), 4u);
  EXPECT_NEAR(length_mm(loop), 40, 1e-4);
  EXPECT_EQ(loop.road().role, Role::external_perimeter);
  EXPECT_NEAR(loop.road().width_mm, drawn_width_mm, 1e-3);
  EXPECT_NEAR(loop.road().area_mm2, drawn_area_mm2, 1e-4);
  EXPECT_FALSE(fill.closed);
  EXPECT_NEAR(length_mm(fill), 8 * std::sqrt(2.) + 1, 1e-4);
  EXPECT_EQ(fill.road().role, Role::internal_infill);
}

TEST(PrintedLayer, BreaksRunsAtTravelRetractionAndOtherNozzles) {
  Drawing d(drawn_machine(two_nozzles));
  d.layer(0).infill();
  d.road({0, 0}, {5, 0}).lay({10, 0});  // one
  d.feed(-1).feed(1).lay({10, 5});      // two: at the same place after a retraction
  d.go({10, 6}).lay({10, 10});          // three
  d.tool(1).road({20, 0}, {25, 0});     // four
  const PrintedLayer layer = printed(d);
  ASSERT_EQ(layer.runs.size(), 4u);
  EXPECT_EQ(layer.runs[2].path.extruder, 0);
  EXPECT_EQ(layer.runs[3].path.extruder, 1);
}

TEST(PrintedLayer, KeepsARunWholeWhereItsRoadsChange) {
  Drawing d = one_nozzle();
  d.type("Perimeter").road({0, 0}, {5, 0});
  d.wall().lay({10, 0});
  const PrintedLayer layer = printed(d);
  ASSERT_EQ(layer.runs.size(), 1u);
  const Path& path = layer.runs[0].path;
  ASSERT_EQ(path.stretches.size(), 2u);
  EXPECT_EQ(path.stretches[1].first_segment, 1u);
  EXPECT_EQ(path.stretches[1].road.role, Role::external_perimeter);
}

TEST(PrintedLayer, LiesWhereThePlasticLiesWhoeverMakesUpForOffsets) {
  for (const OffsetsIn in : {OffsetsIn::slicer, OffsetsIn::firmware}) {
    const PrintedLayer layer = printed(two_boxes(1, in));
    ASSERT_EQ(layer.runs.size(), 6u);
    EXPECT_NEAR(layer.runs[4].path.start().x, 10.2, 1e-4);
    EXPECT_NEAR(layer.runs[4].path.start().y, 0.2, 1e-4);
  }
}

TEST(PrintedLayer, CountsTheWayToEachRun) {
  Drawing d = one_nozzle();
  d.infill().road({0, 0}, {5, 0}).go({5, 3}).go({9, 3}).lay({9, 9});
  const PrintedLayer layer = printed(d);
  ASSERT_EQ(layer.runs.size(), 2u);
  const PrintedRun& run = layer.runs[1];
  ASSERT_EQ(run.begin - run.way_begin, 2u);
  EXPECT_EQ(run.end - run.begin, 1u);
  EXPECT_EQ(layer.drives[run.way_begin].to_mm, (Vec2{5, 3}));
}

TEST(PrintedLayer, TakesOneLayerOutOfMany) {
  const Drawing d = two_boxes(5);
  for (std::uint32_t k = 0; k < 5; ++k) EXPECT_EQ(printed(d, k).runs.size(), 6u) << k;
}

// An inner loop begins at (0.6, 5), goes over into the outer wall at (0.2, 5), which ends inside.
TEST(PrintedLayer, TakesAnOuterWallAndTheLoopInsideItApart) {
  Drawing d = one_nozzle();
  d.type("Perimeter").go({0.6, 5.3}).lay({0.6, 9.4}).lay({9.4, 9.4}).lay({9.4, 0.6}).lay({0.6, 0.6}).lay({0.6, 4.7});
  d.lay({0.2, 5}).wall().lay({0.2, 9.8}).lay({9.8, 9.8}).lay({9.8, 0.2}).lay({0.2, 0.2}).lay({0.2, 5});
  d.type("Perimeter").lay({0.6, 5});
  const PrintedLayer layer = printed(d);
  ASSERT_EQ(layer.runs.size(), 1u);
  const Path& run = layer.runs[0].path;
  const OuterWall wall = outer_wall(run);
  EXPECT_EQ(begin_mm(run, wall), (Vec2{0.2, 5}));
  EXPECT_EQ(end_mm(run, wall), (Vec2{0.2, 5}));
  const Path outer = taken_apart(run);
  EXPECT_TRUE(outer.closed);
  EXPECT_NEAR(length_mm(outer), 4 * 9.6, 1e-3);
  ASSERT_EQ(outer.inner.size(), 1u);
  EXPECT_TRUE(outer.inner[0].closed);
  EXPECT_NEAR(length_mm(outer.inner[0]), 4 * 8.8, 1.2);
  EXPECT_EQ(outer.inner[0].road().role, Role::perimeter);
}

TEST(PrintedLayer, FindsWhereAnOuterWallBeginsThatOverhangsThere) {
  Drawing d = one_nozzle();
  d.type("Perimeter").go({0.6, 5.3}).lay({0.6, 9.4}).lay({9.4, 9.4}).lay({9.4, 0.6});
  d.type("Overhang perimeter").lay({0.6, 0.6}).lay({0.6, 4.7}).lay({0.2, 5}).lay({0.2, 9.8});
  d.wall().lay({9.8, 9.8}).lay({9.8, 0.2}).lay({0.2, 0.2}).lay({0.2, 5});
  const Path run = printed(d).runs.at(0).path;
  EXPECT_EQ(begin_mm(run, outer_wall(run)), (Vec2{0.2, 5}));
  Drawing whole = one_nozzle();
  whole.type("Overhang perimeter").go({0.2, 5}).lay({0.2, 9.8}).wall().lay({9.8, 9.8}).lay({9.8, 0.2}).lay({0.2, 5});
  const Path loop = printed(whole).runs.at(0).path;
  EXPECT_EQ(begin_mm(loop, outer_wall(loop)), (Vec2{0.2, 5}));
}

TEST(PrintedLayer, LeavesRunsThatAreNoLoopsAsTheyAre) {
  Drawing d = one_nozzle();
  d.wall().road({0, 0}, {10, 0}).lay({10, 10});
  const Path run = printed(d).runs.at(0).path;
  const Path same = taken_apart(run);
  EXPECT_FALSE(same.closed);
  EXPECT_EQ(same.points.size(), run.points.size());
}

// What is drawn is counted while it is drawn.
TEST(PrintedLayer, HasAsManyPathsAsThereAreRuns) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto place = [&] { return Vec2{double(random() % 500) / 10, double(random() % 500) / 10}; };
    Drawing d(drawn_machine(two_nozzles, seed % 2 == 0 ? OffsetsIn::slicer : OffsetsIn::firmware), seed % 3 != 0);
    d.layer(0).infill().go(place());
    std::size_t runs = 0;
    double length = 0;
    bool goes_on = false;
    Vec2 at = place();
    d.go(at);
    for (int step = 0; step < 60; ++step) {
      switch (random() % 6) {
        case 0:
          d.go(at = place());
          goes_on = false;
          break;
        case 1:
          d.feed(-0.5).feed(0.5);
          goes_on = false;
          break;
        case 2:
          d.tool(int(random() % 2)).go(at = place());
          goes_on = false;
          break;
        case 3:
          d.type(random() % 2 == 0 ? "External perimeter" : "Skirt/Brim");
          break;
        default: {
          const Vec2 to = place();
          if (to == at) break;
          length += distance(at, to);
          d.lay(at = to);
          runs += !goes_on;
          goes_on = true;
        }
      }
    }
    if (runs == 0) continue;
    const PrintedLayer layer = printed(d);
    EXPECT_EQ(layer.runs.size(), runs);
    double found = 0;
    for (const PrintedRun& run : layer.runs) found += length_mm(run.path);
    EXPECT_NEAR(found, length, 1e-2);
  }
}

}  // namespace
}  // namespace cleancolor
