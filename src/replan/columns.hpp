// replan/columns.hpp
//
// Columns: parts that stand apart from each other on the bed.
//
//   layers, what counts as apart  ->  the layers of the one column that a rampart is shortest around
//
// A column is what lies in one box seen from above; boxes that come too near to each other are one.
#pragma once

#include <optional>
#include <vector>

#include "slice/slices.hpp"

namespace cleancolor {

/// The box of each column in plan view, mm, in no order: what is closer than that to each other is one.
std::vector<Box<Vec2>> columns(const Slices& slices, double apart_mm);

/// The same slices with the outlines of one column alone: of those that go up to the last layer the one with the
/// shortest outlines. Nothing where all is one column, or none goes up so far. Regions stay those of the whole print.
std::optional<Slices> shortest_column(const Slices& slices, double apart_mm);

/// The same slices without the outlines of columns in which none of the part's ever is, as a wipe tower's.
/// Requires: the part's outlines lie in those of the slices.
Slices without_columns_beside(const Slices& slices, const Slices& part, double apart_mm);

}  // namespace cleancolor
