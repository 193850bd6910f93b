// toolpath/bridges.hpp
//
// Bridges: the direction in which lines over a gap rest on something at both ends.
#pragma once

#include <optional>

#include "base/polygon.hpp"

namespace cleancolor {

/// The angle (radians, in [0, pi)) at which the largest share of lines across `gap` has `below` under both ends; of
/// equals, that of the shortest spans, then the smallest. Nothing where no line rests on both sides.
///
/// gap: one island of what hangs in the air.  Cost: 36 angles x lines 1 mm apart x edges of below.
std::optional<double> bridge_angle_rad(const Polygons& gap, const Polygons& below);

}  // namespace cleancolor
