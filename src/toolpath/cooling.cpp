#include "toolpath/cooling.hpp"

#include <algorithm>

namespace cleancolor {
namespace {

bool may_slow(const Road& road) {
  return road.role != Role::bridge_infill && road.role != Role::overhang_perimeter;
}

/// Seconds of printing, split into what may be slowed down and what may not (bridges, travel).
struct LayerTime {
  double elastic_s = 0;
  double fixed_s = 0;
  double total_s() const { return elastic_s + fixed_s; }
};

template <class Visit>  // (road, length_mm) of every stretch
void for_each_stretch(Path& path, Visit visit) {
  const std::size_t n = path.points.size();
  for (std::size_t s = 0; s < path.stretches.size(); ++s) {
    const std::size_t last = s + 1 < path.stretches.size() ? path.stretches[s + 1].first_segment : path.segments();
    double length = 0;
    for (std::size_t i = path.stretches[s].first_segment; i < last; ++i)
      length += distance(path.points[i], path.points[(i + 1) % n]);
    visit(path.stretches[s].road, length);
  }
}

LayerTime layer_time(Layer& layer, const Config& config) {
  LayerTime time;
  const Path* before = nullptr;
  for (Path& path : layer.paths) {
    if (before) time.fixed_s += travel_mm(before->end(), path) / config.travel_speed_mm_s;
    before = &path;
    for_each_stretch(path, [&](const Road& road, double length) {
      (may_slow(road) ? time.elastic_s : time.fixed_s) += length / road.speed_mm_s;
    });
  }
  return time;
}

double fan(const Extruder& extruder, int layer_index, double layer_s) {
  if (layer_index < extruder.disable_fan_first_layers) return 0;
  const double least = extruder.min_fan_speed_percent / 100.0, most = extruder.max_fan_speed_percent / 100.0;
  const double always = extruder.fan_always_on ? least : 0;
  if (!extruder.cooling) return always;
  if (layer_s < extruder.slowdown_below_layer_time_s) return most;
  if (layer_s >= extruder.fan_below_layer_time_s) return always;
  const double range = extruder.fan_below_layer_time_s - extruder.slowdown_below_layer_time_s;
  return most + (least - most) * (layer_s - extruder.slowdown_below_layer_time_s) / range;
}

}  // namespace

void cool(Layer& layer, const Config& config) {
  const LayerTime time = layer_time(layer, config);
  double wanted_s = 0;
  for (const Path& path : layer.paths) {
    const Extruder& e = config.extruders[std::size_t(path.extruder)];
    if (e.cooling) wanted_s = std::max(wanted_s, e.slowdown_below_layer_time_s);
  }
  if (time.total_s() < wanted_s && time.elastic_s > 0) {
    const double factor = time.elastic_s / std::max(wanted_s - time.fixed_s, time.elastic_s);
    for (Path& path : layer.paths)
      for_each_stretch(path, [&](Road& road, double) {
        const double least = config.extruders[std::size_t(path.extruder)].min_print_speed_mm_s;
        if (may_slow(road)) road.speed_mm_s = std::max(road.speed_mm_s * factor, std::min(road.speed_mm_s, least));
      });
  }
  layer.fan_by_extruder.clear();
  for (const Extruder& e : config.extruders) layer.fan_by_extruder.push_back(fan(e, layer.index, time.total_s()));
}

}  // namespace cleancolor
