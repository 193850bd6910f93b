// cli/audit.hpp
//
// cleancolor audit: command -> every file read and judged -> reports.
#pragma once

#include <iosfwd>

#include "cli/command_line.hpp"

namespace cleancolor {

/// Audits; tables, or JSON where asked for, go to out. Outputs are written when all files are judged.
///
/// Returns exit_done, or exit_exceeded where a figure is over its limit, which err tells.  Throws what the library
/// throws.
int run(const AuditCommand& command, std::ostream& out, std::ostream& err, bool err_is_terminal);

}  // namespace cleancolor
