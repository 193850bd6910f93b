// explain/plan_panels.hpp
//
// The three views of a layer's plan.
//
//   plan     what is printed, in which order and direction, and the travel between, as the nozzle in use goes
//   roadmap  in the carriage's frame: where some nozzle would hang over visible plastic of another colour, and the ways
//   nozzles  where every nozzle is while it does not print, and where it hangs over visible plastic of another colour
#pragma once

#include "audit/machine.hpp"
#include "explain/explanation.hpp"
#include "explain/panel.hpp"

namespace cleancolor {

struct PlanScenery {
  const Explanation& plan;
  const AuditMachine& machine;
};

// What each view shows, with a little air around it; never empty.
Box<Vec2> plastic_view(const PlanScenery& scenery);
Box<Vec2> carriage_view(const PlanScenery& scenery);

/// Returns how many paths found room for their number.
std::size_t draw_plan(const Panel& panel, const PlanScenery& scenery);
void draw_roadmap(const Panel& panel, const PlanScenery& scenery);
void draw_nozzles(const Panel& panel, const PlanScenery& scenery);

// Colours, for the legend as well.
Colour nozzle_colour(const AuditMachine& machine, int nozzle);
Colour nozzle_line(const AuditMachine& machine, int nozzle);  // readable on white
enum class RoadLook { outer, inner, auxiliary, refill };
Colour road_colour(const AuditMachine& machine, int nozzle, RoadLook look);

/// Where an outer wall begins, and where it ends.
void draw_start(Canvas& canvas, Vec2 at_px);
void draw_end(Canvas& canvas, Vec2 at_px);

}  // namespace cleancolor
