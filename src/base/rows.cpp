#include "base/rows.hpp"

#include <algorithm>
#include <cmath>

namespace cleancolor {

Rows::Rows(const Polygons& region, const RowPlan& plan) {
  std::vector<std::vector<float>> crossings(std::size_t(plan.count));
  for (const Ring& ring : region)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      Vec2 a = to_mm(ring[i]), b = to_mm(ring[(i + 1) % ring.size()]);
      if (a.y == b.y) continue;
      if (a.y > b.y) std::swap(a, b);
      // A row at a corner belongs to the edge above it.
      const auto row_above = [&](double y) { return int(std::ceil((y - plan.first_mm) / plan.spacing_mm)); };
      for (int r = std::max(0, row_above(a.y)); r < std::min(plan.count, row_above(b.y)); ++r) {
        const double y = plan.first_mm + r * plan.spacing_mm;
        crossings[std::size_t(r)].push_back(float(std::lerp(a.x, b.x, (y - a.y) / (b.y - a.y))));
      }
    }
  first_.reserve(crossings.size() + 1);
  for (std::vector<float>& x : crossings) {
    first_.push_back(std::uint32_t(intervals_.size()));
    std::ranges::sort(x);
    for (std::size_t i = 0; i + 1 < x.size(); i += 2)
      if (x[i] < x[i + 1]) intervals_.push_back({x[i], x[i + 1]});
  }
  first_.push_back(std::uint32_t(intervals_.size()));
}

Rows Rows::united(std::span<const Rows* const> all) {
  Rows result;
  int count = 0;
  for (const Rows* rows : all) count = std::max(count, rows->count());
  std::vector<Interval> row;
  for (int r = 0; r < count; ++r) {
    result.first_.push_back(std::uint32_t(result.intervals_.size()));
    row.clear();
    for (const Rows* rows : all) row.insert(row.end(), rows->row(r).begin(), rows->row(r).end());
    std::ranges::sort(row, {}, &Interval::begin_mm);
    const std::size_t first = result.intervals_.size();
    for (const Interval& i : row) {
      if (result.intervals_.size() > first && i.begin_mm <= result.intervals_.back().end_mm) {
        result.intervals_.back().end_mm = std::max(result.intervals_.back().end_mm, i.end_mm);
      } else {
        result.intervals_.push_back(i);
      }
    }
  }
  result.first_.push_back(std::uint32_t(result.intervals_.size()));
  return result;
}

double common_mm(std::span<const Interval> a, double shift_mm, std::span<const Interval> b) {
  double sum = 0;
  const auto shift = float(shift_mm);
  for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
    const float begin = std::max(a[i].begin_mm + shift, b[k].begin_mm);
    const float a_end = a[i].end_mm + shift, b_end = b[k].end_mm;
    const float end = std::min(a_end, b_end);
    if (end > begin) sum += double(end - begin);
    if (a_end < b_end) {
      ++i;
    } else {
      ++k;
    }
  }
  return sum;
}

}  // namespace cleancolor
