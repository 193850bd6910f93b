// replan/planning.hpp
//
// Planning: the layers of a recovered print as the planner knows them, and their plan.
//
//   recovered print, printer, config  ->  paths with regions, depths, roads  ->  layers in order, with rampart and
//   travel
//
// Regions are what each nozzle's roads enclose (printed/regions.hpp). The order of the planner keeps that of the file
// where plastic depends on it: loops from the inside out, or as external_perimeters_first says, fills after the loops
// of their region; skirt and brim first, in their order. Loops are closed again, so that they can be begun elsewhere.
#pragma once

#include <vector>

#include "audit/machine.hpp"
#include "base/progress.hpp"
#include "model/config.hpp"
#include "replan/recovered.hpp"
#include "replan/worth.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

/// What the planner must know of printer and print: the profile, over it the file's configuration block, over both
/// where nozzles are and that paths stay as they are.
/// Throws Error where the file has no configuration, or one whose print cannot be re-planned; it says what to do.
Config planning_config(const GcodePrint& print, const AuditMachine& machine, const Config* printer);

/// Where the plastic lies when the file says so, mm.
Vec2 place_mm(FilePoint at, int tool, const AuditMachine& machine);

/// The run as a path of the planner; source: its index. Closed where it comes back to where it began.
Path path_of(const RecoveredRun& run, int source, double height_mm, const GcodePrint& print,
             const AuditMachine& machine);

struct ReplanOptions {
  bool plans = true;         // false: order, starts and ways stay those of the file
  bool keeps_seams = false;  // loops begin where they do in the file, or end there and run the other way
  RampartExtent rampart = RampartExtent::all;
  int threads = 1;
};

struct ReplannedLayers {
  std::vector<Layer> layers;
  bool has_rampart = false;
  bool stands_apart = false;  // the part, in several columns (replan/columns.hpp)
};

/// The layers in printing order: Path::source is the run of the layer that a path is, -1 that of a rampart or refill.
/// Without room for the rampart it is left out, with a warning; so is one around a column where there is but one.
/// Same result for any number of threads.
ReplannedLayers planned_layers(const RecoveredPrint& recovered, const GcodePrint& print, const AuditMachine& machine,
                               Config config, const ReplanOptions& options, const Progress& progress);

}  // namespace cleancolor
