// shield/rampart.hpp
//
// Rampart: walls around the part that wipe nozzles before they reach it, and in which nozzles refill.
//
//   outlines of each layer  ->  centre lines of each wall, layer by layer
//
// Wall 0 stands distance_mm around the part's silhouette, without its holes; each further wall gap_mm further out. The
// room between two walls is a corridor. A vertical rampart is the same in all layers. A conforming one follows the
// part:
//
//   down: a layer's region is the part grown by distance_mm, and what carries the region above: that one shrunk by one
//         overhang step, as long as an island stays one, holds a disc of 3 mm and stays near its old outline; else as
//         is
//   up:   and what carries a region that shrinks faster than one step a layer: the region below shrunk by one step
//
// so that every wall rests on the wall below and the lowest on the bed.
// Source: Hergel and Lefebvre, Clean color, section 5; conforming walls are an extension.
#pragma once

#include <span>
#include <vector>

#include "base/packed_polygons.hpp"

namespace cleancolor {

struct RampartOptions {
  bool conforming = true;
  bool stands = true;            // of conforming walls; false: each layer for itself, as if there were no others
  int walls = 2;                 // one for each extruder
  double distance_mm = 2;        // from the part to the centre line of wall 0
  double gap_mm = 4;             // from wall to wall, centre lines
  double line_width_mm = 0.4;    // of the walls
  double max_overhang_deg = 45;  // from the vertical
  int threads = 1;
};

/// By how much a wall may lie beside the wall below: layer height x tan(max_overhang), at most half a line.
double overhang_step_mm(double layer_height_mm, const RampartOptions& options);

struct Rampart {
  /// [layer][wall]: regions without holes, disjoint, whose borders are the centre lines; counterclockwise rings.
  std::vector<std::vector<PackedPolygons>> walls;
};

/// outlines: of the part, one for each layer that the rampart goes up to; height_mm: of each layer.
/// In each layer no point of a wall is closer than distance_mm to the part; points closer than 0.02 mm to the line
/// between their neighbours are left out.  Cost: some 2 ms a layer and wall, on one thread.
Rampart rampart(std::span<const PackedPolygons> outlines, std::span<const double> height_mm,
                const RampartOptions& options);

}  // namespace cleancolor
