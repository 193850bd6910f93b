// reader/arc.hpp
//
// Arc: G2 and G3 as chords.
#pragma once

#include <optional>
#include <vector>

#include "base/vec.hpp"

namespace cleancolor {

struct Arc {
  Vec2 from_mm, to_mm;
  bool clockwise = false;
  std::optional<Vec2> center_mm;  // from I J
  double radius_mm = 0;           // from R where there is no centre; negative: the longer of the two arcs
};

struct ArcPoint {
  Vec2 at_mm;
  double share = 0;  // of the arc's length, in (0, 1]
};

/// Points along the arc after its start, the last one being to_mm exactly; chords keep within 0.01 mm of the arc. Equal
/// ends with a centre are a full circle. At most 2048 chords. Empty where there is no such circle.
std::vector<ArcPoint> chords(const Arc& arc);

}  // namespace cleancolor
