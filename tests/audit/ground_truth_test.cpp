// Small prints whose figures can be counted by hand. Everything is 0.4 mm wide; T1 hangs 10 mm to the right of T0.
//
//        W          S            W: wall of T0, x = 20, y = 0 ... 10, takes 1 s
//        |          |            A: wall of T0, y = 5, x = 5 ... 14, takes 0.9 s; meanwhile the tip of T1 goes
//   A--- |  (T1)    |               from x = 15 to 24, and over W from x = 19.8 to 20.2
//        |          |            S: skirt at x = 25, y = 0 ... 10
//                                C: wall of T1, x = 60, y = 0 ... 5, out of everybody's way

#include <gtest/gtest.h>

#include "drawn.hpp"

using namespace cleancolor;

namespace {

const std::vector<Vec2> two_nozzles{{0, 0}, {10, 0}};

/// W; then straight to A: the tip of T1 goes from (30, 10) to (15, 5), over W where it is at x = 20.
const double straight_mm = std::hypot(15, 5), straight_s = straight_mm / travelling_mm_s;
const double straight_chord_mm = 0.4 * straight_mm / 15;

Drawing& wall_w(Drawing& d) {
  return d.wall().road({20, 0}, {20, 10});
}
Drawing& wall_a(Drawing& d) {
  return d.wall().road({5, 5}, {14, 5});
}
/// From W's end to A's begin where the tip of T1 meets nothing: 24 mm.
Drawing& around(Drawing& d) {
  return d.go({20, 12}).go({5, 12}).go({5, 5});
}
Drawing& wall_c(Drawing& d, bool quiet = false) {
  return d.tool(1, quiet).wall().road({60, 0}, {60, 5});
}

Drawing started(const AuditMachine& machine = drawn_machine(two_nozzles), bool relative_e = true) {
  Drawing d(machine, relative_e);
  d.layer(0).tool(0);
  return d;
}

/// W, straight to A, C.
Drawing straight_print(const AuditMachine& machine = drawn_machine(two_nozzles), bool relative_e = true,
                       bool quiet = false) {
  Drawing d = started(machine, relative_e);
  wall_w(d);
  wall_a(d);
  wall_c(d, quiet);
  return d;
}

double left_mm3(const Figures& f) {
  return f.smear_volume() + f.inner_volume();
}

void expect_same(const Figures& a, const Figures& b, double tolerance = 1e-3) {
  for (const FigureInfo& info : figure_table())
    EXPECT_NEAR(info.of(a), info.of(b), tolerance * (1 + std::abs(info.of(a)))) << info.name;
}

}  // namespace

TEST(GroundTruth, AHoveringNozzleCrossesAWallOverItsWidth) {
  Drawing d = started();
  around(wall_w(d));
  wall_a(d);
  wall_c(d);
  const AuditResult result = audited(d);
  const Figures& f = result.scenarios[0].total;
  EXPECT_NEAR(f.smear_exposure_print, 0.4, 0.001);
  EXPECT_EQ(f.smear_exposure_travel, 0);
  EXPECT_EQ(f.inner_exposure_print, 0);
  // T1 leaves all that flowed out until it is beyond W: after 1 s of W, 24 mm of travel and 5.2 mm of A.
  const double left = oozed_mm3(1 + 0.24 + 0.52);
  EXPECT_NEAR(left_mm3(f), left, 0.01 * left);
  // What is not visible of it is inner.
  const double v = result.visibility->at({20, 5, 0.2});
  EXPECT_NEAR(f.smear_volume_print, left * v, 0.02 * left);
  EXPECT_EQ(f.smear_volume_travel, 0);
  EXPECT_EQ(f.wipes, 0);
}

TEST(GroundTruth, ATravelThatCrossesAWallLeavesTheFirstPart) {
  const Figures f = worst(straight_print());
  EXPECT_NEAR(f.smear_exposure_travel, straight_chord_mm, 0.001);
  EXPECT_NEAR(f.smear_exposure_print, 0.4, 0.001);
  // Beyond W (x = 19.8) after 10.2 of 15 mm along X; the rest on the way along A.
  const double first = oozed_mm3(1 + straight_s * 10.2 / 15), all = oozed_mm3(1 + straight_s + 0.52);
  EXPECT_NEAR(f.smear_volume_travel + f.inner_volume_travel, first, 0.01 * first);
  EXPECT_NEAR(f.smear_volume_print + f.inner_volume_print, all - first, 0.01 * (all - first));
  EXPECT_EQ(f.tool_changes, 1);
}

