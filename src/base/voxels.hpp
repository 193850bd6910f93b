// base/voxels.hpp
//
// Voxels: a part as cubes, and which of them look outside.
//
// Whoever draws plastic into them says what it is made of: roads (audit/part_voxels.hpp), or regions of layers
// (visibility/). Air inside closed walls is not outside.
#pragma once

#include <cstdint>
#include <vector>

#include "base/bit_grid.hpp"
#include "base/progress.hpp"
#include "base/vec.hpp"

namespace cleancolor {

struct VoxelOptions {
  double size_mm = 0.5;
  double reach_mm = 0;  // so much air behind rows and planes
  double most = 1e8;    // larger voxels where the part would need more
};

/// Levels [first, last].
struct LevelRange {
  int first = 0, last = -1;
};

struct Voxels {
  Vec3 origin_mm;  // corner of voxel (0, 0, 0); z = 0 is the bed
  double size_mm = 0;
  int columns = 0, rows = 0, levels = 0;  // with one empty voxel around the part, but for below
  std::int64_t row_bits = 0;              // longer than columns by as much as a ray reaches; likewise the planes
  std::int64_t plane_bits = 0;            // a multiple of 64
  BitWords solid;
  BitWords outside;                     // air that is connected with the air around the part
  std::vector<BitWords> nozzle_digits;  // binary digits of the nozzle of each solid voxel

  std::int64_t index(int x, int y, int z) const { return x + row_bits * y + plane_bits * z; }
  /// Levels of one layer: the one that holds its middle, and those whose middle it holds, so that no level inside a
  /// wall is left out and none is filled twice as high as it is.
  LevelRange levels_of(double bottom_mm, double top_mm) const;
  bool has(int x, int y, int z) const { return x >= 0 && y >= 0 && z >= 0 && x < columns && y < rows && z < levels; }
  std::uint8_t nozzle(std::int64_t i) const;
  /// Air of the outside that shares a face with plastic, of the word w.
  std::uint64_t surface(std::int64_t w) const;
};

/// Without plastic, around a part with this box and height; voxels as large as they must be.
Voxels empty_voxels(const Box<Vec2>& box_mm, double top_mm, const VoxelOptions& options);

/// Fills `outside`: the air that reaches the empty ends of rows and planes, or the topmost level.
/// Cost: some 0.2 ms for 10^6 voxels.
void find_outside(Voxels& voxels);

}  // namespace cleancolor
