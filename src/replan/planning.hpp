// replan/planning.hpp
//
// Planning: the plan of a recovered print.
//
//   scene (replan/scene.hpp), printer, config  ->  layers in order, with rampart and travel
//
// The order of the planner keeps that of the file where plastic depends on it: loops from the inside out, or as
// external_perimeters_first says, fills after the loops of their region; skirt and brim first, in their order.
#pragma once

#include <vector>

#include "audit/machine.hpp"
#include "base/progress.hpp"
#include "model/config.hpp"
#include "replan/recovered.hpp"
#include "replan/scene.hpp"
#include "replan/worth.hpp"
#include "toolpath/path.hpp"
#include "visibility/visibility.hpp"

namespace cleancolor {

struct ReplanOptions {
  const SurfaceVisibility* visibility = nullptr;  // of the scene; none: in the order of slicers without protection
  bool knows_bed = true;                          // else ways may go anywhere
  RampartExtent rampart = RampartExtent::all;
  int threads = 1;
};

struct ReplannedLayers {
  std::vector<Layer> layers;
  bool has_rampart = false;
  bool stands_apart = false;  // the part, in several columns (replan/columns.hpp)
};

/// The layers in printing order: Path::source is the run of the layer that a path is, -1 that of a rampart or refill.
/// Without room for the rampart it is left out, with a warning; one around a column where there is but one is left out,
/// too. Same result for any number of threads.
ReplannedLayers planned_layers(const Scene& scene, const RecoveredPrint& recovered, const GcodePrint& print,
                               const AuditMachine& machine, const Config& config, const ReplanOptions& options,
                               const Progress& progress);

}  // namespace cleancolor
