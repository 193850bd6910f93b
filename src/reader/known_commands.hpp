// reader/known_commands.hpp
//
// Commands that move neither carriage nor filament, so that a file with them is understood whole.
#pragma once

#include <string_view>

#include "reader/line.hpp"

namespace cleancolor {

/// Whether the command is known to lay no plastic and to move nothing that matters here (fans, displays, beds,
/// levelling, pressure advance, object labels). Those that the reader itself acts on are not among them.
bool is_harmless(const GcodeLine& line);

}  // namespace cleancolor
