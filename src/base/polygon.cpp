#include "base/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace cleancolor {
namespace {

using ClipperLib::ClipType;

constexpr double miter_limit = 3;
// A round corner of radius r deviates from the circle by at most this, whatever r is.
constexpr double arc_tolerance_nm = 5000;

Polygons boolean(ClipType type, const Polygons& a, const Polygons& b) {
  ClipperLib::Clipper clipper;
  clipper.AddPaths(a, ClipperLib::ptSubject, true);
  clipper.AddPaths(b, ClipperLib::ptClip, true);
  Polygons result;
  clipper.Execute(type, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  return result;
}

bool boxes_meet(const Polygons& a, const Polygons& b) {
  const auto box = [](const Polygons& region) {
    constexpr auto far = std::numeric_limits<ClipperLib::cInt>::max();
    std::pair<Point, Point> result{{far, far}, {-far, -far}};
    for (const Ring& ring : region)
      for (const Point& p : ring) {
        result.first = {std::min(result.first.X, p.X), std::min(result.first.Y, p.Y)};
        result.second = {std::max(result.second.X, p.X), std::max(result.second.Y, p.Y)};
      }
    return result;
  };
  const auto [a_min, a_max] = box(a);
  const auto [b_min, b_max] = box(b);
  return a_min.X <= b_max.X && b_min.X <= a_max.X && a_min.Y <= b_max.Y && b_min.Y <= a_max.Y;
}

/// Marks the points that stay. Distances are to the segment between the two ends, as Douglas and Peucker have it.
template <class P, class X, class Y>
void mark_kept(const std::vector<P>& points, X x, Y y, double tolerance, std::size_t first, std::size_t last,
               std::vector<char>& kept) {
  std::vector<std::pair<std::size_t, std::size_t>> todo{{first, last}};
  while (!todo.empty()) {
    const auto [i, j] = todo.back();
    todo.pop_back();
    if (j - i < 2) continue;
    const double ax = x(points[i]), ay = y(points[i]);
    const double dx = x(points[j]) - ax, dy = y(points[j]) - ay;
    const double squared = dx * dx + dy * dy;
    double worst = -1;
    std::size_t at = i;
    for (std::size_t k = i + 1; k < j; ++k) {
      const double px = x(points[k]) - ax, py = y(points[k]) - ay;
      const double t = squared > 0 ? std::clamp((px * dx + py * dy) / squared, 0.0, 1.0) : 0;
      const double ex = px - t * dx, ey = py - t * dy;
      const double d = ex * ex + ey * ey;
      if (d > worst) worst = d, at = k;
    }
    if (worst <= tolerance * tolerance) continue;
    kept[at] = 1;
    todo.emplace_back(i, at);
    todo.emplace_back(at, j);
  }
}

Ring simplified_ring(const Ring& ring, double tolerance_nm) {
  if (ring.size() < 4) return ring;
  // Two points that surely stay: the lowest (leftmost of equals) and the one farthest from it. They depend on the shape
  // only, so that two colours that share a border keep the same points of it more often than not.
  const auto low = std::min_element(ring.begin(), ring.end(), [](const Point& a, const Point& b) {
    return std::pair(a.Y, a.X) < std::pair(b.Y, b.X);
  });
  Ring open;
  open.reserve(ring.size() + 1);
  open.insert(open.end(), low, ring.end());
  open.insert(open.end(), ring.begin(), low);
  open.push_back(open.front());
  const auto far = std::max_element(open.begin(), open.end(), [&](const Point& a, const Point& b) {
    return std::hypot(double(a.X - open[0].X), double(a.Y - open[0].Y)) <
           std::hypot(double(b.X - open[0].X), double(b.Y - open[0].Y));
  });
  const auto middle = std::size_t(far - open.begin());
  std::vector<char> kept(open.size(), 0);
  kept.front() = kept[middle] = 1;
  const auto x = [](const Point& p) { return double(p.X); };
  const auto y = [](const Point& p) { return double(p.Y); };
  mark_kept(open, x, y, tolerance_nm, 0, middle, kept);
  mark_kept(open, x, y, tolerance_nm, middle, open.size() - 1, kept);
  Ring result;
  result.reserve(std::size_t(std::count(kept.begin(), kept.end() - 1, 1)));
  for (std::size_t i = 0; i + 1 < open.size(); ++i)
    if (kept[i]) result.push_back(open[i]);
  return result;
}

ClipperLib::JoinType join_type(Corners corners) {
  switch (corners) {
    case Corners::miter:
      return ClipperLib::jtMiter;
    case Corners::round:
      return ClipperLib::jtRound;
    case Corners::square:
      return ClipperLib::jtSquare;
  }
  return ClipperLib::jtMiter;
}

}  // namespace

std::vector<Vec2> to_mm(const Ring& ring) {
  std::vector<Vec2> points;
  points.reserve(ring.size());
  for (const Point& p : ring) points.push_back(to_mm(p));
  return points;
}

Polygons united(const Polygons& a) {
  return united(a, {});
}
Polygons united(const Polygons& a, const Polygons& b) {
  return boolean(ClipperLib::ctUnion, a, b);
}

Polygons intersection(const Polygons& a, const Polygons& b) {
  if (a.empty() || b.empty() || !boxes_meet(a, b)) return {};
  return boolean(ClipperLib::ctIntersection, a, b);
}

Polygons difference(const Polygons& a, const Polygons& b) {
  if (a.empty() || b.empty() || !boxes_meet(a, b)) return a;
  return boolean(ClipperLib::ctDifference, a, b);
}

Polygons offset(const Polygons& region, double delta_mm, Corners corners) {
  if (region.empty() || delta_mm == 0) return region;
  ClipperLib::ClipperOffset clipper(miter_limit, arc_tolerance_nm);
  clipper.AddPaths(region, join_type(corners), ClipperLib::etClosedPolygon);
  Polygons result;
  clipper.Execute(result, delta_mm * nm_per_mm);
  return result;
}

Polygons opened(const Polygons& region, double radius_mm, Corners corners) {
  return offset(offset(region, -radius_mm, corners), radius_mm, corners);
}

Polygons closed(const Polygons& region, double radius_mm, Corners corners) {
  return offset(offset(region, radius_mm, corners), -radius_mm, corners);
}

Polygons simplified(const Polygons& region, double tolerance_mm) {
  Polygons result;
  result.reserve(region.size());
  for (const Ring& ring : region) {
    Ring simple = simplified_ring(ring, tolerance_mm * nm_per_mm);
    if (simple.size() >= 3) result.push_back(std::move(simple));
  }
  return result;
}

std::vector<Vec2> simplified(const std::vector<Vec2>& line, double tolerance_mm) {
  if (line.size() < 3) return line;
  std::vector<char> kept(line.size(), 0);
  kept.front() = kept.back() = 1;
  mark_kept(line, [](Vec2 p) { return p.x; }, [](Vec2 p) { return p.y; }, tolerance_mm, 0, line.size() - 1, kept);
  std::vector<Vec2> result;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (kept[i]) result.push_back(line[i]);
  return result;
}

std::vector<Island> islands(const Polygons& region) {
  std::vector<Island> result;
  for (const Ring& ring : region)
    if (ClipperLib::Orientation(ring)) result.push_back({ring, {}});
  for (const Ring& ring : region) {
    if (ClipperLib::Orientation(ring)) continue;
    // A hole belongs to the smallest outline around it. A point of the hole that lies on an outline decides nothing.
    Island* owner = result.size() == 1 ? &result.front() : nullptr;
    double owner_area = std::numeric_limits<double>::infinity();
    for (Island& island : result) {
      if (result.size() == 1) break;
      int in = -1;
      for (std::size_t i = 0; i < ring.size() && in == -1; ++i)
        in = ClipperLib::PointInPolygon(ring[i], island.outline);
      if (in == 0) continue;
      const double area = area_mm2(island.outline);
      if (area < owner_area) owner = &island, owner_area = area;
    }
    if (owner) owner->holes.push_back(ring);
  }
  return result;
}

Polygons polygons(const Island& island) {
  Polygons result{island.outline};
  result.insert(result.end(), island.holes.begin(), island.holes.end());
  return result;
}

double area_mm2(const Ring& ring) {
  return ClipperLib::Area(ring) * mm_per_nm * mm_per_nm;
}

double area_mm2(const Polygons& region) {
  double sum = 0;
  for (const Ring& ring : region) sum += area_mm2(ring);
  return sum;
}

double length_mm(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& p = ring[i];
    const Point& q = ring[i + 1 < ring.size() ? i + 1 : 0];
    sum += std::hypot(double(q.X - p.X), double(q.Y - p.Y));
  }
  return sum * mm_per_nm;
}

