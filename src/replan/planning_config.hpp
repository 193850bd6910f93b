// replan/planning_config.hpp
//
// Planning configuration: what a file and a profile say of printer and print, as the planner takes it.
#pragma once

#include "audit/machine.hpp"
#include "model/config.hpp"
#include "reader/print.hpp"

namespace cleancolor {

/// The profile, over it the file's configuration block, over both where nozzles are and that paths stay as they are.
/// Throws Error where the file has no configuration, or one whose print cannot be re-planned; it says what to do.
Config planning_config(const GcodePrint& print, const AuditMachine& machine, const Config* printer);

}  // namespace cleancolor
