// replan/staged_layer.hpp
//
// Staged layer: a layer with stops that stay in their place: what the file does there is neither moved nor changed.
//
//   paths, stops  ->  stages: paths up to a stop, the stop, paths up to the next, ...; each planned on its own
//
// A layer without stops is one stage, and planned as any other (plan/planner.hpp).
#pragma once

#include <memory>
#include <vector>

#include "plan/planner.hpp"

namespace cleancolor {

/// After the path of that source the carriage is where `leaving` begins, with its extruder in use.
struct Stop {
  int source = 0;
  Path leaving;  // of one point
};

/// The paths of each stage; a stop is one of its own.  Requires: every stop is the source of a path.
std::vector<Layer> stages_of(Layer layer, const std::vector<Stop>& stops);

class StagedLayer {
 public:
  /// first: the extruder that begins.
  StagedLayer(Layer layer, int first, const std::vector<Stop>& stops, const Config& config, const PlanScene& scene,
              const SurfaceVisibility& visibility);

  /// The ways to each stage, the first from where the layer below ended.
  void arrive_from(const Path& below);

  /// Where the carriage is afterwards: a path that ends there, with its extruder.  Requires: it arrived.
  const Path& last() const { return last_; }

  Layer release() &&;

 private:
  std::vector<PlannedLayer> stages_;
  std::vector<Stop> stops_;
  Path last_;
};

}  // namespace cleancolor
