// replan/removed.hpp
//
// Removed: what the slicer put there against ooze, taken out again, so that a rampart can do it.
//
//   recovered print  ->  the same without its shield, or without its wipe tower; how much plastic went with it
#pragma once

#include <map>
#include <utility>

#include "reader/print.hpp"
#include "replan/recovered.hpp"

namespace cleancolor {

/// mm of filament, by tool and role.
using RemovedFilament = std::map<std::pair<int, Role>, double>;

/// Throws Error where lines that must stay would go with it.
RemovedFilament remove_shield(RecoveredPrint& recovered, const GcodePrint& print);

/// Tools are changed in its pieces: of their lines those that are neither moves nor about the tower stay with the
/// change. Throws Error where these changes are not the same each time, or move the carriage themselves.
RemovedFilament remove_tower(RecoveredPrint& recovered, const GcodePrint& print);

}  // namespace cleancolor
