// audit/offset_guess.hpp
//
// Where the nozzles are, and who makes up for it, seen from the plastic: parts of one print touch and do not overlap.
//
//   roads of the part in layers of several tools, two forms of the file  ->  the form in which the colours fit together
//
// Roads are drawn as thin lines into cells of 0.25 mm. Where two colours meet, their outermost lines run side by side,
// 0.2 to 0.5 mm apart: many cells of one lie beside cells of the other, and next to none over them. Where they cross
// each other by mistake, about one cell in three lies over.
#pragma once

#include <optional>
#include <vector>

#include "reader/print.hpp"

namespace cleancolor {

struct OffsetFit {
  double touching = 0;     // share of the smaller colour's cells beside (within 0.5 mm of) another colour's, in [0, 1]
  double overlapping = 0;  // and over another colour's
  double together = 0;     // share of the smaller colour's box that lies in another colour's box, in [0, 1]
};

/// How well the colours fit together if the plastic of tool i lies at X Y + shift[i], in up to 24 layers that several
/// tools print. Where there is none, `together` is that of neighbouring layers of different tools. Skirts, towers and
/// other auxiliary plastic do not count.  All zero: the tools meet in no layer.
/// Cost: linear in the moves.
OffsetFit offset_fit(const GcodePrint& print, const std::vector<Vec2>& shift_mm);

/// slicer or firmware, whichever fits clearly better with nozzles at these offsets; nothing where neither does.
///
/// By touching and overlapping; where these do not tell (colours that nowhere meet), by which form has the colours
/// among each other instead of side by side.
std::optional<OffsetsIn> guessed_offsets_in(const GcodePrint& print, const std::vector<Vec2>& nozzle_offset_mm);

/// The offset of each nozzle for which the plastic fits together, where it does not as it stands; empty where no place
/// fits clearly better than all others (the file may be in the firmware's form, and nothing tells where the nozzles
/// are).
///
/// Searched: up to 80 mm along X or Y, up to 1 mm across, in steps of 0.25 mm, each nozzle against nozzle 0.
/// Cost: about 0.5 s for a print of 60 mm; bounded for larger ones, by fewer layers.
std::vector<Vec2> guessed_offsets_mm(const GcodePrint& print);

}  // namespace cleancolor
