// audit/offset_guess.hpp
//
// Who makes up for the nozzle offsets, seen from the plastic: parts of one print touch and do not overlap.
#pragma once

#include <optional>
#include <vector>

#include "reader/print.hpp"

namespace cleancolor {

struct OffsetFit {
  double touching = 0;     // share of the smaller colour's roads that touch another colour's, in [0, 1]
  double overlapping = 0;  // and that lie over another colour's
};

/// How well the colours fit together if tool i's plastic lies at X Y + shift[i].  Cost: linear in the moves.
OffsetFit offset_fit(const GcodePrint& print, const std::vector<Vec2>& shift_mm);

/// slicer or firmware, whichever fits clearly better with nozzles at these offsets; nothing where neither does.
std::optional<OffsetsIn> guessed_offsets_in(const GcodePrint& print, const std::vector<Vec2>& nozzle_offset_mm);

/// Offsets for which the plastic of the tools fits together, where it does not as it stands; empty where no shift makes
/// a clear difference (then the file is in the firmware's form, and nothing tells where the nozzles are).
std::vector<Vec2> guessed_offsets_mm(const GcodePrint& print);

}  // namespace cleancolor
