// explain/explanation.hpp
//
// Explanation: how one layer was planned, found again in its G-code.
//
//   print, printer, layer  ->  its runs and ways, regions, what can be seen, roadmap, a row for each run
//
// The roadmap is made anew from what was printed, as the planner makes it (plan/roadmap.hpp): its nodes lie where the
// planner's may lie, not at the very same places. For files of other slicers it shows the ways there would have been.
#pragma once

#include <memory>
#include <vector>

#include "base/progress.hpp"
#include "plan/layer_map.hpp"
#include "plan/roadmap.hpp"
#include "printed/printed_layer.hpp"
#include "printed/zones.hpp"

namespace cleancolor {

/// One run, in printing order.
struct ExplainedRun {
  int zone = -1;                // index into Explanation::zones; -1: auxiliary plastic
  double length_mm = 0;         // of its road
  double start_visibility = 0;  // of the place where it begins; where an outer wall of it begins, of that
  double hop_mm = 0;            // the way of the carriage before it
  double hop_foreign = 0;       // the largest visibility of foreign plastic that any nozzle crosses on it
  double idle_foreign = 0;      // and that an idle one crosses while the run is printed
};

struct Explanation {
  std::uint32_t layer = 0;
  double z_mm = 0;
  PrintedLayer printed;
  std::vector<ExplainedRun> runs;  // of each of PrintedLayer::runs
  std::vector<Polygons> regions;   // of each nozzle of the machine
  std::vector<Zone> zones;         // by nozzle
  std::vector<int> used;           // nozzles that print something in the file, ascending
  bool hanging = true;             // idle nozzles stay at print height
  std::unique_ptr<LayerMap> map;   // never null
  std::vector<Roadmap> roadmaps;   // one; where idle nozzles leave the print one for each turn of a nozzle
  std::vector<TravelCost> costs;   // of each nozzle of the machine while it is in use

  const TravelCost& cost(int tool) const { return costs[std::min(std::size_t(tool), costs.size() - 1)]; }
};

struct ExplainOptions {
  double reach_mm = 25;  // layers so far above and below decide what can be seen
  int threads = 1;
};

/// Requires: layer < print.layers.size().  Throws Error where progress is interrupted.
/// Cost: about 0.5 s for a layer of 5000 roads with 250 layers in reach.
Explanation explained(const GcodePrint& print, const AuditMachine& machine, std::uint32_t layer,
                      const ExplainOptions& options = {}, const Progress& progress = {});

}  // namespace cleancolor
