// replan/scene.hpp
//
// Scene: the layers of a recovered print as the planner knows them; every plan of the print begins with it.
//
//   recovered print, machine  ->  regions of each nozzle, paths with their regions and depths, stops between them
//
// Regions are what each nozzle's roads enclose (printed/regions.hpp). Loops are closed again, so that they can be begun
// elsewhere.
#pragma once

#include <vector>

#include "audit/machine.hpp"
#include "reader/print.hpp"
#include "replan/recovered.hpp"
#include "replan/staged_layer.hpp"
#include "replan/storeys.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

/// Where the plastic lies when the file says so, mm.
Vec2 place_mm(FilePoint at, int tool, const AuditMachine& machine);

/// The run as a path of the planner; source: its index. Closed where it comes back to where it began.
Path path_of(const RecoveredRun& run, int source, double height_mm, const GcodePrint& print,
             const AuditMachine& machine);

struct Scene {
  Storeys storeys;
  std::vector<Layer> layers;             // their paths as in the file
  std::vector<std::vector<Stop>> stops;  // of each layer
  std::vector<PackedPolygons> skirts;    // of each layer: loops that stand apart from all else, but for shields
  bool has_shield = false;
};

/// keeps_seams: loops stay open, so that they begin where they do in the file, or end there and run the other way.
/// Throws Error where there is nothing of a part.  Same result for any number of threads.
/// Cost: some 4 us of CPU a road.
Scene scene_of(const RecoveredPrint& recovered, const GcodePrint& print, const AuditMachine& machine, bool keeps_seams,
               int threads);

/// The storeys' outlines with all that skirts enclose.
Slices around_skirts(const Scene& scene);

}  // namespace cleancolor
