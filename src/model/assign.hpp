// model/assign.hpp
//
// Which extruder prints which part.
//
// For each part the first of these that applies decides:
//   1. the extruder given with its file (--extruder N before it);
//   2. a mapping of its colour (--map-colour);
//   3. the extruder that the file itself names for the part;
//   4. its colour or material, where it is the only file or its file has several of them: each distinct one takes the
//      next free extruder in order of first use;
//   5. its file, where there are several: each that still needs one takes the next free extruder;
//   6. extruder 0.
// Free are, from the first up, the extruders that 1 and 2 do not name.
//
// A mapping of a colour that no part has is a mistake in typing more often than not, so it is refused. A file of
// several parts that all fall through to 5 or 6 may have lost its colours on the way, so it is warned of where the
// printer has several extruders.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "base/progress.hpp"
#include "model/mesh.hpp"

namespace cleancolor {

struct Assignment {
  std::vector<std::optional<int>> extruder_of_file;  // 0-based; as many as files, or none
  std::map<std::uint32_t, int> extruder_of_rgb;      // 0xRRGGBB -> 0-based
  int extruders = 1;                                 // of the printer
};

/// Afterwards every part has an extruder in [0, assignment.extruders).
/// Throws Error where the printer has too few extruders, or no part has a mapped colour. Numbers in messages are
/// 1-based.
void assign_extruders(std::span<std::vector<Part>> files, const Assignment& assignment, const Progress& progress = {});

}  // namespace cleancolor