TEST(GroundTruth, ASkirtOnTheWayTakesTheOozeFirst) {
  Drawing d = started();
  d.skirt().road({25, 0}, {25, 10});
  wall_w(d);
  wall_a(d).go({14, -12});  // so that no tip meets S on its way to C
  wall_c(d);
  const Figures f = worst(d);
  // S 1 s, 11.18 mm to W, W 1 s, then straight: off S at x = 24.8.
  const double w_ends = 1 + std::hypot(5, 10) / travelling_mm_s + 1;
  const double wiped = oozed_mm3(w_ends + straight_s * 5.2 / 15);
  EXPECT_EQ(f.wipes, 1);
  EXPECT_NEAR(f.wiped_volume, wiped, 0.01 * wiped);
  const double left = oozed_mm3(w_ends + straight_s + 0.52) - wiped;
  EXPECT_NEAR(left_mm3(f), left, 0.01 * left);
}

TEST(GroundTruth, ASkirtPrintedLaterWipesNothing) {
  Drawing d = started();
  wall_w(d);
  wall_a(d);
  d.skirt().road({25, 0}, {25, 10});
  wall_c(d);
  const Figures f = worst(d);
  EXPECT_EQ(f.wipes, 0);
  EXPECT_NEAR(f.smear_exposure_travel, straight_chord_mm, 0.001);
}

TEST(GroundTruth, ASkirtOfTheLayerBelowWipesNothing) {
  Drawing d = started();
  d.skirt().road({25, 0}, {25, 10}).layer(1);
  wall_w(d);
  wall_a(d);
  wall_c(d);
  EXPECT_EQ(worst(d).wipes, 0);
}

TEST(GroundTruth, ASkirtInsideThePartIsPart) {
  // The label cannot hide that it lies on W.
  Drawing d = started();
  d.skirt().road({20, 4}, {20, 8});
  wall_w(d);
  wall_a(d);
  wall_c(d);
  const Figures f = worst(d);
  EXPECT_EQ(f.wipes, 0);
  EXPECT_NEAR(f.smear_exposure_travel, straight_chord_mm, 0.001);
}

TEST(GroundTruth, CrossingTwoSkirtsInContactIsOneWipe) {
  Drawing d = started();
  d.skirt().road({25.4, 0}, {25.4, 10}).road({25, 0}, {25, 10});
  wall_w(d);
  wall_a(d).go({14, -12});
  wall_c(d);
  EXPECT_EQ(worst(d).wipes, 1);
}

// T0 prints for 2 s and waits 10 s; T1, at the same place all the time, then goes 60 mm to C2 and prints 40 mm: 2.86
// mm3, more than it can lack. All that is missing is missing at the begin of C2.
TEST(GroundTruth, WhatAnIdleNozzleLacksIsMissingAtTheBeginOfItsWall) {
  Drawing d = started();
  d.wall().road({20, 0}, {20, 20}).dwell(10).go({-30, 20}).tool(1).road({40, 20}, {40, 60});
  // From T0 at (-30, 20), which is T1 at (-20, 20), to (40, 20): 60 mm; and 50 mm before.
  const double missing = oozed_mm3(2 + 10 + 0.5 + 0.6);
  const AuditResult result = audited(d);
  const double share = missing / (40 * drawn_area_mm2);
  const double v = result.visibility->at({40, 20 + 40 * share / 2, 0.2});
  EXPECT_GT(v, 0.3);
  EXPECT_NEAR(result.scenarios[0].total.hole_volume, missing * v, 0.01 * missing * v);
}

TEST(GroundTruth, AWallThatIsTooShortToMakeUpAllLeavesARestToTheNext) {
  Drawing d = started();
  d.wall().road({20, 0}, {20, 20}).dwell(100).go({-30, 20}).tool(1).road({40, 20}, {40, 22});
  const AuditResult result = audited(d);
  const double pushed = 2 * drawn_area_mm2;  // 0.14 mm3, all of it missing
  EXPECT_NEAR(result.scenarios[0].total.hole_volume, pushed * result.visibility->at({40, 21, 0.2}), 0.01 * pushed);
}

TEST(GroundTruth, SkirtRefillAndPurgeBeforeTheWallLeaveNoHole) {
  const auto hole = [](const std::function<void(Drawing&)>& before) {
    Drawing d = started();
    d.wall().road({20, 0}, {20, 20}).dwell(10).go({-30, 20}).tool(1);
    before(d);
    d.wall().lay({40, 60});
    return worst(d).hole_volume;
  };
  EXPECT_GT(hole([](Drawing& d) { d.go({40, 20}); }), 0.2);
  EXPECT_LT(hole([](Drawing& d) { d.go({40, -40}).skirt().lay({40, 20}); }), 1e-6);
  // 1 mm of filament pushed in place is 2.4 mm3.
  EXPECT_LT(hole([](Drawing& d) { d.go({40, 20}).feed(1); }), 1e-6);
  // Drawn back and given back makes up nothing.
  EXPECT_GT(hole([](Drawing& d) { d.go({40, 20}).feed(-1).feed(1); }), 0.2);
}

