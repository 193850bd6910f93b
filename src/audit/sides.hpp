// audit/sides.hpp
//
// The print from four sides, as it will come out: predicted smears in the colour of the nozzle that leaves them.
#pragma once

#include <string>
#include <vector>

#include "audit/audit.hpp"
#include "audit/machine.hpp"

namespace cleancolor {

struct Side {
  std::string name;  // "front", "right", "back", "left"
  std::string png;
};

/// One picture from each side, a little from above, of the surface of the printed part's voxels in the colours of their
/// nozzles; a place where a smear is left takes on the colour of its nozzle, the more the more is left; holes are dark.
///
/// Requires: scenario < result.scenarios.size(); result.visibility.  Cost: about 0.5 s for 50 000 mm2 of surface.
std::vector<Side> sides(const GcodePrint& print, const AuditMachine& machine, const AuditResult& result,
                        std::size_t scenario, int width_px = 420);

}  // namespace cleancolor
