// plan/wipe.hpp
//
// Wipe: before a nozzle leaves what hangs on it on another colour, the carriage takes it across a wall of the rampart,
// where that is worth the time.
//
//   a layer's paths with their travel  ->  the same with other travel
//
// The roadmap's ways know what a nozzle hangs over, not what it carries; here the forecast of the layer
// (plan/layer_forecast.hpp) says so. Hops are looked at from the last to the first: what the way there brings does not
// hang on hops before it, and a nozzle that a later hop wipes in time is not wiped twice.
#pragma once

#include <vector>

#include "plan/layer_forecast.hpp"
#include "plan/tour.hpp"

namespace cleancolor {

struct WipeOptions {
  double hole_weight = 4;  // mm3 of smear that a missing mm3 is worth
  double s_mm3 = 0.005;    // that a second is worth
  HopTime hop;

  /// Where the carriage is when each path ends, with the gaps of seams; empty: where the path ends.
  std::vector<Vec2> stops_mm = {};
};

/// As configured, for the hops of an extruder.
WipeOptions wipe_options(const Config& config, int extruder);

/// paths: begun, with Path::travel in the frame of their own nozzle; walls among them in the order of the map's. They
/// stay as they are and where they are; the way to some of them leads a nozzle across a wall that stands by then, and
/// over no foreign plastic of a visibility above 0.05 but where it did before.
/// Cost: some forecasts of the layer, and for each way that may be worth it some 20 us, seldom a short search: 2 % of
/// the time of slicing two colours.
std::vector<Path> with_wipes(std::vector<Path> paths, const Roadmap& roads, const TravelCost& cost,
                             const OozeModel& model, const WipeOptions& options);

}  // namespace cleancolor
