// audit/voxels.hpp
//
// Voxels: the printed part as cubes, and which of them look outside.
//
//   roads of the part, all layers  ->  plastic, the air that reaches the outside, nozzle of each voxel
//
// Every layer lies in the level of voxels that holds its middle, and in those whose middle it holds: no level inside a
// wall is left out, none is filled twice as high as it is. Air inside closed walls (sparse infill) is not outside.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "audit/bit_grid.hpp"
#include "base/progress.hpp"
#include "base/vec.hpp"

namespace cleancolor {

struct PartRoad {
  Vec2 a_mm, b_mm;
  float width_mm = 0;
  std::uint8_t nozzle = 0;
};

struct PartLayer {
  double bottom_mm = 0, top_mm = 0;
  std::vector<PartRoad> roads;
};

/// Calls for layer i come from several threads.
using PartLayers = std::function<PartLayer(int)>;

/// All roads of a part in 24 bytes each, kept while grids are made of them.
struct PartRoads {
  struct Road {
    float ax_mm, ay_mm, bx_mm, by_mm, half_width_mm;
    std::uint8_t nozzle;
  };
  struct Layer {
    double bottom_mm = 0, top_mm = 0;
    std::vector<Road> roads;
  };
  std::vector<Layer> layers;
  Box<Vec2> box;             // with the width of the roads; empty where there is none
  double top_mm = 0;         // of the highest layer
  double mean_width_mm = 0;  // by length
  std::uint8_t last_nozzle = 0;
};

/// Requires: finite.
PartRoads part_roads(int layers, const PartLayers& layer, int threads, const Progress& progress = {});

struct VoxelOptions {
  double size_mm = 0.5;
  double reach_mm = 0;   // so much air behind rows and planes
  double most = 1e8;     // larger voxels where the part would need more
  bool nozzles = false;  // whether to keep the nozzle of each
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
  bool has(int x, int y, int z) const { return x >= 0 && y >= 0 && z >= 0 && x < columns && y < rows && z < levels; }
  std::uint8_t nozzle(std::int64_t i) const;
  /// Air of the outside that shares a face with plastic, of the word w.
  std::uint64_t surface(std::int64_t w) const;
};

/// No roads: no voxels (levels = 0). The nozzle of a voxel is that of the road last drawn there: layers ascending,
/// roads in their order.  Cost: about 40 ns a road, and 0.5 ms for 10^6 voxels.
Voxels voxels(const PartRoads& part, const VoxelOptions& options, int threads, const Progress& progress = {});

}  // namespace cleancolor
