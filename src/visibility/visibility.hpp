// visibility/visibility.hpp
//
// Visibility: how plainly each place of the part's surface can be seen.
//
//   outlines of each layer  ->  value in [0, 1] at any point of the surface
//
// 1: nothing hides it; 0: buried, as are the faces where two colours touch, for the outlines are those of all colours
// together. The share of the open half sphere that reaches the outside within 25 mm; the bed is opaque. Where it is
// said from where the print is looked at, rays that lead away from there count less: in the open, a wall on that side
// has 1, the one opposite 1 - weight, those between and tops 1 - weight / 2.
//
// Light passes translucent plastic: inside, the value of the nearest place of the surface x exp(-depth / translucency).
//
// The paper computes ambient occlusion of the meshes; here rays go through voxels of the layers (base/open_rays.hpp):
// as exact as some 16 rays a point through meshes, ten times as fast, whole numbers only, and it asks for no mesh.
// Source: Hergel and Lefebvre, Clean color, section 6.1.
#pragma once

#include <span>

#include "base/open_rays.hpp"
#include "base/packed_polygons.hpp"
#include "base/progress.hpp"

namespace cleancolor {

struct SurfaceVisibilityOptions {
  double voxel_mm = 0.5;  // larger where the part would need too many
  double reach_mm = 25;
  int threads = 1;
  ViewBias view = {};
  std::span<const PackedPolygons> opaque =
      {};  // of each layer: where light does not pass; empty: below() is not asked for
};

class SurfaceVisibility {
 public:
  /// outlines: of the part, one for each layer from the bed up; height_mm: of each layer.
  /// Cost: 1 ms a layer and 20 ms of CPU for 10^6 voxels of the part's box; memory: up to 100 MB, with options.opaque
  /// 16 more. Same values for any number of threads.  Throws Error where progress is interrupted.
  SurfaceVisibility(std::span<const PackedPolygons> outlines, std::span<const double> height_mm,
                    const SurfaceVisibilityOptions& options = {}, const Progress& progress = {});

  /// At a point on or up to 0.8 mm below the surface; deeper 0, far away from the part 1.  Cost: about 0.2 us.
  double at(Vec3 p_mm) const { return rays_.at(p_mm); }

  /// At a point inside plastic of this translucency; 0 more than 10 mm below the surface, or behind opaque plastic.
  /// Requires: options.opaque was given; translucency_mm > 0.
  /// Error: the depth is that below the voxels, half of one off at most.  Cost: about 1 us.
  double below(Vec3 p_mm, double translucency_mm) const;

 private:
  OpenRays rays_;
  BitWords opaque_, clear_surface_;
};

}  // namespace cleancolor
