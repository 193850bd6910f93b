// gcode/template_codes.hpp
//
// What the user's own G-code does by itself, so that it is not done twice.
#pragma once

#include <string_view>

#include "gcode/flavour.hpp"

namespace cleancolor {

/// Whether start code sets the temperature of this nozzle. A heating code without a tool is meant for initial_tool; one
/// with S0 says "leave it to me" for all. A macro heats those nozzles whose {first_layer_temperature[n]} it is given;
/// without [n] the initial tool's.
/// code: as in the config; filled: the same with its placeholders replaced.
bool heats_nozzle(std::string_view code, std::string_view filled, const FlavourWords& words, int tool,
                  int initial_tool);

/// The same of the bed.
bool heats_bed(std::string_view code, std::string_view filled, const FlavourWords& words);

/// Whether a line makes this tool the active one.
bool selects_tool(std::string_view filled, const FlavourWords& words, int tool);

}  // namespace cleancolor
