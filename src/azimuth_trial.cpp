#include "azimuth_trial.hpp"

#include <algorithm>
#include <numbers>

#include "base/parallel.hpp"
#include "plan/planner.hpp"
#include "toolpath/toolpaths.hpp"

namespace cleancolor {
namespace {

constexpr double worth_a_turn = 0.125;
constexpr double endless_mm = 5000;
constexpr double most_of_a_layer_mm3 = 0.06;  // more is one unlucky hop, and says nothing of the other layers

/// What is planned in a trial: no skins, so that a layer needs no others, on a bed without end.
Config trial_config(Config config) {
  config.top_solid_layers = config.bottom_solid_layers = 0;
  config.bed_shape_mm = {
      {-endless_mm, -endless_mm}, {endless_mm, -endless_mm}, {endless_mm, endless_mm}, {-endless_mm, endless_mm}};
  for (Extruder& e : config.extruders) e.extruder_printable_area_mm.clear();
  config.effort = Effort::fast;
  config.refill_mode = RefillMode::off;
  if (config.seam_position == SeamPosition::aligned) config.seam_position = SeamPosition::hidden;
  return config;
}

/// Evenly spread, the first aside.
std::vector<int> sample(int layers, int count) {
  std::vector<int> result;
  count = std::min(count, layers - 1);
  for (int i = 0; i < count; ++i) result.push_back(1 + int((i + 0.5) * (layers - 1) / count));
  return result;
}

std::vector<Path> part_paths(const Slices& slices, int layer, const Config& config) {
  std::vector<LayerShells> shells(slices.slabs.size());
  shells[std::size_t(layer)] = layer_shells(slices, layer, config);
  const LayerAreas areas = layer_areas(shells, layer, config);
  return layer_paths(slices, shells[std::size_t(layer)], nullptr, areas, layer, config);
}

class Trial {
 public:
  Trial(const Slices& slices, const Use& use, const Config& config, const TrialOptions& options)
      : slices_(slices),
        use_(use),
        config_(trial_config(config)),
        threads_(options.threads),
        layers_(sample(int(slices.slabs.size()), 2 * options.layers / std::max(2, int(use.extruders.size())))),
        rampart_(slices, use, config_, options.threads, layers_),
        paths_(layers_.size()) {
    std::vector<double> height_mm;
    for (const Slab& slab : slices.slabs) height_mm.push_back(slab.height_mm);
    visibility_.emplace(slices.outlines, height_mm, SurfaceVisibilityOptions{.threads = options.threads});
    for (const Extruder& e : config.extruders) offset_mm_.push_back(e.nozzle_offset_mm);
    first_ = first_extruders(printing_by_layer(slices), use.extruders.front());
    each([&](std::size_t i) { paths_[i] = part_paths(slices_, layers_[i], config_); });
  }

  AzimuthTrial at(int turned_by_deg) {
    // The rampart reads the offsets from the same config.
    for (std::size_t e = 0; e < offset_mm_.size(); ++e)
      config_.extruders[e].nozzle_offset_mm = turned(offset_mm_[e], -turned_by_deg * std::numbers::pi / 180);
    std::vector<LayerForecast> forecasts(layers_.size());
    each([&](std::size_t i) { forecasts[i] = forecast(i); });
    AzimuthTrial trial{.turned_by_deg = turned_by_deg};
    for (const LayerForecast& f : forecasts) {
      trial.smear_mm3 += std::min(f.smear_mm3, most_of_a_layer_mm3);
      trial.hole_mm3 += f.hole_mm3;
    }
    const double share = double(slices_.slabs.size()) / double(std::max<std::size_t>(layers_.size(), 1));
    trial.smear_mm3 *= share;
    trial.hole_mm3 *= share;
    return trial;
  }

 private:
  void each(const std::function<void(std::size_t)>& body) const {
    parallel_for(int(layers_.size()), threads_, [&](int i) { body(std::size_t(i)); });
  }

  LayerForecast forecast(std::size_t i) const {
    const int k = layers_[i];
    const Slab& slab = slices_.slabs[std::size_t(k)];
    Layer layer{
        .index = k, .print_z_mm = slab.print_z_mm, .height_mm = slab.height_mm, .paths = {}, .fan_by_extruder = {}};
    layer.paths = rampart_.paths(k);
    layer.paths.insert(layer.paths.end(), paths_[i].begin(), paths_[i].end());
    OrderState state{.extruder = first_[std::size_t(k)], .at = {}, .seams = {}};
    return PlannedLayer(std::move(layer), state, config_, plan_scene(slices_, use_, config_, rampart_, k), *visibility_)
        .forecast();
  }

  const Slices& slices_;
  const Use& use_;
  Config config_;
  int threads_;
  std::vector<int> layers_;
  PrintedRampart rampart_;
  std::vector<std::vector<Path>> paths_;
  std::optional<SurfaceVisibility> visibility_;
  std::vector<Vec2> offset_mm_;
  std::vector<int> first_;
};

}  // namespace

std::vector<AzimuthTrial> azimuth_trials(const Slices& slices, const Use& use, const Config& config,
                                         std::span<const int> turned_by_deg, const TrialOptions& options) {
  Trial trial(slices, use, config, options);
  std::vector<AzimuthTrial> result;
  for (const int deg : turned_by_deg) result.push_back(trial.at(deg));
  return result;
}

int cleanest(std::span<const AzimuthTrial> trials) {
  const auto cost = [&](const AzimuthTrial& t) { return t.smear_mm3 + t.hole_mm3; };
  const AzimuthTrial& best = *std::ranges::min_element(trials, {}, cost);
  const auto untouched = std::ranges::find(trials, 0, &AzimuthTrial::turned_by_deg);
  if (untouched != trials.end() && cost(*untouched) * (1 - worth_a_turn) <= cost(best)) return 0;
  return best.turned_by_deg;
}

}  // namespace cleancolor
