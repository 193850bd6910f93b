// cli/explain.hpp
//
// cleancolor explain: command -> one layer of a file explained -> picture and table.
#pragma once

#include <iosfwd>

#include "cli/command_line.hpp"

namespace cleancolor {

/// Explains; the table, or JSON where asked for, goes to out. Throws what the library throws.
void run(const ExplainCommand& command, std::ostream& out, std::ostream& err, bool err_is_terminal);

}  // namespace cleancolor
