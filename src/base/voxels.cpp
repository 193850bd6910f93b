#include "base/voxels.hpp"

#include <algorithm>
#include <cmath>

namespace cleancolor {

Voxels empty_voxels(const Box<Vec2>& box_mm, double top_mm, const VoxelOptions& options) {
  Voxels v;
  for (double size = options.size_mm;; size *= 1.05) {
    const double air = 2 + std::ceil(options.reach_mm / size);
    const Vec2 box = box_mm.size();
    const double columns = std::ceil(box.x / size) + 3, rows = std::ceil(box.y / size) + 3;
    const double levels = std::ceil(top_mm / size) + 2;
    if ((columns + air) * (rows + air) * levels > std::max(options.most, 1e4)) continue;
    v.size_mm = size;
    v.columns = int(columns), v.rows = int(rows), v.levels = int(levels);
    v.row_bits = v.columns + std::int64_t(air);
    v.plane_bits = (v.row_bits * (v.rows + std::int64_t(air)) + 63) / 64 * 64;
    break;
  }
  v.origin_mm = {box_mm.min.x - v.size_mm, box_mm.min.y - v.size_mm, 0};
  const std::size_t words = std::size_t(v.plane_bits / 64 * v.levels);
  v.solid.resize(words);
  v.outside.resize(words);
  return v;
}

void find_outside(Voxels& v) {
  const std::int64_t top = std::int64_t(v.levels - 1) * v.plane_bits;
  fill_bits(v.outside, top, top + v.plane_bits - 1, true);
  for (int z = 0; z < v.levels - 1; ++z) {
    const std::int64_t plane = z * v.plane_bits;
    for (int y = 0; y < v.rows; ++y)
      fill_bits(v.outside, plane + y * v.row_bits + v.columns - 1, plane + (y + 1) * v.row_bits - 1, true);
    fill_bits(v.outside, plane + v.rows * v.row_bits, plane + v.plane_bits - 1, true);
  }
  flood(v.outside, v.solid, v.row_bits, v.plane_bits);
}

std::uint8_t Voxels::nozzle(std::int64_t i) const {
  int n = 0;
  for (std::size_t d = 0; d < nozzle_digits.size(); ++d) n |= int(bit(nozzle_digits[d], i)) << d;
  return std::uint8_t(n);
}

std::uint64_t Voxels::surface(std::int64_t w) const {
  const std::uint64_t air = outside[std::size_t(w)];
  if (air == 0) return 0;
  std::uint64_t near = 0;
  for (const std::int64_t shift : {std::int64_t(1), row_bits, plane_bits})
    near |= shifted_word(solid, w, shift) | shifted_word(solid, w, -shift);
  return air & near;
}

LevelRange Voxels::levels_of(double bottom_mm, double top_mm) const {
  const auto level = [&](double z_mm) { return int(std::clamp(std::floor(z_mm / size_mm), 0., levels - 2.)); };
  const int middle = level((bottom_mm + top_mm) / 2);
  // The middle of level k is at (k + 0.5) sizes.
  return {std::min(middle, level(bottom_mm + size_mm / 2)), std::max(middle, level(top_mm + size_mm / 2) - 1)};
}

}  // namespace cleancolor
