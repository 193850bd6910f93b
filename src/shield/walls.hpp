// shield/walls.hpp
//
// Walls: the rampart's centre lines of one layer as paths, each with the extruder that prints it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/polygon.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

struct WallPrinter {
  int extruder = 0;
  Road road;
};

/// Closed paths, wall k by printers[k]; several of one wall where objects stand apart. Requires: a printer for each.
std::vector<Path> wall_paths(std::span<const Polygons> walls, std::span<const WallPrinter> printers);

/// One wall for two: of each ring printers[0] prints what lies further than its middle in the direction of `to_second`,
/// printers[1] the other half; so the idle nozzle hovers beside the part, and the half that stands first is the one
/// that the other nozzle must cross. to_second: the second nozzle as seen from the first. The halves overlap by 1 mm; a
/// ring smaller than that is one closed path of the first.  Requires: to_second not zero.
std::vector<Path> half_wall_paths(const Polygons& wall, const std::array<WallPrinter, 2>& printers, Vec2 to_second);

/// Loops around each wall, on its outer side, from the inside out: up to width_mm around the outermost, up to half of
/// gap_mm, the distance to the next wall, around the others. The idle nozzle, full since the heaters are on, so crosses
/// the inner ones before the outermost bring it nearest to the place of another colour.
/// Requires: spacing_mm > 0, the distance of neighbouring roads.
std::vector<Path> wall_brims(std::span<const Polygons> walls, std::span<const WallPrinter> printers, double width_mm,
                             double gap_mm, double spacing_mm);

/// The same around the one wall of two, each loop cut into halves as the wall is: no idle nozzle hovers over the part.
std::vector<Path> half_wall_brims(const Polygons& wall, const std::array<WallPrinter, 2>& printers, double width_mm,
                                  double spacing_mm, Vec2 to_second);

}  // namespace cleancolor
