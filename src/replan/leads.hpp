// replan/leads.hpp
//
// Leads: short strokes inside the part, up to the start of an outer wall, that make up for what oozed out on the way.
//
//   layer in printing order, regions of its nozzles  ->  the same with a refill before outer walls
//
// An outer wall that begins after a way lacks at its start what oozed out on it. Where a loop lies inside it, that is
// printed first, begun beside it, so that it lacks that, and the nozzle goes over without a stop. The other walls it
// comes to from inside. Either way it pushes on the stroke as much as is forecast to be missing (Role::refill), no more
// than the wall would take there; the loops stay as they are. Such a stroke is of its wall's island, which tells it
// from refills beside a rampart.
#pragma once

#include <optional>
#include <vector>

#include "base/polygon.hpp"
#include "plan/ooze_forecast.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

struct LeadOptions {
  OozeModel ooze;
  std::vector<HopTime> hop;  // of each extruder
};

/// The stroke from where the inner loop ends to where the outer one begins; nothing where they are in one place.
/// gap_mm: between the inner loop's ends.
std::optional<Path> stroke_between(const Path& inner, double gap_mm, const Path& outer, const LeadOptions& options);

/// regions: of each extruder's plastic in the layer. from: the path printed before the layer, nullptr where none is.
/// Walls that a loop inside goes over into (Path::inner_source) stay as they are.
/// Cost: the loops of its island once for each other wall.
Layer with_leads(Layer layer, const std::vector<Polygons>& regions, const Path* from, const LeadOptions& options);

}  // namespace cleancolor
