#include "orient/exposure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.hpp"
#include "base/rows.hpp"

namespace cleancolor {
namespace {

constexpr double most_cells = 20e6;
constexpr double reach_mm = 25;
constexpr int direction_count = 64;

/// Spread evenly over the sphere.
std::vector<Vec3> directions() {
  std::vector<Vec3> all;
  const double turn = std::numbers::pi * (3 - std::sqrt(5.));
  for (int i = 0; i < direction_count; ++i) {
    const double z = 1 - (2 * i + 1.) / direction_count, r = std::sqrt(1 - z * z);
    all.push_back({r * std::cos(turn * i), r * std::sin(turn * i), z});
  }
  return all;
}

}  // namespace

ExposureMap::ExposureMap(const Slices& slices, const std::vector<Pace>& pace, int threads) : pace_(pace) {
  box_ = bounds_mm(slices.outlines);
  if (box_.empty()) return;
  fill(slices, threads);
  mark_shells(pace, threads);
  find_places(threads);
}

void ExposureMap::fill(const Slices& slices, int threads) {
  const double top_mm = slices.slabs.back().print_z_mm;
  const Vec2 size = box_.size();
  while (size.x * size.y * top_mm / (cell_mm_ * cell_mm_ * level_mm_) > most_cells) cell_mm_ *= 1.1, level_mm_ *= 1.1;
  level_mm_ = std::max(level_mm_, top_mm / double(slices.slabs.size()));
  columns_ = std::max(1, int(std::ceil(size.x / cell_mm_)));
  rows_ = std::max(1, int(std::ceil(size.y / cell_mm_)));
  levels_ = std::max(1, int(std::ceil(top_mm / level_mm_)));
  layers_per_level_ = double(slices.slabs.size()) / levels_;
  cells_.assign(std::size_t(columns_) * std::size_t(rows_) * std::size_t(levels_), none);
  const RowPlan plan{box_.min.y + cell_mm_ / 2, cell_mm_, rows_};
  parallel_for(levels_, threads, [&](int level) {
    const double z = std::min((level + 0.5) * level_mm_, top_mm);
    const auto slab = std::ranges::lower_bound(slices.slabs, z, {}, &Slab::print_z_mm);
    const auto& regions = slices.regions[std::size_t(std::min(slab, slices.slabs.end() - 1) - slices.slabs.begin())];
    for (std::size_t e = 0; e < regions.size(); ++e) {
      const Rows rows(regions[e], plan);
      for (int y = 0; y < rows_; ++y) {
        std::uint8_t* row =
            cells_.data() + (std::size_t(level) * std::size_t(rows_) + std::size_t(y)) * std::size_t(columns_);
        for (const Interval& i : rows.row(y)) {
          const auto to_cell = [&](float x) {
            return std::clamp(int(std::ceil((double(x) - box_.min.x) / cell_mm_ - 0.5)), 0, columns_);
          };
          std::fill(row + to_cell(i.begin_mm), row + std::max(to_cell(i.begin_mm), to_cell(i.end_mm)), std::uint8_t(e));
        }
      }
    }
  });
}

/// Cells of perimeters: nearer than shell_mm to one of another colour, or of none.
void ExposureMap::mark_shells(const std::vector<Pace>& pace, int threads) {
  parallel_for(levels_, threads, [&](int level) {
    // Distance to the nearest border, in cells: straight steps 1, diagonal ones 1.4.
    const auto index = [&](int x, int y) { return std::size_t(y) * std::size_t(columns_) + std::size_t(x); };
    std::vector<float> distance(std::size_t(columns_) * std::size_t(rows_), 1e9F);
    const auto relax = [&](int x, int y, int dx, int dy, float way) {
      const std::uint8_t own = at(x, y, level);
      const float through = at(x + dx, y + dy, level) != own ? way - 0.5F : distance[index(x + dx, y + dy)] + way;
      distance[index(x, y)] = std::min(distance[index(x, y)], through);
    };
    constexpr float diagonal = 1.4F;
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < columns_; ++x) {
        if (at(x, y, level) == none) continue;
        relax(x, y, -1, 0, 1), relax(x, y, 0, -1, 1), relax(x, y, -1, -1, diagonal), relax(x, y, 1, -1, diagonal);
      }
    for (int y = rows_; y-- > 0;)
      for (int x = columns_; x-- > 0;) {
        if (at(x, y, level) == none) continue;
        relax(x, y, 1, 0, 1), relax(x, y, 0, 1, 1), relax(x, y, 1, 1, diagonal), relax(x, y, -1, 1, diagonal);
      }
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < columns_; ++x) {
        std::uint8_t& cell = cells_[std::size_t(level) * distance.size() + index(x, y)];
        if (cell != none && double(distance[index(x, y)]) * cell_mm_ <= pace[cell].shell_mm) cell |= shell;
      }
  });
}

