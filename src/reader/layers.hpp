// reader/layers.hpp
//
// Layers and roads: which height every move belongs to, and how wide the roads are.
#pragma once

#include "reader/print.hpp"

namespace cleancolor {

/// Fills GcodePrint::layers, and layer, width and height of its moves.
///
/// A height is where plastic is laid along X or Y; heights closer than 0.02 mm are one. A move that lays plastic
/// belongs to its own height. One that does not belongs to the layer of the plastic laid next from where it, or a move
/// before it, ends at or above that layer's height, or if that layer is not higher; else to the layer of the plastic
/// laid last; so hops stay in their layer.
/// Rising moves (vase mode): bands of the usual layer height above the flat layer below, or the flat layer above where
/// that is less than a layer away (scarf seams).
/// Height of a layer: as the file tells it of its part (bridges left out), else of other plastic, else the difference
/// to the next lower layer that has part plastic, or to the bed.
/// A width that the file does not tell follows from amount and height: area = h (w - h (1 - pi/4)); a road of less area
/// than a circle of its height is a round strand.
/// Requires: moves and tools are filled; told heights and widths, if any, stand in the moves.
/// Cost: linear in the number of moves; sorting of the heights.  Memory: 8 bytes a change of height, and the layers.
void assign_layers(GcodePrint& print, const std::vector<double>& filament_area_mm2);

}  // namespace cleancolor
