// plan/refill.hpp
//
// Refill: plastic that oozed out of the nozzle on the way is pushed back in beside a wall of the rampart.
//
//   a layer's paths with their travel  ->  the same, with passes along standing walls (Role::refill)
//
// fixed, as in the paper: each way that leads along a standing wall, to an outer wall or from a wall to the part,
// pushes the same volume. model: what is forecast to be missing, where that is worth the way to the wall. Either way no
// more than there is room for beside the wall (plan/wall_room.hpp). Walls printed just before each colour's run fill
// nozzles already, and from the wall to the part a little is lost again, so it brings little and is off by default.
//
// Source: Hergel and Lefebvre, Clean color, section 6.5.
#pragma once

#include <vector>

#include "model/config.hpp"
#include "plan/ooze_forecast.hpp"
#include "plan/tour.hpp"

namespace cleancolor {

/// One pass.
struct Refill {
  double volume_mm3 = 2;
  double feed_mm_s = 2;  // of the filament
  double filament_diameter_mm = 1.75;
  double max_speed_mm_s = 120;
};

/// Carriage speed (mm/s) at which a pass of this length pushes refill.volume_mm3 while the filament goes at
/// refill.feed_mm_s: length x feed x pi x diameter^2 / (4 x volume). Where that exceeds refill.max_speed_mm_s the
/// filament is fed more slowly: never more is pushed than asked.
/// Source: section 6.5.  Requires: all fields of refill > 0.
double refill_speed(double length_mm, const Refill& refill);

struct RefillOptions {
  RefillMode mode = RefillMode::model;
  double volume_mm3 = 2;  // of each pass where mode is fixed
  double feed_mm_s = 2;
  std::vector<double> filament_diameter_mm = {1.75};  // of each extruder; the last holds for those beyond
  double gap_mm = 4;                                  // from wall to wall
  double hole_mm = 0;                                 // of way that a missing mm3 in plain sight is worth
  HopTime hop;
};

/// As configured, for the hops of an extruder.
RefillOptions refill_options(const Config& config, int extruder);

/// paths: begun, with Path::travel in the frame of their own nozzle; walls among them come before what they fill for.
/// Cost: fixed: segments of walls x 5 ns for each 0.5 mm of way; model: two short searches for each outer wall that is
/// worth it.
std::vector<Path> with_refills(std::vector<Path> paths, const Roadmap& roads, const TravelCost& cost,
                               const OozeModel& model, const RefillOptions& options);

}  // namespace cleancolor
