#include "orient/interference.hpp"

#include <algorithm>
#include <cmath>

namespace cleancolor {
namespace {

constexpr double least_level_mm = 0.5, finest_row_mm = 0.1, coarsest_row_mm = 0.5;
constexpr double rows_in_all = 16'000;

}  // namespace

Interference::Interference(const Slices& slices) {
  // Each level is the middle one of the layers that it stands for.
  struct Group {
    std::size_t first, last;
    double height_mm;
  };
  std::vector<Group> groups;
  for (std::size_t k = 0; k < slices.slabs.size(); ++k) {
    if (groups.empty() || groups.back().height_mm >= least_level_mm) groups.push_back({k, k, 0});
    groups.back().last = k;
    groups.back().height_mm += slices.slabs[k].height_mm;
  }
  const Box<Vec2> box = bounds_mm(slices.outlines);
  if (box.empty()) return;
  const double depth = box.size().y;
  const double spacing = std::clamp(depth * double(groups.size()) / rows_in_all, finest_row_mm, coarsest_row_mm);
  plan_.count = std::max(1, int(std::ceil(depth / spacing)));
  plan_.spacing_mm = depth / plan_.count;
  plan_.first_mm = box.min.y + plan_.spacing_mm / 2;
  for (const Group& g : groups) {
    const auto& regions = slices.regions[(g.first + g.last) / 2];
    Level level{.height_mm = g.height_mm, .own = {}, .foreign = {}};
    for (const PackedPolygons& region : regions) level.own.emplace_back(region, plan_);
    for (std::size_t e = 0; e < regions.size(); ++e) {
      std::vector<const Rows*> others;
      for (std::size_t k = 0; k < regions.size(); ++k)
        if (k != e) others.push_back(&level.own[k]);
      level.foreign.push_back(Rows::united(others));
    }
    levels_.push_back(std::move(level));
  }
}

double Interference::volume_mm3(int printing, int idle, Vec2 d_mm) const {
  if (levels_.empty()) return 0;
  const double rows = d_mm.y / plan_.spacing_mm;
  const double whole = std::floor(rows), part = rows - whole;
  if (std::abs(rows) > plan_.count) return 0;
  double volume = 0;
  for (const Level& level : levels_) {
    const Rows& own = level.own[std::size_t(printing)];
    const Rows& foreign = level.foreign[std::size_t(idle)];
    if (own.empty() || foreign.empty()) continue;
    double sum = 0;
    for (int r = 0; r < plan_.count; ++r) {
      const std::span<const Interval> a = own.row(r);
      if (a.empty()) continue;
      const int at = r + int(whole);
      sum += (1 - part) * common_mm(a, d_mm.x, foreign.row(at));
      if (part > 0) sum += part * common_mm(a, d_mm.x, foreign.row(at + 1));
    }
    volume += sum * level.height_mm;
  }
  return volume * plan_.spacing_mm;
}

}  // namespace cleancolor
