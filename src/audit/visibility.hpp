// audit/visibility.hpp
//
// PrintedVisibility: how plainly each place of the printed part can be seen, from the printed material alone.
//
//   roads of the part, all layers  ->  value in [0, 1] at any point of its surface
//
// 1: nothing hides it; 0: buried. The share of the open half sphere above the surface that reaches the outside within
// 25 mm, all directions counting alike; the bed is opaque. Auxiliary plastic hides nothing: it is thrown away.
//
// Rays go through voxels (base/open_rays.hpp).
//
// Finer voxels tell whether a road has air beside it or another road in front: the wall of one colour behind a single
// line of the other is buried, though no voxel of the rays lies between them.
//
// On real prints the mean over all outer walls is 3 to 5 % higher than with voxels of 0.2 and 0.125 mm.
#pragma once

#include <memory>

#include "audit/part_voxels.hpp"
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
  /// Cost: about 0.3 us a road and 20 ms of CPU for 10^6 voxels of the part's box with 25 mm of air at two of its
  /// sides; memory: 24 bytes a road, and up to 150 MB.
  PrintedVisibility(int layers, const PartLayers& layer, const VisibilityOptions& options, int threads,
                    const Progress& progress = {});
  ~PrintedVisibility();
  PrintedVisibility(PrintedVisibility&&) noexcept;

  /// At a point of the surface: on the centre line of a road, at the height of its layer. 0 where another road lies
  /// between it and the air, also deep inside the part; 1 far away from the part.
  ///
  /// Cost: about 0.3 us.
  double at(Vec3 p_mm) const;

  /// Of the road a -> b at a point p over it: at the point of its centre line beside p. The far side of a wall, asked
  /// by itself, would count as buried.
  double at(Vec3 p_mm, Vec2 a_mm, Vec2 b_mm) const;

  /// The voxels that the rays go through, for pictures.
  const Voxels& voxels() const;

  double voxel_mm() const;

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

}  // namespace cleancolor
