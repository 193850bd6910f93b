// audit/voxel_surface.hpp
//
// Voxel surface: the outside of voxels as a smooth mesh of squares, for pictures.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "audit/part_voxels.hpp"

namespace cleancolor {

struct VoxelSurface {
  std::vector<Vec3> vertices_mm;
  std::vector<std::array<std::uint32_t, 4>> quads;  // corners counterclockwise seen from outside
  std::vector<std::uint8_t> nozzle;                 // of each quad
};

/// One quad for each face between plastic and the outside air, in the order of the air's voxels; not the underside that
/// lies on the bed.
///
/// smoothing: how often every vertex moves to the middle of the quads around it; 0: cubes. It moves the surface by less
/// than a voxel.  Source: the relaxed net of Gibson, Constrained elastic surface nets, 1998.
/// Cost: about 0.2 us a face.
VoxelSurface voxel_surface(const Voxels& voxels, int smoothing = 2);

}  // namespace cleancolor
