// model/triangulate.hpp
//
// A flat polygon in space, cut into triangles.
#pragma once

#include <span>
#include <vector>

#include "base/vec.hpp"
#include "model/mesh.hpp"

namespace cleancolor {

/// corners.size() - 2 triangles over the corners, in their sense of rotation: ears cut off one after another.
///
/// Seen along the mean normal. Where no ear is found (a polygon that crosses itself or has no area), or where looking
/// for ears takes more than 200 tests of a point for each corner, the rest becomes a fan: still closed, its overlaps
/// cancel.  Requires: at least three corners.  Cost: quadratic for small polygons, linear for large ones.
std::vector<Triangle> triangulated(std::span<const Vec3> corners);

}  // namespace cleancolor
