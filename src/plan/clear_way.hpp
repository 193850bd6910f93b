// plan/clear_way.hpp
//
// Clear way: the carriage's way between two places on which no nozzle hangs over another colour where that can be seen,
// if there is one.
//
// The roadmap's way is nearly always clear. Where it is not, for its places leave a gap out or another way costs less,
// a grid is searched (A*, hurried: a way may be a little dearer than the cheapest): of 0.5 mm, then of 0.25 mm, which
// finds the gaps, and for short hops of 0.08 mm. Whether one end lies in a pocket, the grid of 0.25 mm knows first.
#pragma once

#include <span>
#include <vector>

#include "plan/tour.hpp"

namespace cleancolor {

/// Whether a nozzle hangs over foreign plastic of a visibility above 0.05 on this way of the carriage.
bool crosses(const TravelCost& cost, std::span<const Vec2> way);

/// A cheap clear way on the grid, both ends included; empty: none of at most so many mm was found.
/// Cost: some 2 ms, up to 50 ms where all of the bed must be searched.
std::vector<Vec2> clear_way(const TravelCost& cost, int extruder, Vec2 from_mm, Vec2 to_mm, double longest_mm);

/// The places between of a clear way of at most so many mm; where there is none, of the roadmap's cheapest.
std::vector<Vec2> clearest_way_between(const Roadmap& map, const TravelCost& cost, int extruder, Vec2 from_mm,
                                       Vec2 to_mm, double longest_mm);

}  // namespace cleancolor
