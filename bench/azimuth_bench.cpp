// How fast both curves of the azimuth are found, all 360 angles, on two threads. Aim: below 0.5 s for every model.

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "model/check.hpp"
#include "model/placement.hpp"
#include "model/read.hpp"
#include "orient/azimuth.hpp"

using namespace cleancolor;

namespace {

/// The layers of a pair of ../shared/models/paper; empty where it is absent.
Slices layers_of(const std::string& name, const char* first, const char* second) {
  const char* shared = std::getenv("CLEANCOLOR_SHARED");
  const std::filesystem::path folder = std::filesystem::path(shared ? shared : "../shared") / "models" / "paper";
  std::vector<Part> parts;
  for (const char* colour : {first, second}) {
    const auto file = folder / (name + "_" + colour + ".stl");
    if (!std::filesystem::exists(file)) return {};
    for (Part& part : read_model(file)) {
      part.mesh = checked(std::move(part.mesh), part.name);
      part.extruder = int(parts.size());
      parts.push_back(std::move(part));
    }
  }
  Config config;
  config.extruders.resize(2);
  place(parts, config, {});
  return slices(parts, {.extruders = 2, .threads = 2});
}

void curves(benchmark::State& state, const char* name, const char* first, const char* second) {
  const Slices layers = layers_of(name, first, second);
  if (layers.slabs.empty()) return state.SkipWithError("needs ../shared/models, or CLEANCOLOR_SHARED");
  AzimuthOptions options{.nozzle_offset_mm = {{0, 0}, {33, 0}}, .pace = {{}, {}}, .fits = {}, .threads = 2};
  for (auto _ : state) benchmark::DoNotOptimize(azimuths(layers, options));
}

BENCHMARK_CAPTURE(curves, cones, "4-cones", "white", "black")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(curves, crystal, "crystal", "white", "black")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(curves, dragon, "dragon-heart", "body", "accent")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(curves, robot, "robot-ice", "robot", "crust")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(curves, rose, "rose", "petals", "green")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(curves, cow, "spot-cow", "light", "dark")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(curves, world, "two-color-world-50mm", "ocean", "land")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
