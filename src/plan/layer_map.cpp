#include "plan/layer_map.hpp"

#include <algorithm>
#include <cmath>

#include "base/rows.hpp"

namespace cleancolor {
namespace {

constexpr double most_map_cells = 4e6;
constexpr double block_mm = 0.5;     // visibility changes little over it
constexpr double detail_mm = 0.03;   // of outlines before they are offset
constexpr double overlap_mm = 0.05;  // a border that the layer above lies this close to is covered

}  // namespace

LayerMap::LayerMap(const LayerScene& scene, std::span<const Path> walls, const SurfaceVisibility& visibility,
                   double cell_mm)
    : box_(bounds_mm(scene.outline)) {
  for (const Path& wall : walls)
    for (const Vec2 p : wall.points) box_.add(p);
  if (box_.empty()) return;
  const Vec2 size = box_.size();
  while ((size.x / cell_mm + 2) * (size.y / cell_mm + 2) > most_map_cells) cell_mm *= 1.1;
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
  // More than can be told apart count as the last.
  for (std::size_t w = 0; w < walls.size(); ++w) draw(walls[w], std::uint8_t(std::min<std::size_t>(w + 1, 255)));
}

/// A line as wide as three cells.
void LayerMap::draw(const Path& wall, std::uint8_t index) {
  const double step_mm = 0.8 / per_mm_;
  for (std::size_t i = 0; i < wall.segments(); ++i) {
    const Vec2 a = wall.points[i], b = wall.points[(i + 1) % wall.points.size()];
    const int steps = int(distance(a, b) / step_mm) + 1;
    for (int k = 0; k <= steps; ++k) {
      const Vec2 p = (lerp(a, b, double(k) / steps) - origin_) * per_mm_;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int x = std::clamp(int(p.x) + dx, 0, columns_ - 1), y = std::clamp(int(p.y) + dy, 0, rows_ - 1);
          Cell& cell = cells_[std::size_t(y) * std::size_t(columns_) + std::size_t(x)];
          if (cell.extruder == air) cell.wall = index;
        }
    }
  }
}

void LayerMap::see(const LayerScene& scene, const SurfaceVisibility& visibility, const std::vector<char>& covered) {
  const int block = std::max(1, int(std::lround(block_mm * per_mm_)));
  const int blocks = columns_ / block + 1;
  // Of each block: at its surface, and below that in the plastic of each extruder.
  std::vector<int> known(std::size_t(blocks) * (1 + scene.translucency_mm.size()), -1);
  for (int y = 0; y < rows_; ++y) {
    if (y % block == 0) std::ranges::fill(known, -1);
    for (int x = 0; x < columns_; ++x) {
      const std::size_t i = std::size_t(y) * std::size_t(columns_) + std::size_t(x), e = cells_[i].extruder;
      if (e == air) continue;
      const bool is_below = covered[i] == 3;
      if (is_below && (e >= scene.translucency_mm.size() || scene.translucency_mm[e] <= 0)) continue;
      int& v = known[std::size_t(x / block) + (is_below ? (1 + e) * std::size_t(blocks) : 0)];
      if (v < 0) {
        const Vec2 at = origin_ + Vec2{x + 0.5, y + 0.5} * (1 / per_mm_);
        const Vec3 p{at.x, at.y, scene.z_mm};
        v = int(std::lround(255 * (is_below ? visibility.below(p, scene.translucency_mm[e]) : visibility.at(p))));
      }
      cells_[i].visibility = std::uint8_t(v);
    }
  }
}

}  // namespace cleancolor
