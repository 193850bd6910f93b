#include "reader/arc.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cleancolor {
namespace {

constexpr double tolerance_mm = 0.01;
constexpr int most_chords = 2048;

/// Of the circle through both ends with this radius; the sign chooses the side as firmware does.
std::optional<Vec2> center_of(const Arc& arc) {
  const Vec2 way = arc.to_mm - arc.from_mm;
  const double half = length(way) / 2;
  const double r = std::abs(arc.radius_mm);
  if (half == 0 || r == 0 || r < half * (1 - 1e-3)) return std::nullopt;
  const double aside = std::sqrt(std::max(0.0, r * r - half * half));
  const Vec2 left = {-way.y / (2 * half), way.x / (2 * half)};
  const bool is_left = (arc.radius_mm > 0) != arc.clockwise;
  return lerp(arc.from_mm, arc.to_mm, 0.5) + left * (is_left ? aside : -aside);
}

}  // namespace

std::vector<ArcPoint> chords(const Arc& arc) {
  const std::optional<Vec2> center = arc.center_mm ? arc.center_mm : center_of(arc);
  if (!center) return {};
  const Vec2 a = arc.from_mm - *center, b = arc.to_mm - *center;
  const double r = length(a), end_r = length(b);
  if (r == 0 || end_r == 0) return {};
  constexpr double turn = 2 * std::numbers::pi;
  double angle = std::atan2(cross(a, b), dot(a, b));
  if (arc.from_mm == arc.to_mm) {
    angle = arc.clockwise ? -turn : turn;
  } else if (arc.clockwise && angle > 0) {
    angle -= turn;
  } else if (!arc.clockwise && angle < 0) {
    angle += turn;
  }
  const double step = 2 * std::acos(std::max(0.0, 1 - tolerance_mm / std::max(r, tolerance_mm)));
  const int count = std::clamp(int(std::ceil(std::abs(angle) / step)), 1, most_chords);
  std::vector<ArcPoint> points;
  points.reserve(std::size_t(count));
  const double start = std::atan2(a.y, a.x);
  for (int i = 1; i < count; ++i) {
    const double share = double(i) / count;
    const double at = start + angle * share;
    const double radius = r + (end_r - r) * share;  // ends that are not quite on one circle: a slight spiral
    points.push_back({*center + Vec2{std::cos(at), std::sin(at)} * radius, share});
  }
  points.push_back({arc.to_mm, 1});
  return points;
}

}  // namespace cleancolor
