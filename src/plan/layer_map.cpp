#include "plan/layer_map.hpp"

#include <algorithm>
#include <cmath>

#include "base/rows.hpp"

namespace cleancolor {
namespace {

constexpr double most_cells = 4e6;
constexpr double block_mm = 0.5;     // visibility changes little over it
constexpr double detail_mm = 0.03;   // of outlines before they are offset
constexpr double overlap_mm = 0.05;  // a border that the layer above lies this close to is covered

}  // namespace

LayerMap::LayerMap(const LayerScene& scene, const SurfaceVisibility& visibility, double cell_mm)
    : box_(bounds_mm(scene.outline)) {
  if (box_.empty()) return;
  const Vec2 size = box_.size();
  while ((size.x / cell_mm + 2) * (size.y / cell_mm + 2) > most_cells) cell_mm *= 1.1;
  per_mm_ = 1 / cell_mm;
  origin_ = box_.min - Vec2{cell_mm, cell_mm};
  columns_ = int(std::ceil(size.x / cell_mm)) + 2;
  rows_ = int(std::ceil(size.y / cell_mm)) + 2;
  cells_.resize(std::size_t(columns_) * std::size_t(rows_));
  const RowPlan plan{origin_.y + cell_mm / 2, cell_mm, rows_};
  const auto for_cells = [&](const Polygons& region, auto visit) {
    const Rows rows(region, plan);
    for (int y = 0; y < rows.count(); ++y)
      for (const Interval& i : rows.row(y)) {
        const auto column = [&](float x) {
          return std::clamp(int(std::ceil((double(x) - origin_.x) * per_mm_ - 0.5)), 0, columns_);
        };
        const std::size_t row = std::size_t(y) * std::size_t(columns_);
        for (int x = column(i.begin_mm); x < column(i.end_mm); ++x) visit(row + std::size_t(x));
      }
  };
  for (std::size_t e = 0; e < scene.regions.size(); ++e)
    for_cells(scene.regions[e], [&](std::size_t i) { cells_[i].extruder = std::uint8_t(e); });
  // Hidden is what lies behind the outermost road and below the next layer.
  std::vector<char> covered(cells_.size());
  const Polygons outline = simplified(scene.outline, detail_mm);
  for_cells(offset(outline, -scene.wall_width_mm), [&](std::size_t i) { covered[i] = 1; });
  for_cells(offset(simplified(scene.above, detail_mm), overlap_mm), [&](std::size_t i) { covered[i] |= 2; });
  see(scene, visibility, covered);
}

void LayerMap::see(const LayerScene& scene, const SurfaceVisibility& visibility, const std::vector<char>& covered) {
  const int block = std::max(1, int(std::lround(block_mm * per_mm_)));
  const int blocks = columns_ / block + 1;
  std::vector<int> known(std::size_t(blocks), -1);
  for (int y = 0; y < rows_; ++y) {
    if (y % block == 0) std::ranges::fill(known, -1);
    for (int x = 0; x < columns_; ++x) {
      const std::size_t i = std::size_t(y) * std::size_t(columns_) + std::size_t(x);
      if (cells_[i].extruder == air || covered[i] == 3) continue;
      int& v = known[std::size_t(x / block)];
      if (v < 0) {
        const Vec2 p = origin_ + Vec2{x + 0.5, y + 0.5} * (1 / per_mm_);
        v = int(std::lround(255 * visibility.at({p.x, p.y, scene.z_mm})));
      }
      cells_[i].visibility = std::uint8_t(v);
    }
  }
}

}  // namespace cleancolor
