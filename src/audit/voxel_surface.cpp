#include "audit/voxel_surface.hpp"

#include <bit>
#include <unordered_map>

namespace cleancolor {
namespace {

struct SurfaceCell {
  int x = 0, y = 0, z = 0;
};

/// The way from air to a neighbour of plastic, and the corners of the face between them, as steps from the corner of
/// the air's voxel with the least coordinates; counterclockwise seen from the air.
struct VoxelSide {
  SurfaceCell to;
  std::array<SurfaceCell, 4> corners;
};
constexpr std::array<VoxelSide, 6> sides_of_a_voxel = {{
    {{-1, 0, 0}, {{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}}},
    {{1, 0, 0}, {{{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}}},
    {{0, -1, 0}, {{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}}},
    {{0, 1, 0}, {{{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}}},
    {{0, 0, -1}, {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}},
    {{0, 0, 1}, {{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}}},
}};

/// Vertices by the corner of the grid where they began.
class Vertices {
 public:
  Vertices(const Voxels& voxels, std::vector<Vec3>& at_mm) : voxels_(voxels), at_mm_(at_mm) {}

  std::uint32_t at(SurfaceCell c) {
    const auto [found, added] = index_.try_emplace(voxels_.index(c.x, c.y, c.z), std::uint32_t(at_mm_.size()));
    if (added) at_mm_.push_back(voxels_.origin_mm + Vec3{double(c.x), double(c.y), double(c.z)} * voxels_.size_mm);
    return found->second;
  }

 private:
  const Voxels& voxels_;
  std::vector<Vec3>& at_mm_;
  std::unordered_map<std::int64_t, std::uint32_t> index_;  // looked up only: its order goes nowhere
};

/// Every vertex to the middle of the quads around it.
void relax(VoxelSurface& surface) {
  std::vector<Vec3> sum(surface.vertices_mm.size());
  std::vector<int> quads(sum.size());
  for (const auto& q : surface.quads) {
    Vec3 middle;
    for (const std::uint32_t v : q) middle = middle + surface.vertices_mm[v] * 0.25;
    for (const std::uint32_t v : q) {
      sum[v] = sum[v] + middle;
      ++quads[v];
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) surface.vertices_mm[v] = sum[v] * (1.0 / quads[v]);
}

}  // namespace

VoxelSurface voxel_surface(const Voxels& voxels, int smoothing) {
  VoxelSurface surface;
  Vertices vertices(voxels, surface.vertices_mm);
  for (std::size_t w = 0; w < voxels.solid.size(); ++w)
    for (std::uint64_t bits = voxels.surface(std::int64_t(w)); bits != 0; bits &= bits - 1) {
      const std::int64_t i = std::int64_t(w) * 64 + std::countr_zero(bits);
      const std::int64_t in_plane = i % voxels.plane_bits;
      const SurfaceCell c{int(in_plane % voxels.row_bits), int(in_plane / voxels.row_bits), int(i / voxels.plane_bits)};
      for (const VoxelSide& side : sides_of_a_voxel) {
        const SurfaceCell n{c.x + side.to.x, c.y + side.to.y, c.z + side.to.z};
        if (!voxels.has(n.x, n.y, n.z)) continue;
        const std::int64_t neighbour = voxels.index(n.x, n.y, n.z);
        if (!bit(voxels.solid, neighbour)) continue;
        std::array<std::uint32_t, 4> quad{};
        for (std::size_t k = 0; k < 4; ++k) {
          const SurfaceCell d = side.corners[k];
          quad[k] = vertices.at({c.x + d.x, c.y + d.y, c.z + d.z});
        }
        surface.quads.push_back(quad);
        surface.nozzle.push_back(voxels.nozzle(neighbour));
      }
    }
  for (int k = 0; k < smoothing; ++k) relax(surface);
  return surface;
}

}  // namespace cleancolor
