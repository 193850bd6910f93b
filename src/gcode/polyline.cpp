#include "gcode/polyline.hpp"

#include <algorithm>
#include <cassert>

#include "base/polygon.hpp"

namespace cleancolor {
namespace {

/// Appends the points after `first` up to `last` that must stay.
void append_needed(const std::vector<Vec2>& points, std::size_t first, std::size_t last, double tolerance_mm,
                   std::vector<Vec2>& kept) {
  const std::vector<Vec2> run =
      simplified(std::vector<Vec2>(points.begin() + std::ptrdiff_t(first), points.begin() + std::ptrdiff_t(last) + 1),
                 tolerance_mm);
  kept.insert(kept.end(), run.begin() + 1, run.end());
}

/// A point outside which all others lie in [first, last] makes a closed run splittable in two open ones.
std::size_t farthest_from(const std::vector<Vec2>& points, std::size_t first, std::size_t last) {
  std::size_t best = first;
  for (std::size_t i = first + 1; i < last; ++i)
    if (length_squared(points[i] - points[first]) > length_squared(points[best] - points[first])) best = i;
  return best;
}

void cut_end(Polyline& line, double gap_mm) {
  double rest = gap_mm;
  while (line.points.size() > 1) {
    const Vec2 b = line.points.back(), a = line.points[line.points.size() - 2];
    const double length = distance(a, b);
    if (length > rest) {
      line.points.back() = lerp(b, a, rest / length);
      break;
    }
    rest -= length;
    line.points.pop_back();
  }
  while (line.stretches.size() > 1 && line.stretches.back().first_segment + 1 >= line.points.size())
    line.stretches.pop_back();
}

double length_of(const std::vector<Vec2>& points) {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1], points[i]);
  return sum;
}

}  // namespace

void lay_out(const Path& path, double tolerance_mm, double gap_mm, Polyline& line) {
  assert(path.points.size() >= 2 && !path.stretches.empty());
  std::vector<Vec2> all = path.points;
  if (path.closed) all.push_back(path.points.front());

  line.points.assign(1, all.front());
  line.stretches.clear();
  for (std::size_t s = 0; s < path.stretches.size(); ++s) {
    const std::size_t first = path.stretches[s].first_segment;
    const std::size_t last = s + 1 < path.stretches.size() ? path.stretches[s + 1].first_segment : all.size() - 1;
    line.stretches.push_back({std::uint32_t(line.points.size() - 1), path.stretches[s].road});
    // A loop has no two ends to measure from: it is halved first.
    const std::size_t half = path.closed && path.stretches.size() == 1 ? farthest_from(all, first, last) : first;
    if (half > first) append_needed(all, first, half, tolerance_mm, line.points);
    append_needed(all, half, last, tolerance_mm, line.points);
  }
  if (path.closed && gap_mm > 0) cut_end(line, std::min(gap_mm, length_of(line.points) / 4));
}

}  // namespace cleancolor
