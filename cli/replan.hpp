// cli/replan.hpp
//
// cleancolor replan: command -> a file read, planned anew, and written.
#pragma once

#include <iosfwd>

#include "cli/command_line.hpp"

namespace cleancolor {

/// Throws Error where the file cannot be re-planned, unless the command keeps going.
void run(const ReplanCommand& command, std::ostream& out, std::ostream& err, bool err_is_terminal);

}  // namespace cleancolor
