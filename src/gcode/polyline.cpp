#include "gcode/polyline.hpp"

#include <algorithm>
#include <cassert>

namespace cleancolor {
namespace {

double distance_squared_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 ab = b - a;
  const double squared = length_squared(ab);
  if (squared == 0) return length_squared(p - a);
  const double t = std::clamp(dot(p - a, ab) / squared, 0.0, 1.0);
  return length_squared(p - (a + ab * t));
}

/// Appends the points after `first` up to `last` that must stay.
void keep_needed(const std::vector<Vec2>& points, std::size_t first, std::size_t last, double tolerance_squared,
                 std::vector<Vec2>& kept) {
  double farthest = tolerance_squared;
  std::size_t split = last;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double d = distance_squared_to_segment(points[i], points[first], points[last]);
    if (d > farthest) farthest = d, split = i;
  }
  if (split == last) {
    kept.push_back(points[last]);
    return;
  }
  keep_needed(points, first, split, tolerance_squared, kept);
  keep_needed(points, split, last, tolerance_squared, kept);
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
  thread_local std::vector<Vec2> all;
  all = path.points;
  if (path.closed) all.push_back(path.points.front());

  line.points.assign(1, all.front());
  line.stretches.clear();
  const double squared = tolerance_mm * tolerance_mm;
  for (std::size_t s = 0; s < path.stretches.size(); ++s) {
    const std::size_t first = path.stretches[s].first_segment;
    const std::size_t last = s + 1 < path.stretches.size() ? path.stretches[s + 1].first_segment : all.size() - 1;
    line.stretches.push_back({std::uint32_t(line.points.size() - 1), path.stretches[s].road});
    // A loop has no two ends to measure from: it is halved first.
    const std::size_t half = path.closed && path.stretches.size() == 1 ? farthest_from(all, first, last) : first;
    if (half > first) keep_needed(all, first, half, squared, line.points);
    keep_needed(all, half, last, squared, line.points);
  }
  if (path.closed && gap_mm > 0) cut_end(line, std::min(gap_mm, length_of(line.points) / 4));
}

}  // namespace cleancolor
