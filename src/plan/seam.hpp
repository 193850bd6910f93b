// plan/seam.hpp
//
// Seam: where a closed path is begun and ended.
#pragma once

#include <vector>

#include "model/config.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

/// What aligned seams of a layer remember of the layer below.
struct SeamMemory {
  std::vector<std::vector<Vec2>> below;  // [extruder], seams of the layer below
  std::vector<std::vector<Vec2>> here;   // of this one, so far

  void next_layer() {
    below.swap(here);
    for (auto& seams : here) seams.clear();
  }
};

/// The same loop, begun at its seam.
///
/// nearest: at the point nearest to `from`, corners preferred. aligned: where a seam of the layer below lies within
/// 3 mm of the loop, else at the sharpest corner. rear: at the largest y. random: anywhere, decided by `seed`.
/// Requires: loop.closed.  Cost: one pass over the loop; aligned: times the seams of the layer below.
Path seamed(Path loop, SeamPosition position, Vec2 from, SeamMemory& memory, std::uint32_t seed);

}  // namespace cleancolor
