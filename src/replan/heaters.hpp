// replan/heaters.hpp
//
// Heaters: temperatures of nozzles that a file changes among its layers, for the same print in another order.
//
//   print, text in its new order  ->  text with the temperatures in their new places
//
// Of each tool: how hot it prints in each layer; how cool it idles, if it does, and how long it must idle for that; how
// long before it is used again it begins to heat up: as long as the file ever takes. Whoever is heated up waits until
// it is hot. A tool that is not used again is switched off where the file does so.
#pragma once

#include <string>
#include <string_view>

#include "audit/machine.hpp"
#include "reader/print.hpp"
#include "replan/recovered.hpp"

namespace cleancolor {

/// Whether a temperature of a nozzle is set among the layers.
bool sets_temperatures(const RecoveredPrint& recovered, const GcodePrint& print);

/// The text of `after`, which has none of the temperatures that stand among the layers of `print` but those of tools
/// that print nothing there.
/// layer_mark: how its layers begin.  Cost: linear in the number of moves, tool changes and temperatures.
std::string with_heaters(const RecoveredPrint& recovered, const GcodePrint& print, const GcodePrint& after,
                         const AuditMachine& machine, std::string_view layer_mark);

}  // namespace cleancolor
