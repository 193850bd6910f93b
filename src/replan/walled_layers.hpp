// replan/walled_layers.hpp
//
// Walled layers: up to where a rampart is of use.
//
//   layers with their paths  ->  how many of them, from the bed
//
// Above the last layer in two colours the idle nozzles let out what they have left, and then nothing more.
#pragma once

#include <span>

#include "plan/ooze_forecast.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

/// Those up to the last change of extruder, and as many more as take five times the ooze model's time: then less than
/// 1 % is still to come.
int walled_layers(std::span<const Layer> layers, const OozeModel& ooze);

}  // namespace cleancolor
