// plan/precedence.hpp
//
// Precedence: which paths of a layer must be printed before which, whatever the order.
#pragma once

#include <span>
#include <vector>

#include "toolpath/path.hpp"

namespace cleancolor {

inline bool is_loop(const Path& path) {
  return path.depth != fill_depth;
}

/// It goes over a top surface that is printed: after all else of its extruder, in the order and direction given.
inline bool irons(const Path& path) {
  return path.road().role == Role::ironing;
}

/// For each loop of one island the one that lies next to it on the side of the outline: the nearest of those a step
/// less deep, as seen from its first point; -1 where there is none.
std::vector<int> outer_loops(std::span<const Path> paths);

/// For each path of one extruder those that must be printed before it: loops before the one around them (after it where
/// external_first), the fills of an island after all its loops, and ironing after all else, in its order.
std::vector<std::vector<int>> precedence(std::span<const Path> paths, bool external_first);

}  // namespace cleancolor
