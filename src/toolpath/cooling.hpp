// toolpath/cooling.hpp
//
// Cooling: slower paths and more fan where a layer would not have the time to set.
#pragma once

#include "model/config.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

/// Sets fan_by_extruder of the layer, and slows its paths so that it lasts slowdown_below_layer_time, but never below
/// min_print_speed. Bridges keep their speed. The shortest times asked for by any extruder that prints here count.
///
/// The time is length / speed of paths and of travel between them, accelerations left out.
void cool(Layer& layer, const Config& config);

}  // namespace cleancolor
