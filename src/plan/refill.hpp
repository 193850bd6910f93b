// plan/refill.hpp
//
// Refill: plastic that oozed out of the nozzle on the way is pushed back in beside a wall of the rampart, before an
// outer wall would lack it.
//
//   a layer's paths with their travel  ->  the same, with passes along standing walls (Role::refill)
//
// The paper pushes 2 mm3 on every way through the corridor; here what is forecast to be missing, where that is worth
// the way to the wall. Walls printed just before each colour's run fill nozzles already, and from the wall to the part
// a little is lost again, so it brings little and is off by default.
//
// Source: Hergel and Lefebvre, Clean color, section 6.5.
#pragma once

#include <span>
#include <vector>

#include "model/config.hpp"
#include "plan/ooze_forecast.hpp"
#include "plan/tour.hpp"

namespace cleancolor {

struct RefillOptions {
  double hole_mm = 0;  // of way that a missing mm3 in plain sight is worth
  HopTime hop;
};

/// paths: begun, with Path::travel in the frame of their own nozzle; walls among them come before what they fill for.
/// Cost: two short searches for each outer wall that is worth it.
std::vector<Path> with_refills(std::vector<Path> paths, const Roadmap& roads, const TravelCost& cost,
                               const OozeModel& model, const RefillOptions& options);

}  // namespace cleancolor