float ExposureMap::visibility(int x, int y, int level) const {
  static const std::vector<Vec3> all = directions();
  const double step_mm = std::max(1., cell_mm_);
  int open = 0;
  for (const Vec3& d : all) {
    bool hit = false;
    for (double way = 1.5 * step_mm; way <= reach_mm && !hit; way += step_mm) {
      const double height = level + 0.5 + d.z * way / level_mm_;
      if (height >= levels_) break;
      hit = height < 0 || at(int(std::floor(x + 0.5 + d.x * way / cell_mm_)),
                             int(std::floor(y + 0.5 + d.y * way / cell_mm_)), int(height)) != none;
    }
    open += !hit;
  }
  return std::min(1.F, 2.F * float(open) / direction_count);
}

void ExposureMap::find_places(int threads) {
  std::vector<std::vector<Place>> found(std::size_t(levels_), std::vector<Place>{});
  parallel_for(levels_, threads, [&](int level) {
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < columns_; ++x) {
        const std::uint8_t cell = at(x, y, level);
        if (cell == none) continue;
        const bool visible = at(x - 1, y, level) == none || at(x + 1, y, level) == none ||
                             at(x, y - 1, level) == none || at(x, y + 1, level) == none || at(x, y, level + 1) == none;
        if (!visible) continue;
        const double weight = double(visibility(x, y, level)) * cell_mm_ * cell_mm_ * layers_per_level_;
        if (weight > 0) found[std::size_t(level)].push_back({x, y, level, std::uint8_t(cell & ~shell), float(weight)});
      }
  });
  for (const std::vector<Place>& level : found) places_.insert(places_.end(), level.begin(), level.end());
}

double ExposureMap::seconds(int printing, int idle, Vec2 d_mm) const {
  // Between four whole shifts, or the curve would jump from cell to cell.
  const Vec2 cells = d_mm * (1 / cell_mm_);
  const int dx = int(std::floor(cells.x)), dy = int(std::floor(cells.y));
  const double fx = cells.x - dx, fy = cells.y - dy;
  const Pace& pace = pace_[std::size_t(printing)];
  const auto here_s_mm2 = [&](int x, int y, int level) {
    const std::uint8_t cell = at(x, y, level);
    if (cell == none || (cell & ~shell) != printing) return 0.;
    return (cell & shell) != 0 ? pace.shell_s_mm2 : pace.inner_s_mm2;
  };
  double sum = 0;
  for (const Place& q : places_) {
    if (q.colour == idle) continue;
    const int x = q.x - dx, y = q.y - dy;
    const double low = std::lerp(here_s_mm2(x, y, q.level), here_s_mm2(x - 1, y, q.level), fx);
    const double high = std::lerp(here_s_mm2(x, y - 1, q.level), here_s_mm2(x - 1, y - 1, q.level), fx);
    sum += double(q.weight_mm2) * std::lerp(low, high, fy);
  }
  return sum;
}

}  // namespace cleancolor
