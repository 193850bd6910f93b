// visibility/depth.hpp
//
// Depth: how far below the surface a place inside the part lies, where light passes the plastic between.
#pragma once

#include <optional>
#include <span>

#include "base/voxels.hpp"

namespace cleancolor {

/// Air that touches plastic which is not opaque, bit by bit as voxels.solid.
BitWords clear_surface(const Voxels& voxels, const BitWords& opaque);

struct SurfacePlace {
  Vec3 at_mm;
  double depth_mm = 0;
};

/// The place of the surface nearest to p, at most reach_mm away; nothing where there is none, or where the straight way
/// there leads through opaque plastic.  opaque: empty, or a bit for each voxel.
/// Error: up to half a voxel where the surface lies between two. Of equally near ones the first in a fixed order.
/// Requires: reach_mm < 31 voxels.  Cost: 2 us for a reach of 20 voxels.
std::optional<SurfacePlace> nearest_surface(const Voxels& voxels, const BitWords& surface, const BitWords& opaque,
                                            Vec3 p_mm, double reach_mm);

}  // namespace cleancolor