double length_mm(const Polygons& region) {
  double sum = 0;
  for (const Ring& ring : region) sum += length_mm(ring);
  return sum;
}

Box<Vec2> bounds_mm(const Polygons& region) {
  Box<Vec2> box;
  for (const Ring& ring : region)
    for (const Point& p : ring) box.add(to_mm(p));
  return box;
}

double border_distance_mm(const Polygons& region, Vec2 p_mm) {
  double least = INFINITY;
  for (const Ring& ring : region)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 q = nearest_on_segment(to_mm(ring[i]), to_mm(ring[(i + 1) % ring.size()]), p_mm);
      least = std::min(least, length_squared(p_mm - q));
    }
  return std::sqrt(least);
}

bool contains(const Polygons& region, Point p) {
  // Outlines count up, holes count down: inside where they do not cancel.
  int depth = 0;
  for (const Ring& ring : region) {
    const int in = ClipperLib::PointInPolygon(p, ring);
    if (in == -1) return true;
    if (in == 1) depth += ClipperLib::Orientation(ring) ? 1 : -1;
  }
  return depth > 0;
}

Polygons rectangle(Vec2 min_mm, Vec2 max_mm) {
  const Point a = to_nm(min_mm), c = to_nm(max_mm);
  return {{a, {c.X, a.Y}, c, {a.X, c.Y}}};
}

Ring convex_hull(const Polygons& region) {
  std::vector<Point> points;
  for (const Ring& ring : region) points.insert(points.end(), ring.begin(), ring.end());
  const auto less = [](const Point& a, const Point& b) { return std::pair(a.X, a.Y) < std::pair(b.X, b.Y); };
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return {};
  // Andrew's monotone chain: lower hull left to right, upper hull back.
  Ring hull;
  const auto turns_left = [](const Point& o, const Point& a, const Point& b) {
    return double(a.X - o.X) * double(b.Y - o.Y) - double(a.Y - o.Y) * double(b.X - o.X) > 0;
  };
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t base = hull.size();
    for (const Point& p : points) {
      while (hull.size() >= base + 2 && !turns_left(hull[hull.size() - 2], hull.back(), p)) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

Polygons filled(const Polygons& region) {
  Polygons outer;
  for (const Ring& ring : region)
    if (ClipperLib::Orientation(ring)) outer.push_back(ring);
  Polygons result;
  for (Ring& ring : united(outer))
    if (ClipperLib::Orientation(ring)) result.push_back(std::move(ring));
  return result;
}

}  // namespace cleancolor
