#include "plan/laid_walls.hpp"

#include "plan/ooze_forecast.hpp"

namespace cleancolor {
namespace {

constexpr double most_wall_cells = 4e6;

bool is_outer_wall(const Path& path) {
  return path.depth == 0;
}

}  // namespace

LaidWalls::LaidWalls(std::span<const Path> paths) {
  Box<Vec2> box;
  for (const Path& path : paths)
    if (is_outer_wall(path))
      for (const Vec2 p : path.points) box.add(p);
  if (box.empty()) return;
  while ((box.size().x * per_mm_ + 4) * (box.size().y * per_mm_ + 4) > most_wall_cells) per_mm_ /= 1.1;
  const double margin_mm = 2 / per_mm_;
  origin_ = box.min - Vec2{margin_mm, margin_mm};
  columns_ = int((box.size().x + 2 * margin_mm) * per_mm_) + 1;
  rows_ = int((box.size().y + 2 * margin_mm) * per_mm_) + 1;
  cells_.resize(std::size_t(columns_) * std::size_t(rows_));
  for (std::size_t k = 0; k < paths.size(); ++k)
    if (is_outer_wall(paths[k])) draw(paths[k], int(k));
}

/// As wide as three cells; beside the line only where nothing lies yet.
void LaidWalls::draw(const Path& path, int index) {
  RoadOf road(path);
  double begin_s = 0;
  for (std::size_t i = 0; i < path.segments(); ++i) {
    const Vec2 a = path.points[i], b = path.points[(i + 1) % path.points.size()];
    const double seconds = distance(a, b) / road(i).speed_mm_s;
    const int steps = int(distance(a, b) * per_mm_) + 1;
    for (int k = 0; k < steps; ++k) {
      const double share = (k + 0.5) / steps;
      const Vec2 p = (lerp(a, b, share) - origin_) * per_mm_;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          Cell& cell = cells_[std::size_t(int(p.y) + dy) * std::size_t(columns_) + std::size_t(int(p.x) + dx)];
          if (cell.path < 0 || (dx == 0 && dy == 0)) cell = {index, float(begin_s + seconds * share)};
        }
    }
    begin_s += seconds;
  }
}

}  // namespace cleancolor
