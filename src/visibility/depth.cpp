#include "visibility/depth.hpp"

#include <algorithm>
#include <cmath>

#include "base/open_rays.hpp"

namespace cleancolor {
namespace {

/// From c to the nearest place of voxel i along one axis.
double nearest_in(double c, int i) {
  return std::clamp(c, double(i), double(i + 1));
}

bool is_blocked(const Voxels& v, const BitWords& opaque, Vec3 from, Vec3 to) {
  if (opaque.empty()) return false;
  // The voxels at both ends may hold some of what is beside them.
  constexpr double ends = 1, step = 0.5;
  const double way = length(to - from);
  for (double s = ends; s < way - ends; s += step) {
    const Vec3 p = from + (to - from) * (s / way);
    if (bit(opaque, v.index(int(p.x), int(p.y), int(p.z)))) return true;
  }
  return false;
}

}  // namespace

BitWords clear_surface(const Voxels& voxels, const BitWords& opaque) {
  BitWords clear(voxels.solid.size()), result(voxels.solid.size());
  for (std::size_t w = 0; w < clear.size(); ++w) clear[w] = voxels.solid[w] & ~opaque[w];
  for (std::size_t w = 0; w < clear.size(); ++w) {
    if (voxels.outside[w] == 0) continue;
    std::uint64_t near = 0;
    for (const std::int64_t shift : {std::int64_t(1), voxels.row_bits, voxels.plane_bits})
      near |= shifted_word(clear, std::int64_t(w), shift) | shifted_word(clear, std::int64_t(w), -shift);
    result[w] = voxels.outside[w] & near;
  }
  return result;
}

std::optional<SurfacePlace> nearest_surface(const Voxels& voxels, const BitWords& surface, const BitWords& opaque,
                                            Vec3 p_mm, double reach_mm) {
  const Vec3 p = (p_mm - voxels.origin_mm) * (1 / voxels.size_mm);
  if (!voxels.has(int(std::floor(p.x)), int(std::floor(p.y)), int(std::floor(p.z)))) return std::nullopt;
  const double reach = reach_mm / voxels.size_mm;
  double least = reach * reach;
  std::optional<Vec3> best;
  const auto off = [](double c, int i) {
    const double d = nearest_in(c, i) - c;
    return d * d;
  };
  // Columns that can be nearer than what is found; a row has few words, so they need not follow the circle.
  VoxelRange x(p.x, reach + 0.5, voxels.columns);
  const auto look_at_row = [&](int y, int z, double squared_yz) {
    bool found = false;
    for_bits(surface, voxels.index(0, y, z), x, [&](int i) {
      const double squared = squared_yz + off(p.x, i);
      if (squared >= least) return;
      least = squared;
      best = Vec3{nearest_in(p.x, i), nearest_in(p.y, y), nearest_in(p.z, z)};
      found = true;
    });
    if (found) x = VoxelRange(p.x, std::sqrt(least) + 0.5, voxels.columns);
  };
  // Planes and rows from the nearest on, downwards and upwards, so that most of them are too far away soon.
  const int y0 = int(p.y), z0 = int(p.z);
  const auto look_at_plane = [&](int z) {
    const double dz = off(p.z, z);
    if (dz >= least) return false;
    for (int y = y0; y >= 0; --y) {
      const double squared = dz + off(p.y, y);
      if (squared >= least) break;
      look_at_row(y, z, squared);
    }
    for (int y = y0 + 1; y < voxels.rows; ++y) {
      const double squared = dz + off(p.y, y);
      if (squared >= least) break;
      look_at_row(y, z, squared);
    }
    return true;
  };
  for (int z = z0; z >= 0 && look_at_plane(z);) --z;
  for (int z = z0 + 1; z < voxels.levels && look_at_plane(z);) ++z;
  if (!best || is_blocked(voxels, opaque, p, *best)) return std::nullopt;
  return SurfacePlace{voxels.origin_mm + *best * voxels.size_mm, std::sqrt(least) * voxels.size_mm};
}

}  // namespace cleancolor
