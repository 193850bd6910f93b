// replan/cura.hpp
//
// Cura: its engine writes no configuration, so what the planner must know of it is read off the moves.
//
//   moves  ->  widths, speeds and heights of roads, travel, how filament is drawn back and lifted over
//
// Each is the most frequent value: of roads and travel by length, of what is drawn back by number.
#pragma once

#include <optional>

#include "audit/machine.hpp"
#include "model/config.hpp"
#include "reader/print.hpp"

namespace cleancolor {

/// Of the printer only what the file does not show: bed, reach, nozzles. Without a printer the bed is what the file
/// makes use of, and cura_free_mm around it.
/// Throws Error where the moves do not tell it, or what it was printed by cannot be re-planned; it says what to do.
Config cura_config(const GcodePrint& print, const AuditMachine& machine, const Config* printer);

/// The same with skins that are laid with hardly any plastic as what they are, ironing; nothing where there are none.
/// They are there to plan by, as in replan/found_roles.hpp.
std::optional<GcodePrint> with_ironing(const GcodePrint& print);

inline constexpr double cura_free_mm = 20;

}  // namespace cleancolor
