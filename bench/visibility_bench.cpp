// Geometry of an audit.  Aim: 0.35 s of CPU for the visibility of a dragon, 90 x 95 x 50 mm with 200 000 roads, and
// 0.1 s for the outlines of its layers.

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "audit/exposed.hpp"
#include "audit/visibility.hpp"

using namespace cleancolor;

namespace {

constexpr double layer_mm = 0.2, width_mm = 0.4;

/// A ball of 50 mm with two walls in chords of 1 mm and sparse lines inside.
std::vector<LabelledRoad> ball_layer(int i) {
  constexpr double radius = 25;
  const double z = layer_mm * (i + 0.5) - radius;
  const double r = std::sqrt(std::max(0.01, radius * radius - z * z));
  std::vector<LabelledRoad> roads;
  for (const Role role : {Role::external_perimeter, Role::perimeter}) {
    const double wall = r - width_mm * (role == Role::perimeter ? 1.5 : 0.5);
    const int chords = std::max(8, int(2 * std::numbers::pi * wall));
    const auto point = [&](int k) {
      const double angle = 2 * std::numbers::pi * k / chords;
      return Vec2{wall * std::cos(angle), wall * std::sin(angle)};
    };
    for (int k = 0; k < chords; ++k) roads.push_back({point(k), point(k + 1), float(width_mm), 0.08f, role});
  }
  const double inside = r - 2 * width_mm;
  for (double y = -inside + 0.1; y < inside; y += 2) {
    const double x = std::sqrt(inside * inside - y * y);
    roads.push_back({{-x, y}, {x, y}, float(width_mm), 0.08f, Role::internal_infill});
  }
  return roads;
}

constexpr int ball_layers = 250;

void visibility_of_a_ball(benchmark::State& state) {
  const auto layer = [](int i) {
    PartLayer l{.bottom_mm = layer_mm * i, .top_mm = layer_mm * (i + 1), .roads = {}};
    for (const LabelledRoad& r : ball_layer(i)) l.roads.push_back({r.a_mm, r.b_mm, r.width_mm, 0});
    return l;
  };
  for (auto _ : state) {
    const PrintedVisibility v(ball_layers, layer, {}, 1);
    benchmark::DoNotOptimize(v.at({0, 0, 50}));
  }
}

void visibility_looked_up(benchmark::State& state) {
  const auto layer = [](int i) {
    PartLayer l{.bottom_mm = layer_mm * i, .top_mm = layer_mm * (i + 1), .roads = {}};
    for (const LabelledRoad& r : ball_layer(i)) l.roads.push_back({r.a_mm, r.b_mm, r.width_mm, 0});
    return l;
  };
  const PrintedVisibility v(ball_layers, layer, {}, 1);
  double angle = 0;
  for (auto _ : state) {
    angle += 0.1;
    benchmark::DoNotOptimize(v.at({24.8 * std::cos(angle), 24.8 * std::sin(angle), 25}));
  }
}

void outlines_of_a_ball(benchmark::State& state) {
  for (auto _ : state) {
    PartOutline above;
    for (int i = ball_layers; i-- > 0;) {
      const auto roads = ball_layer(i);
      PartOutline outline(roads);
      benchmark::DoNotOptimize(exposures(roads, outline, above));
      above = std::move(outline);
    }
  }
}

}  // namespace

BENCHMARK(visibility_of_a_ball)->Unit(benchmark::kMillisecond);
BENCHMARK(visibility_looked_up)->Unit(benchmark::kNanosecond);
BENCHMARK(outlines_of_a_ball)->Unit(benchmark::kMillisecond);
