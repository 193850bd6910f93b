#include "replan/staged_layer.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace cleancolor {

std::vector<Layer> stages_of(Layer layer, const std::vector<Stop>& stops) {
  std::vector<Path> paths = std::exchange(layer.paths, {});
  std::vector<Layer> stages;
  bool begins = true;
  for (Path& path : paths) {
    const bool stops_here = std::ranges::find(stops, path.source, &Stop::source) != stops.end();
    if (begins || stops_here) stages.push_back(layer);
    stages.back().paths.push_back(std::move(path));
    begins = stops_here;
  }
  return stages;
}

StagedLayer::StagedLayer(Layer layer, int first, const std::vector<Stop>& stops, const Config& config,
                         const PlanScene& scene, const SurfaceVisibility& visibility)
    : stops_(stops) {
  for (Layer& stage : stages_of(std::move(layer), stops)) {
    OrderState state{.extruder = stages_.empty() ? first : stage.paths.front().extruder, .at = {}, .seams = {}};
    stages_.emplace_back(std::move(stage), state, config, scene, visibility);
  }
}

void StagedLayer::arrive_from(const Path& below) {
  Layer before;
  before.paths.push_back(below);
  for (PlannedLayer& stage : stages_) {
    if (!before.paths.front().points.empty()) stage.arrive_from(before);
    before.paths.front() = stage.layer().paths.back();
    const auto stop = std::ranges::find(stops_, before.paths.front().source, &Stop::source);
    if (stop != stops_.end()) before.paths.front() = stop->leaving;
  }
  last_ = std::move(before.paths.front());
}

Layer StagedLayer::release() && {
  Layer all;
  for (PlannedLayer& stage : stages_) {
    Layer layer = std::move(stage).release();
    if (all.paths.empty()) {
      all = std::move(layer);
    } else {
      std::ranges::move(layer.paths, std::back_inserter(all.paths));
    }
  }
  return all;
}

}  // namespace cleancolor
