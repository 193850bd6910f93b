// audit/part_voxels.hpp
//
// Part voxels: the printed part as cubes.
//
//   roads of the part, all layers  ->  plastic, the air that reaches the outside, nozzle of each voxel
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/progress.hpp"
#include "base/vec.hpp"
#include "base/voxels.hpp"

namespace cleancolor {

/// What is told wider is an error of the file, and would only cost time.
inline constexpr double widest_road_mm = 20;

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

/// No roads: no voxels (levels = 0). The nozzle of a voxel, where asked for, is that of the road last drawn there:
/// layers ascending, roads in their order.  Cost: about 40 ns a road, and 0.5 ms for 10^6 voxels.
Voxels part_voxels(const PartRoads& part, const VoxelOptions& options, bool nozzles, int threads,
                   const Progress& progress = {});

}  // namespace cleancolor
