// reader/layers.hpp
//
// Layers and roads: which height every move belongs to, and how wide the roads are.
#pragma once

#include "reader/print.hpp"

namespace cleancolor {

/// Fills GcodePrint::layers, and layer, width and height of its moves.
///
/// A height is where plastic is laid along X or Y; heights closer than 0.02 mm are one. A move that lays plastic
/// belongs to its own height. One that does not belongs to the layer of the plastic laid next if it ends at or above
/// that layer's height or that layer is lower, else to the layer of the plastic laid last; so hops stay in their layer.
/// Rising moves (vase mode): bands of the usual layer height.
/// A width that the file does not tell follows from amount and height: area = h (w - h (1 - pi/4)).
/// Requires: moves and tools are filled; told heights and widths, if any, stand in the moves.
/// Cost: linear in the number of moves; sorting of the heights.
void assign_layers(GcodePrint& print, const std::vector<double>& filament_area_mm2);

}  // namespace cleancolor
