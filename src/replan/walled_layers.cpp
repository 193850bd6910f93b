#include "replan/walled_layers.hpp"

#include <algorithm>

namespace cleancolor {
namespace {

constexpr double drained = 5;  // times the ooze model's time

bool prints_alone(const Layer& layer, int extruder) {
  return std::ranges::all_of(layer.paths, [&](const Path& path) { return path.extruder == extruder; });
}

}  // namespace

int walled_layers(std::span<const Layer> layers, const OozeModel& ooze) {
  int extruder = -1;
  for (const Layer& layer : layers)
    if (!layer.paths.empty()) extruder = layer.paths.back().extruder;
  std::size_t count = layers.size();
  while (count > 0 && prints_alone(layers[count - 1], extruder)) --count;
  for (double seconds = 0; count < layers.size() && seconds < drained * ooze.time_s; ++count)
    for (const Path& path : layers[count].paths) seconds += seconds_of(path);
  return int(count);
}

}  // namespace cleancolor
