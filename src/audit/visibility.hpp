// audit/visibility.hpp
//
// PrintedVisibility: how plainly each place of the printed part can be seen, from the printed material alone.
//
//   roads of the part, all layers  ->  value in [0, 1] at any point of its surface
//
// 1: nothing hides it; 0: buried. The share of the open half sphere above the surface that reaches the outside within
// 25 mm, all directions counting alike; the bed is opaque. Auxiliary plastic hides nothing: it is thrown away.
//
// From the middle of every voxel of outside air that touches plastic, 96 rays go out; a point takes the mean of those
// around it, twice: a surface hides half of the sphere by itself. The directions are fixed, whole numbers of voxels in
// 8 steps, and symmetric to all axes, planes and diagonals of the grid; so all voxels follow one direction at once, 64
// to a word, and a ray of 2 n steps is one of n steps and one of n steps behind it.
// Error: at flat walls, slopes and corners of any angle, mean below 0.03 and RMS about 0.05 (tests and
// bench/visibility_bench.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "audit/voxels.hpp"
#include "base/progress.hpp"
#include "base/vec.hpp"

namespace cleancolor {

struct VisibilityOptions {
  double voxel_mm = 0.5;  // of the rays; larger where the part would need too many
  double fine_mm = 0.25;  // of the voxels that show which roads are bare; likewise
  double reach_mm = 25;
};

class PrintedVisibility {
 public:
  /// layer(i): the roads of layer i, ascending; called once for each, from several threads.
  /// Same values for any number of threads.  Requires: finite roads; options > 0.
  /// Cost: 1 s of CPU for about 3 10^8 voxels of the part's box (with 25 mm of air at two sides), and 60 ns a road;
  /// memory: 24 bytes a road, and about 1 byte a voxel; at most 150 MB.
  PrintedVisibility(int layers, const PartLayers& layer, const VisibilityOptions& options, int threads,
                    const Progress& progress = {});
  ~PrintedVisibility();
  PrintedVisibility(PrintedVisibility&&) noexcept;

  /// At a point of the surface (within a voxel or so); 0 deep inside the part, and 1 far away from it.
  double at(Vec3 p_mm) const;

  /// The faces of the printed part that look outside, for pictures: see audit/sides.hpp.
  struct Face {
    std::array<Vec3, 4> corners_mm;  // counterclockwise seen from outside
    std::uint8_t nozzle = 0;
  };
  std::vector<Face> faces() const;

  double voxel_mm() const;

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

}  // namespace cleancolor
