// cli/azimuth.hpp
//
// cleancolor azimuth: command -> both curves and the best angle.
#pragma once

#include <iosfwd>

#include "cli/command_line.hpp"

namespace cleancolor {

/// Table, or JSON where asked for, to out; the picture to its file. Throws what the library throws.
void run(const AzimuthCommand& command, std::ostream& out, std::ostream& err, bool err_is_terminal);

}  // namespace cleancolor
