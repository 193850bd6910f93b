#include "audit/visibility.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/open_rays.hpp"

namespace cleancolor {

struct PrintedVisibility::Grid {
  Voxels fine;          // shows which roads are bare
  double depth_mm = 0;  // of the centre line of a bare road below the fine air
  OpenRays rays;        // through coarser voxels

  std::optional<Vec3> next_air(Vec3 p_mm) const;
};

/// The point itself where it lies in the air, else the middle of the nearest fine voxel of air if that is near enough.
std::optional<Vec3> PrintedVisibility::Grid::next_air(Vec3 p_mm) const {
  const Vec3 p = (p_mm - fine.origin_mm) * (1 / fine.size_mm);
  const double inside = std::min({p.x, p.y, p.z, fine.columns - p.x, fine.rows - p.y, fine.levels - p.z});
  if (!(inside > 0) || bit(fine.outside, fine.index(int(p.x), int(p.y), int(p.z)))) return p_mm;
  const double reach = depth_mm / fine.size_mm;
  const VoxelRange x(p.x, reach, fine.columns), y(p.y, reach, fine.rows), z(p.z, reach, fine.levels);
  double best = reach * reach;
  std::optional<Vec3> found;
  for (int k = z.first; k <= z.last; ++k)
    for (int j = y.first; j <= y.last; ++j)
      for_bits(fine.outside, fine.index(0, j, k), x, [&](int i) {
        const Vec3 middle{i + 0.5, j + 0.5, k + 0.5};
        const double d = dot(middle - p, middle - p);
        if (d > best || (found && d == best)) return;
        best = d;
        found = middle;
      });
  if (found) found = *found * fine.size_mm + fine.origin_mm;
  return found;
}

PrintedVisibility::PrintedVisibility(int layers, const PartLayers& layer, const VisibilityOptions& options, int threads,
                                     const Progress& progress) {
  Voxels fine, coarse;
  double depth_mm = 0;
  {
    const PartRoads part = part_roads(layers, layer, threads, progress);
    fine = part_voxels(part, {.size_mm = options.fine_mm, .most = 2e8}, false, threads, progress);
    // Further away than its own half and a good voxel is the air only where another road lies in front of this one.
    depth_mm = part.mean_width_mm / 2 + 1.25 * fine.size_mm;
    fine.solid = {};
    coarse = part_voxels(part, {.size_mm = options.voxel_mm, .reach_mm = options.reach_mm, .most = 6e7}, true, threads,
                         progress);
  }
  grid_ = std::make_unique<Grid>(std::move(fine), depth_mm,
                                 OpenRays(std::move(coarse), options.reach_mm, threads, progress));
}

PrintedVisibility::~PrintedVisibility() = default;
PrintedVisibility::PrintedVisibility(PrintedVisibility&&) noexcept = default;

double PrintedVisibility::voxel_mm() const {
  return voxels().size_mm;
}

double PrintedVisibility::at(Vec3 p_mm) const {
  if (voxels().levels == 0) return 1;
  const std::optional<Vec3> air_mm = grid_->next_air(p_mm);
  return air_mm ? grid_->rays.at(*air_mm) : 0;
}

double PrintedVisibility::at(Vec3 p_mm, Vec2 a_mm, Vec2 b_mm) const {
  const Vec2 q = nearest_on_segment(a_mm, b_mm, {p_mm.x, p_mm.y});
  return at({q.x, q.y, p_mm.z});
}

const Voxels& PrintedVisibility::voxels() const {
  return grid_->rays.voxels();
}

}  // namespace cleancolor
