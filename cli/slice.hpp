// cli/slice.hpp
//
// cleancolor slice: command -> request -> one call into the library -> summary.
#pragma once

#include <iosfwd>

#include "cli/command_line.hpp"

namespace cleancolor {

/// The profiles, files and options put together. Throws Error where they do not do, or where no printer was named but
/// several extruders are needed.
SliceRequest slice_request(const SliceCommand& command, const Progress& progress);

/// Slices; the summary goes to out. Throws what the library throws.
void run(const SliceCommand& command, std::ostream& out, std::ostream& err, bool err_is_terminal);

}  // namespace cleancolor
