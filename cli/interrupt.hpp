// cli/interrupt.hpp
//
// Ctrl-C: asked for once, the library stops and leaves no output; asked for twice, the program ends at once.
#pragma once

namespace cleancolor {

/// From now on SIGINT and SIGTERM are noted instead of ending the program; a second one ends it.
void watch_interrupts();

/// Has one come?
bool interrupted();

}  // namespace cleancolor