TEST(GroundTruth, InfillOfABoxBeforeItsWallLeavesNoHole) {
  // T1 prints the diagonal of a box, more than it lacks, and at once its wall: nothing is missing any more.
  Drawing d = started();
  d.wall().road({20, 0}, {20, 20}).dwell(10).tool(1).infill().go({51, 1}).lay({79, 29}).wall();
  d.lay({80, 30}).lay({50, 30}).lay({50, 0}).lay({80, 0}).lay({80, 30});
  EXPECT_LT(worst(d).hole_volume, 1e-6);
}

TEST(GroundTruth, ZippersAreBeginsAndEndsOfWalls) {
  Drawing loop = started();
  loop.wall().go({0, 0}).lay({10, 0}).lay({10, 10}).lay({0, 10}).lay({0, 0});
  EXPECT_EQ(worst(loop).zippers, 2);

  Drawing retracted = started();
  retracted.wall().go({0, 0}).lay({10, 0}).feed(-1).feed(1).lay({10, 10}).lay({0, 10}).lay({0, 0});
  EXPECT_EQ(worst(retracted).zippers, 4);

  Drawing jumped = started();
  jumped.wall().go({0, 0}).lay({10, 0}).lay({10, 10}).go({5, 10}).lay({0, 10}).lay({0, 0});
  EXPECT_EQ(worst(jumped).zippers, 4);

  // Begun inside: infill runs into the wall without a stop.
  Drawing inside = started();
  inside.infill().go({5, 5}).lay({0, 0}).wall().lay({10, 0}).lay({10, 10}).lay({0, 10}).lay({0, 0});
  EXPECT_EQ(worst(inside).zippers, 1);

  Drawing skirt = started();
  skirt.skirt().go({0, 0}).lay({10, 0}).lay({10, 10}).wall().go({30, 0}).lay({40, 0});
  EXPECT_EQ(worst(skirt).zippers, 2);
}

TEST(GroundTruth, OffsetsInSlicerAndInFirmwareGiveTheSame) {
  const Figures slicer = worst(straight_print());
  // Not Marlin, or T1 S1: the carriage stays at the change.
  expect_same(slicer, worst(straight_print(drawn_machine(two_nozzles, OffsetsIn::firmware))));
  Drawing quiet = straight_print(drawn_machine(two_nozzles, OffsetsIn::firmware), true, true);
  expect_same(slicer, worst(quiet.marlin()));
}

// Bare T1: Marlin drives the tip of T1 from (24, 5) to (14, 5), where T0 was. On the way it crosses W (0.4 mm), and the
// last 0.2 mm are the round end of A. From there to C, (60, 0), it leaves A again (0.2 mm) and crosses W once more.
TEST(GroundTruth, OnMarlinABareToolChangeAddsAJump) {
  Drawing bare = straight_print(drawn_machine(two_nozzles, OffsetsIn::firmware));
  const Figures f = worst(bare.marlin());
  const double back_mm = 0.4 * std::hypot(46, 5) / 46;
  EXPECT_NEAR(f.smear_exposure_travel, straight_chord_mm + 0.4 + 0.2 + 0.2 + back_mm, 0.002);
  EXPECT_NEAR(f.smear_exposure_print, 0.4, 0.001);
}

TEST(GroundTruth, RelativeAndAbsoluteEGiveTheSame) {
  expect_same(worst(straight_print(drawn_machine(two_nozzles), true)),
              worst(straight_print(drawn_machine(two_nozzles), false)));
}

TEST(GroundTruth, NozzlesThatAreLiftedOrParkedTouchNothingWhileIdle) {
  for (const IdleNozzle idle : {IdleNozzle::lifted, IdleNozzle::parked, IdleNozzle::docked}) {
    AuditMachine machine = drawn_machine(two_nozzles);
    machine.idle_nozzle = idle;
    // T1 itself then travels over W, from (60, 5) to (0, 5).
    Drawing d = straight_print(machine);
    d.go({0, 5}).lay({0, 9});
    const Figures f = worst(d);
    EXPECT_EQ(f.smear_exposure_print, 0);
    // Over W, and along A: x = 14.2 ... 4.8.
    EXPECT_NEAR(f.smear_exposure_travel, 0.4 + 9.4, 0.002);
    // Nothing was left before: it prints C with what it carries, and oozes anew.
    EXPECT_NEAR(left_mm3(f), oozed_mm3(0.552), 0.01 * oozed_mm3(0.552));
  }
}

