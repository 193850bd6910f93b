// shield/start.hpp
//
// Start: where a wall is begun and in which direction, so that idle nozzles are wiped before they reach the part.
//
//   wall, where the idle nozzles are, what stands already  ->  the wall, begun there
//
// While the wall is printed every idle nozzle goes the same way beside it. It must cross plastic of the rampart that
// stands already - another wall of this layer, or what this wall has behind it - before it comes over the part. The
// paper begins at the leftmost point when the right nozzle prints; this follows from the offsets for any nozzles.
// Source: Hergel and Lefebvre, Clean color, section 5.
#pragma once

#include <span>
#include <vector>

#include "base/polygon.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

struct WallScene {
  std::vector<Vec2> idle_mm;   // where each idle nozzle is, as seen from the one that prints
  Polygons part;               // all plastic of the part in this layer
  std::vector<Path> standing;  // walls of this layer that are printed already
};

/// Where a wall can be begun.
struct WallStart {
  std::size_t segment = 0;  // of the path
  Vec2 at_mm;               // on it
  bool backwards = false;   // against the order of the points
  double exposure_mm = 0;   // way of idle nozzles over the part before their first wipe
};

/// The start of least exposure, of equals the one nearest to from_mm. Open walls begin at one of their ends.
/// Cost: some 0.1 us for each mm of wall and idle nozzle.
WallStart wall_start(const Path& wall, const WallScene& scene, Vec2 from_mm);

/// Way of idle nozzles over the part before their first wipe, if an open wall is printed as it is, or from its other
/// end.
double exposure_mm(const Path& open_wall, const WallScene& scene, bool backwards);

/// The wall begun so.
Path begun(Path wall, const WallStart& start);

}  // namespace cleancolor
