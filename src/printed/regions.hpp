// printed/regions.hpp
//
// Regions: what each nozzle's roads of a layer enclose, as the slicer's regions were before they became roads.
//
//   roads  ->  plastic of the walls, and what lies between them where other roads of the same nozzle fill it
//
// A hole in the plastic of the outer walls belongs to the region where inner roads run in it, be they far apart; else
// it is air, or another colour's. Files that do not say which roads are outer walls: the plastic of all roads.
#pragma once

#include <span>

#include "base/polygon.hpp"
#include "printed/printed_layer.hpp"

namespace cleancolor {

/// What a nozzle covers that goes straight from a to b; round at both ends, a regular polygon there.
/// Requires: width_mm > 0.
Ring stadium(Vec2 a, Vec2 b, double width_mm);

/// The plastic of the roads. Ways are followed up to detail_mm.
Polygons plastic(std::span<const LaidRoad> roads, double detail_mm = 0.01);

/// The region of one nozzle's part; auxiliary plastic is left out.
/// Cost: some 20 ms for 1000 outer roads at 0.01 mm, 1 ms a layer at 0.1 mm.
Polygons region(std::span<const LaidRoad> roads, int nozzle, double detail_mm = 0.01);

/// Of the places' distances to the region's border.  Requires: there is one, and the region has a border.
double median_depth_mm(std::span<const Vec2> places, const Polygons& region);

/// Whether any of them is the part's.
bool has_part(std::span<const LaidRoad> roads);

}  // namespace cleancolor
