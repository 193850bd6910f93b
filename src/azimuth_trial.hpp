// azimuth_trial.hpp
//
// Azimuth trial: some layers of a print, planned at a few angles, tell at which of them idle nozzles smear least.
//
//   layers, angles of little exposure  ->  the angle whose plan is predicted to be cleanest
//
// The exposure (orient/exposure.hpp) knows neither walls nor order nor travel; of valleys that are about as deep it
// cannot tell the best. Here the layers stay as they are sliced and the nozzles' offsets are turned against them;
// without skins, direction of view or translucent plastic, which tell angles apart no better.
#pragma once

#include <span>
#include <vector>

#include "protection.hpp"

namespace cleancolor {

struct AzimuthTrial {
  int turned_by_deg = 0;
  double smear_mm3 = 0, hole_mm3 = 0;  // of the whole print, from the layers looked at, single bad ones cut off
};

struct TrialOptions {
  int layers = 24;  // looked at, evenly spread; fewer where there are more than two nozzles
  int threads = 1;
};

/// One for each angle, in their order.
/// Requires: idle nozzles stay at print height.  Cost: planning so many layers for each angle; same for any number of
/// threads.
std::vector<AzimuthTrial> azimuth_trials(const Slices& slices, const Use& use, const Config& config,
                                         std::span<const int> turned_by_deg, const TrialOptions& options);

/// The one of least smears and holes; no turn where turning does not bring an eighth of them.  Requires: not empty.
int cleanest(std::span<const AzimuthTrial> trials);

}  // namespace cleancolor
