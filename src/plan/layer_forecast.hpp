// plan/layer_forecast.hpp
//
// Layer forecast: what the nozzles will spoil while a planned layer is printed, roads and travel alike.
//
//   paths with their travel, what lies where  ->  smears, holes
//
// A plain walk in small steps. Other than in ooze_forecast.hpp any plastic empties a nozzle that passes over it, as in
// the audit's definitions. It serves to compare plans of the same layers.
#pragma once

#include <span>

#include "plan/ooze_forecast.hpp"

namespace cleancolor {

struct LayerForecast {
  double smear_mm3 = 0, hole_mm3 = 0;  // x visibility
  double seconds = 0;                  // without accelerations of roads
};

/// paths: begun, with Path::travel, as they are printed; walls among them in the order of the map's.
/// Cost: about 0.2 ms for a layer of 1 m and two nozzles.
LayerForecast layer_forecast(std::span<const Path> paths, const TravelCost& cost, const OozeModel& model,
                             const HopTime& hop);

}  // namespace cleancolor
