// explain/plan_table.hpp
//
// The plan of a layer as text and as JSON: a row for each run, in printing order, and totals.
#pragma once

#include <string>

#include "explain/explanation.hpp"

namespace cleancolor {

/// A table for people. Extruders, numbers and layers count from 1, zones are letters as in the picture.
std::string plan_text(const Explanation& plan, const GcodePrint& print);

/// The same for programs: one object and a new line.
std::string plan_json(const Explanation& plan, const GcodePrint& print);

/// "A", ..., "Z", "AA", ...
std::string zone_name(int zone);

struct PlanTotals {
  double printed_mm = 0, hops_mm = 0;
  double longest_hop_mm = 0;
  std::size_t hops_over_foreign = 0;  // hops on which a nozzle crosses visible foreign plastic
  std::size_t outer_walls = 0;
  std::size_t visible_starts = 0;  // of outer walls, where more than 0.1 can be seen
  std::size_t nodes = 0, arcs = 0, arcs_over_foreign = 0;
};
PlanTotals totals(const Explanation& plan);

}  // namespace cleancolor
