// replan/found_roles.hpp
//
// Found roles: what each road is, of a file that does not say so (Slic3r without verbose comments).
//
//   moves  ->  the same with roles: what comes back to where it began is a wall, along the border of its region the
//              outer one; what lies around all else of a layer, and before it, a skirt; the rest is a fill
//
// They are there to plan by: nothing that is written says them, and the comparison of before and after does without.
#pragma once

#include "audit/machine.hpp"
#include "reader/print.hpp"

namespace cleancolor {

/// Whether any road of the part says what it is.
bool tells_roles(const GcodePrint& print);

/// Throws Error where supports, a raft or a brim are among the roads: they would be taken for the part.
GcodePrint with_found_roles(GcodePrint print, const AuditMachine& machine);

}  // namespace cleancolor
