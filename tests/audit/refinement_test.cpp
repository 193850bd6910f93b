// Finer steps and finer voxels change the figures by little: they are figures of the print, not of the grid.

#include <gtest/gtest.h>

#include <cmath>

#include "drawn.hpp"

using namespace cleancolor;

namespace {

/// A ring of T0 with waves, standing in the arms of a star of T1; walls of four lines, 8 mm high.
Drawing ring_and_star() {
  Drawing d(drawn_machine({{0, 0}, {33, 0}}));
  constexpr int steps = 180;
  const auto loop = [&](int first, double radius, double wave, double phase, int waves) {
    const auto at = [&](int i) {
      const double t = 2 * std::numbers::pi * (first + i) / steps;
      const double r = radius + wave * std::cos(waves * t + phase);
      return Vec2{100 + r * std::cos(t), 100 + r * std::sin(t)};
    };
    d.go(at(0));
    for (int i = 1; i <= steps; ++i) d.lay(at(i), 30);
    d.feed(-1).go(at(3)).feed(1);
  };
  for (int layer = 0; layer < 40; ++layer) {
    const double swell = 2 * std::sin(layer / 8.0);
    d.layer(layer).tool(0).type("Perimeter");
    for (const double in : {1.2, 0.8, 0.4, 0.0}) {
      if (in == 0) d.wall();
      loop(0, 12 + swell - in, 1.5, 0.1 * layer, 5);
    }
    d.tool(1).type("Perimeter");
    for (const double out : {0.4, 0.8, 1.2, 1.6}) {
      if (out == 1.6) d.wall();
      loop(steps / 2, 18 + swell + out, 3, 0, 7);  // begun on the left, so the tip of T1 crosses the ring on its way
    }
  }
  return d;
}

void expect_close(const Figures& a, const Figures& b, double share) {
  for (const char* name : {"smear_volume", "hole_volume", "inner_volume", "smear_exposure_travel",
                           "smear_exposure_print", "zippers_visible"}) {
    const FigureInfo& f = *find_figure(name);
    EXPECT_GT(f.of(a), 0) << name;
    EXPECT_NEAR(f.of(b), f.of(a), share * f.of(a)) << name;
  }
}

}  // namespace

TEST(Refinement, HalvedStepsChangeLittle) {
  const Drawing d = ring_and_star();
  AuditOptions fine = only_worst();
  fine.step_mm /= 2;
  expect_close(worst(d), worst(d, fine), 0.005);
}

// Rings and arms are a few voxels apart here; on real prints the change is less than half as large.
TEST(Refinement, HalvedVoxelsChangeLittle) {
  const Drawing d = ring_and_star();
  AuditOptions fine = only_worst();
  fine.visibility.voxel_mm /= 2;
  expect_close(worst(d), worst(d, fine), 0.09);
}

TEST(Refinement, HalvedSegmentsChangeLittle) {
  // The same roads, each given as two.
  const Drawing d = ring_and_star();
  GcodePrint print = d.print();
  std::vector<GcodeMove> moves;
  std::vector<std::uint32_t> now(print.moves.size() + 1);
  for (std::size_t i = 0; i < print.moves.size(); ++i) {
    GcodeMove m = print.moves[i];
    now[i] = std::uint32_t(moves.size());
    if (i > 0 && m.known_start && m.filament_mm > 0 && m.width_mm > 0) {
      GcodeMove half = m;
      half.to_mm = (print.moves[i - 1].to_mm + m.to_mm) * 0.5;
      half.filament_mm = m.filament_mm /= 2;
      moves.push_back(half);
    }
    moves.push_back(m);
  }
  for (GcodeEvent& e : print.events) e.before_move = now[e.before_move];
  print.moves = std::move(moves);
  expect_close(worst(d), audit(print, d.machine(), only_worst()).scenarios[0].total, 0.02);
}
