#include "toolpath/bridges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace cleancolor {
namespace {

constexpr int angles = 36;
constexpr double line_spacing_mm = 1;
constexpr int most_lines = 40;        // a large gap is judged by this many
constexpr double step_over_mm = 0.3;  // how far past its end a line must find something to rest on

struct Support {
  double share = 0;    // of the length of all lines, the part whose lines rest at both ends
  double span_mm = 0;  // the longest of those
};

/// Ends of the pieces of the vertical line at x inside the rings, from below.
std::vector<double> column(const std::vector<std::vector<Vec2>>& rings, double x) {
  std::vector<double> ys;
  for (const auto& ring : rings) {
    Vec2 a = ring.back();
    for (const Vec2 b : ring) {
      if ((a.x <= x) != (b.x <= x)) ys.push_back(a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x));
      a = b;
    }
  }
  std::sort(ys.begin(), ys.end());
  return ys;
}

Support support_at(const Polygons& gap, const Polygons& below, double angle_rad) {
  // Turned so that the lines are vertical.
  const double turn = std::numbers::pi / 2 - angle_rad;
  const double c = std::cos(turn), s = std::sin(turn);
  std::vector<std::vector<Vec2>> rings;
  double left = INFINITY, right = -INFINITY;
  for (const Ring& ring : gap) {
    std::vector<Vec2>& points = rings.emplace_back();
    for (const Vec2 p : to_mm(ring)) {
      points.push_back({p.x * c - p.y * s, p.x * s + p.y * c});
      left = std::min(left, points.back().x);
      right = std::max(right, points.back().x);
    }
  }
  const int lines = std::clamp(int((right - left) / line_spacing_mm), 3, most_lines);
  const auto rests = [&](double x, double y) { return contains(below, to_nm({x * c + y * s, -x * s + y * c})); };
  Support result;
  double total = 0, held = 0;
  for (int i = 0; i < lines; ++i) {
    const double x = left + (right - left) * (i + 0.5) / lines;
    const std::vector<double> ys = column(rings, x);
    for (std::size_t k = 0; k + 1 < ys.size(); k += 2) {
      const double span = ys[k + 1] - ys[k];
      total += span;
      if (!rests(x, ys[k] - step_over_mm) || !rests(x, ys[k + 1] + step_over_mm)) continue;
      held += span;
      result.span_mm = std::max(result.span_mm, span);
    }
  }
  result.share = total > 0 ? held / total : 0;
  return result;
}

}  // namespace

std::optional<double> bridge_angle_rad(const Polygons& gap, const Polygons& below) {
  std::optional<double> best;
  Support best_support;
  for (int i = 0; i < angles; ++i) {
    const double angle = std::numbers::pi * i / angles;
    const Support s = support_at(gap, below, angle);
    if (s.share == 0) continue;
    // Shares within two hundredths are equal: then the shorter span decides.
    const bool better = s.share > best_support.share + 0.02 ||
                        (s.share > best_support.share - 0.02 && s.span_mm < best_support.span_mm - 1e-9);
    if (best && !better) continue;
    best = angle;
    best_support = s;
  }
  return best;
}

}  // namespace cleancolor
