// replan/staged_layer.hpp
//
// Staged layer: a layer with stops that stay in their place: what the file does there is neither moved nor changed.
//
//   paths, stops  ->  paths up to a stop, the stop, paths up to the next, ...; each part planned on its own
//
// Where tools change off the print, and nothing is laid there, all is planned together, and the ways to the stop and
// from there are found afterwards. A layer without stops is planned as any other (plan/planner.hpp).
#pragma once

#include <vector>

#include "plan/planner.hpp"

namespace cleancolor {

/// After the path of that source the carriage is where `leaving` begins, with its extruder in use.
struct Stop {
  int source = 0;
  bool lays = false;  // plastic
  Path leaving;       // of one point
};

/// The paths of each part; a stop is one of its own.
std::vector<Layer> parts_of(Layer layer, const std::vector<Stop>& stops);

class StagedLayer {
 public:
  /// first: the extruder that begins.
  StagedLayer(Layer layer, int first, const std::vector<Stop>& stops, const Config& config, const PlanScene& scene,
              const SurfaceVisibility& visibility);

  /// The ways to each part, the first from where the layer below ended. Returns: whether every change of tools comes at
  /// its stop.
  bool arrive_from(const Path& below);

  /// Where the carriage is afterwards: a path that ends there, with its extruder.  Requires: it arrived.
  const Path& last() const { return last_; }

  Layer release() &&;

 private:
  /// A stop off the print, before that path of that part.
  struct Aside {
    Path stop, leaving;
    bool used = false;
    std::size_t part = 0, before = 0;
    std::vector<Vec2> travel;  // of the path after it
  };
  Aside* stand(std::size_t part, std::size_t before, const Path& from, int next);

  std::vector<PlannedLayer> parts_;
  std::vector<Stop> stops_;    // that lay plastic
  std::vector<Aside> asides_;  // as in the file
  Path last_;
};

}  // namespace cleancolor
