// toolpath/perimeters.hpp
//
// Perimeters: the loops along the outline of one island, and what they leave for the infill.
//
//   island, roads  ->  closed paths from the innermost to the outermost, region to fill
//
// The outermost loop runs half its width inside the outline; each further one lies a spacing further in. A loop is laid
// only where its neighbours leave room for it; what is too narrow is left to thin walls and gap fill.
#pragma once

#include "base/polygon.hpp"
#include "toolpath/path.hpp"
#include "toolpath/roads.hpp"

namespace cleancolor {

struct PerimeterOptions {
  int count = 2;
  bool external_first = false;
  bool thin_walls = true;  // walls narrower than one road get one road of their own width
  bool gap_fill = true;    // so do gaps between loops
  double nozzle_diameter_mm = 0.4;
  LengthOrShare infill_overlap = {0.25, true};
  LengthOrShare small_perimeter_speed = {15, false};
};

struct Shell {
  std::vector<Path> paths;  // in printing order: inner loops before outer, unless external_first
  Polygons fill;            // what infill must cover; its roads may touch this border with their outer edge
};

/// overhang: where nothing lies below this island; loops are printed as bridges there.
/// Cost: about three offsets a loop.
Shell perimeters(const Island& island, const Polygons& overhang, const Roads& roads, const PerimeterOptions& options);

/// Turns the part of a loop that runs inside `overhang` into an overhang road; the loop stays one path.
void mark_overhangs(Path& loop, const Polygons& overhang, const Road& road);

}  // namespace cleancolor
