// orient/interference.hpp
//
// Interference: the volume of all places at which a printing nozzle puts an idle one over another colour.
//
//   I(d) = vol{ p in the plastic of i : p + d in plastic of another colour than j }
//
// an overlap of two fixed bodies, one moved by d; the part never turns. Source: Clean color, section 4.
#pragma once

#include <vector>

#include "base/rows.hpp"
#include "slice/slices.hpp"

namespace cleancolor {

class Interference {
 public:
  /// Exact in X; rows in Y, and levels in Z where layers are thinner than half a millimetre, so fine that there are
  /// some 16 000 rows in all. Cost: the layers' polygons once.
  explicit Interference(const Slices& slices);

  /// Cost: about 0.5 ms for two extruders.  Requires: printing != idle, both extruders of the slices.
  double volume_mm3(int printing, int idle, Vec2 d_mm) const;

 private:
  struct Level {
    double height_mm = 0;       // that it stands for
    std::vector<Rows> own;      // of each extruder
    std::vector<Rows> foreign;  // all colours but that of each extruder
  };
  RowPlan plan_;
  std::vector<Level> levels_;
};

}  // namespace cleancolor
