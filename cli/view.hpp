// cli/view.hpp
//
// cleancolor view: command -> a server for the page -> until it is interrupted.
#pragma once

#include <iosfwd>

#include "cli/command_line.hpp"

namespace cleancolor {

/// Serves until the program is interrupted; the address goes to out, what is refused to err. Throws what the library
/// throws.
void run(const ViewCommand& command, std::ostream& out, std::ostream& err);

}  // namespace cleancolor
