// How fast layers become G-code: the serial part of the program.  Aim: 3 million lines a second, or 150 MB/s, of
// numbers.

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "base/motion.hpp"
#include "gcode/text.hpp"
#include "gcode/writer.hpp"

using namespace cleancolor;

namespace {

/// Circles whose every point is needed: 0.4 mm segments.
Layer circles(int index, int count, int points) {
  Layer layer{.index = index, .print_z_mm = 0.2 * (index + 1), .height_mm = 0.2, .paths = {}, .fan_by_extruder = {1}};
  for (int k = 0; k < count; ++k) {
    Path p{.extruder = 0, .closed = true, .points = {}, .stretches = {}, .travel = {}};
    p.stretches = {
        {0, {.role = Role::perimeter, .width_mm = 0.4, .height_mm = 0.2, .area_mm2 = 0.08, .speed_mm_s = 60}}};
    const double radius = 0.4 * points / (2 * std::numbers::pi);
    for (int i = 0; i < points; ++i) {
      const double angle = 2 * std::numbers::pi * i / points;
      p.points.push_back({100 + radius * std::cos(angle) + 0.01 * k, 100 + radius * std::sin(angle)});
    }
    layer.paths.push_back(std::move(p));
  }
  return layer;
}

void writer(benchmark::State& state) {
  Config config;
  config.gcode_resolution_mm = 1e-4;
  const Layer layer = circles(0, 100, 200);
  std::uint64_t bytes = 0, lines = 0;
  for (auto _ : state) {
    PrintInfo info;
    info.last_layer = {0};
    GcodeWriter w(config, info, {.write = [&](std::string_view b) { bytes += b.size(); }, .patch = [](auto, auto) {}});
    w.layer(layer);
    benchmark::DoNotOptimize(w.finish());
    lines += 100 * 200;
  }
  state.SetBytesProcessed(std::int64_t(bytes));
  state.SetItemsProcessed(std::int64_t(lines));
}

void formatted_line(benchmark::State& state) {
  std::uint64_t bytes = 0;
  Text text({.write = [&](std::string_view b) { bytes += b.size(); }, .patch = [](auto, auto) {}});
  std::int64_t n = 0;
  for (auto _ : state) {
    char* p = text.room();
    *p++ = 'G', *p++ = '1', *p++ = ' ', *p++ = 'X';
    p = put_fixed<3>(p, 100000 + n % 17777);
    *p++ = ' ', *p++ = 'Y';
    p = put_fixed<3>(p, 90000 + n % 13333);
    *p++ = ' ', *p++ = 'E';
    p = put_fixed<5>(p, 1234 + n % 999);
    *p++ = '\n';
    text.advance_to(p);
    ++n;
  }
  text.flush();
  state.SetBytesProcessed(std::int64_t(bytes));
  state.SetItemsProcessed(n);
}

void motion(benchmark::State& state) {
  double total = 0;
  MotionTimer timer({}, [&](double s) { total += s; });
  std::int64_t n = 0;
  for (auto _ : state) {
    const double angle = 0.03 * double(n++);
    timer.push({{0.4 * std::cos(angle), 0.4 * std::sin(angle), 0, 0.013}, 60});
  }
  benchmark::DoNotOptimize(total);
  state.SetItemsProcessed(n);
}

}  // namespace

BENCHMARK(writer)->Unit(benchmark::kMillisecond);
BENCHMARK(formatted_line);
BENCHMARK(motion);
