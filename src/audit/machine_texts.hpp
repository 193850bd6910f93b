// audit/machine_texts.hpp
//
// What people type about the printer that G-code is for -> parts of a MachineRequest.
//
// where: the option, as messages call it: "--nozzle-offset".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/vec.hpp"
#include "model/config.hpp"

namespace cleancolor {

/// "0x0,33x0": each nozzle as seen from the first, mm. Throws Error for anything else, and beyond 1000 mm.
std::vector<Vec2> nozzle_offsets_of(std::string_view text, const std::string& where);

/// slicer or firmware.  Throws Error.
OffsetsIn offsets_in_of(std::string_view text, const std::string& where);

/// same_height, lifted, parked or docked.  Throws Error.
IdleNozzle idle_nozzle_of(std::string_view text, const std::string& where);

/// The words themselves, by value.
std::string_view idle_nozzle_word(IdleNozzle idle);

}  // namespace cleancolor
