// replan/leads.hpp
//
// Leads: short strokes inside the part that make up for what oozed out on the way to an outer wall.
//
//   layer in printing order, regions of its nozzles  ->  the same with a refill before some outer walls
//
// An outer wall that begins after a way lacks at its start what oozed out on it. Where a loop within goes over into it
// (plan/joined_loops.hpp) that lacks it. Single walls have none: the nozzle comes to them from inside, by a stroke
// (Role::refill) of as much plastic as is forecast to be missing, but no more than a wall of that length takes.
#pragma once

#include <vector>

#include "base/polygon.hpp"
#include "plan/ooze_forecast.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

struct LeadOptions {
  OozeModel ooze;
  std::vector<HopTime> hop;  // of each extruder
};

/// regions: of each extruder's plastic in the layer. from: the path printed before the layer, nullptr where none is.
/// Cost: the loops of its island once for each single wall.
Layer with_leads(Layer layer, const std::vector<Polygons>& regions, const Path* from, const LeadOptions& options);

}  // namespace cleancolor