// T2 hangs 11 mm behind T0. While T0 prints A, T1 crosses W of T0, and T2, at y = 16, crosses W2 of T1 (x = 10).
TEST(GroundTruth, EveryIdleNozzleOfThreeCounts) {
  Drawing d = started(drawn_machine({{0, 0}, {10, 0}, {0, 11}}));
  around(wall_w(d));
  wall_a(d);
  d.tool(1).road({10, 13}, {10, 17}).tool(2).road({60, 0}, {60, 5});
  const AuditResult result = audited(d);
  ASSERT_EQ(result.scenarios[0].pairs.size(), 6u);
  for (const PairFigures& p : result.scenarios[0].pairs) {
    SCOPED_TRACE(p.nozzle * 10 + p.over);
    const bool crosses = (p.nozzle == 1 && p.over == 0) || (p.nozzle == 2 && p.over == 1);
    EXPECT_NEAR(p.figures.smear_exposure_print, crosses ? 0.4 : 0, 0.001);
  }
  EXPECT_EQ(result.tool_changes, 2);
}

TEST(GroundTruth, ExposureIsTheSameBackwards) {
  Drawing d = started();
  d.tool(1).wall().road({60, 5}, {60, 0}).tool(0).road({14, 5}, {5, 5}).road({20, 10}, {20, 0});
  const Figures forwards = worst(straight_print()), backwards = worst(d);
  EXPECT_NEAR(forwards.smear_exposure_print, backwards.smear_exposure_print, 0.001);
  EXPECT_NEAR(forwards.smear_exposure_travel, backwards.smear_exposure_travel, 0.001);
  EXPECT_NEAR(forwards.smear_exposure_print_visible, backwards.smear_exposure_print_visible, 0.01);
}

TEST(GroundTruth, AWayAlongAWallCountsInFull) {
  // The way of T1 along W, 8 mm, while T0 prints: T0 is 10 mm to the left.
  Drawing d = started();
  wall_w(d);
  d.go({30, 10}).go({30, 20}).go({10, 20}).go({10, 12}).go({10, 9}).lay({10, 1});
  wall_c(d);
  const Figures f = worst(d);
  EXPECT_NEAR(f.smear_exposure_print, 8, 0.001);
  // On the way there from y = 10.2 to 9; back to C from (20, 1): 0.2 mm aside, longer by 41.2 / 40.
  EXPECT_NEAR(f.smear_exposure_travel, 1.2 + 0.2 * std::hypot(40, 1) / 40, 0.002);
}

TEST(GroundTruth, OnePlasticCannotSmear) {
  Drawing d = started();
  wall_w(d);
  wall_a(d);
  d.go({20, 5}).go({5, 5}).layer(1);
  wall_w(d);
  const Figures f = worst(d);
  EXPECT_EQ(f.smear_volume(), 0);
  EXPECT_EQ(f.inner_volume(), 0);
  EXPECT_EQ(f.smear_exposure_travel + f.smear_exposure_print, 0);
  EXPECT_GT(f.own_volume, 0);
}

// A solid box of T0, 40 x 40 x 2 mm; T1 hangs far beside it. When its 2 mm3 have flowed out, T1 comes from above into
// the middle of the fifth layer, passes over 16 mm of its inside, and leaves over the wall.
TEST(GroundTruth, WhatIsHiddenInsideTakesInnerVolume) {
  Drawing d = started(drawn_machine({{0, 0}, {100, 0}}));
  for (int layer = 0; layer < 10; ++layer) {
    d.layer(layer).wall().go({0, 0}).lay({40, 0}).lay({40, 40}).lay({0, 40}).lay({0, 0}).infill();
    for (int i = 1; i < 100; ++i) {
      const double from = i % 2 ? 0.4 : 39.6;
      d.road({from, 0.4 * i}, {40 - from, 0.4 * i});
    }
  }
  d.line("G28 X Y").line("G1 Z1 F60000").tool(1).go({12, 20}).go({28, 20}).go({60, 20}).wall().lay({60, 25});
  const Figures f = worst(d);
  // And on from x = 28 to the visible wall.
  EXPECT_NEAR(f.inner_exposure_travel, 39.8 - 12, 0.01);
  EXPECT_NEAR(f.smear_exposure_travel, 0.4, 0.01);
  EXPECT_NEAR(f.inner_volume(), 2, 0.01);
  EXPECT_LT(f.smear_volume(), 0.001);
}
