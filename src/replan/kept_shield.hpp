// replan/kept_shield.hpp
//
// Kept shield: a skirt of the slicer that stands as high as the print. It wipes nozzles as a wall of a rampart does, so
// that it is planned as one: printed before the paths of its nozzle, begun where idle nozzles are wiped first.
#pragma once

#include <vector>

#include "reader/print.hpp"
#include "replan/recovered.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

/// The indices of the runs of each layer that are its shield; empty where the print has none: a skirt in no more than
/// five layers. Roads of the first layer that are no loop of the second are a brim.
std::vector<std::vector<std::size_t>> shield_runs(const RecoveredPrint& recovered, const GcodePrint& print);

/// The path of a shield as a wall of a rampart; closed where it comes back to where it began.
Path as_wall(Path path);

}  // namespace cleancolor
