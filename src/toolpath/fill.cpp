#include "toolpath/fill.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/edge_rows.hpp"
#include "toolpath/link.hpp"

namespace cleancolor {
namespace {

using Rings = std::vector<std::vector<Vec2>>;

// What is shorter is a blob, not a line: a path against the width of its road, a line before it is linked in mm.
constexpr double shortest_share = 0.5;
constexpr double shortest_mm = 0.1;
// How far lines reach over the place where their outer edge touches the border, as a share of their spacing.
constexpr double reach_share = 0.15;
// Infill need not be smooth: what counts is how many moves it takes.
constexpr double curve_tolerance_mm = 0.03;
constexpr int steps_a_wave = 24;

Vec2 turned(Vec2 p, double cosine, double sine) {
  return {p.x * cosine - p.y * sine, p.x * sine + p.y * cosine};
}

std::vector<Path> as_paths(std::vector<std::vector<Vec2>> lines, const Road& road) {
  std::vector<Path> result;
  for (auto& line : lines) {
    Path path;
    path.points = std::move(line);
    path.stretches = {{0, road}};
    if (length_mm(path) < shortest_share * road.width_mm) continue;
    result.push_back(std::move(path));
  }
  return result;
}

/// Where the vertical x = const meets the border.
struct Crossing {
  double y;
  Border::Place place;
};

/// Vertical lines at x0 + row * spacing inside the rings, each from its lower to its upper end.
std::vector<BorderLine> vertical_lines(const Rings& rings, const Border& border, double x0, double spacing) {
  std::vector<std::vector<Crossing>> columns;
  const auto row_of = [&](double x) { return int(std::ceil((x - x0) / spacing)); };
  int first_row = std::numeric_limits<int>::max(), last_row = std::numeric_limits<int>::min();
  for (const auto& ring : rings)
    for (const Vec2 p : ring) {
      first_row = std::min(first_row, row_of(p.x));
      last_row = std::max(last_row, row_of(p.x));
    }
  if (first_row > last_row) return {};
  columns.resize(std::size_t(last_row - first_row) + 1);
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      const Vec2 a = rings[r][i], b = rings[r][(i + 1) % rings[r].size()];
      // Half-open in rows, which both edges at a corner count alike: a line through a corner crosses one of them.
      for (int row = row_of(std::min(a.x, b.x)); row < row_of(std::max(a.x, b.x)); ++row) {
        const double x = x0 + row * spacing;
        const Vec2 p{x, a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x)};
        columns[std::size_t(row - first_row)].push_back({p.y, border.place(int(r), i, p)});
      }
    }
  std::vector<BorderLine> lines;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    auto& column = columns[c];
    std::sort(column.begin(), column.end(), [](const Crossing& a, const Crossing& b) { return a.y < b.y; });
    const double x = x0 + (double(c) + first_row) * spacing;
    for (std::size_t i = 0; i + 1 < column.size(); i += 2)
      if (column[i + 1].y - column[i].y > shortest_mm)
        lines.push_back(
            {{{x, column[i].y}, {x, column[i + 1].y}}, column[i].place, column[i + 1].place, first_row + int(c)});
  }
  return lines;
}

/// Parallel lines at an angle through one region, linked.
std::vector<std::vector<Vec2>> parallel_lines(const Polygons& region, const Fill& fill, double angle_rad,
                                              double density) {
  // Turned so that the lines are vertical, and back again.
  const double turn = std::numbers::pi / 2 - angle_rad;
  const double cosine = std::cos(turn), sine = std::sin(turn);
  Rings rings;
  double left = INFINITY, right = -INFINITY;
  for (const Ring& ring : region) {
    std::vector<Vec2> points;
    for (const Point& p : ring) {
      points.push_back(turned(to_mm(p), cosine, sine));
      left = std::min(left, points.back().x);
      right = std::max(right, points.back().x);
    }
    rings.push_back(std::move(points));
  }
  double spacing = fill.spacing_mm / density, x0 = 0;
  if (density >= 1) {
    // The outermost lines lie on the border, the others evenly between them, never wider apart than asked.
    const int gaps = std::max(1, int(std::ceil((right - left) / spacing - 0.2)));
    spacing = (right - left) / gaps;
    if (spacing < fill.spacing_mm * 0.5) {
      spacing = fill.spacing_mm;
      x0 = (left + right) / 2;
    } else {
      x0 = left + spacing * 1e-6;
      spacing *= 1 - 2e-6 / gaps;
    }
  }
  const Border border(rings);
  const double max_link = density >= 1 ? std::min(fill.max_link_mm, 4 * fill.spacing_mm) : fill.max_link_mm;
  auto lines = linked(vertical_lines(rings, border, x0, spacing), border, max_link);
  for (auto& line : lines)
    for (Vec2& p : line) p = turned(p, cosine, -sine);
  return lines;
}

/// The curves in which the gyroid surface of period `period` cuts the plane z, over a box, before clipping.
///
/// sin x cos y + sin y cos z + sin z cos x = 0, solved for y (or x) in closed form: A cos y + B sin y = -C.
std::vector<std::vector<Vec2>> gyroid_curves(const Box<Vec2>& box, double z_mm, double period_mm) {
  const double k = 2 * std::numbers::pi / period_mm;
  const double sin_z = std::sin(k * z_mm), cos_z = std::cos(k * z_mm);
  const bool along_x = std::abs(cos_z) >= std::abs(sin_z);
  const double from = (along_x ? box.min.x : box.min.y) * k, to = (along_x ? box.max.x : box.max.y) * k;
  const double low = (along_x ? box.min.y : box.min.x) * k, high = (along_x ? box.max.y : box.max.x) * k;
  const int steps = std::max(2, int(std::ceil((to - from) / (2 * std::numbers::pi / steps_a_wave))));
  const auto solution = [&](double t, bool second) {
    // Turned so that B > 0: the angle of (A, B) then never jumps, and the curve is one line.
    const double sign = (along_x ? cos_z : sin_z) < 0 ? -1 : 1;
    const double a = sign * (along_x ? std::sin(t) : std::cos(t));
    const double b = sign * (along_x ? cos_z : sin_z);
    const double c = sign * (along_x ? sin_z * std::cos(t) : cos_z * std::sin(t));
    const double s = std::asin(std::clamp(-c / std::hypot(a, b), -1.0, 1.0));
    return (second ? std::numbers::pi - s : s) - std::atan2(a, b);
  };
  std::vector<Vec2> rising, falling;
  for (int i = 0; i <= steps; ++i) {
    const double t = from + (to - from) * i / steps;
    rising.push_back({t, solution(t, false)});
    falling.push_back({t, solution(t, true)});
  }
  rising = simplified(rising, curve_tolerance_mm * k);
  falling = simplified(falling, curve_tolerance_mm * k);
  std::vector<std::vector<Vec2>> curves;
  for (const bool second : {false, true}) {
    // Lines a period apart; begin far enough below that the whole wave is covered.
    const int first = int(std::floor((low - 2 * std::numbers::pi) / (2 * std::numbers::pi))) - 1;
    const int last = int(std::ceil((high + 2 * std::numbers::pi) / (2 * std::numbers::pi))) + 1;
    for (int n = first; n <= last; ++n) {
      std::vector<Vec2> curve;
      for (const Vec2 p : second ? falling : rising) {
        const double y = p.y + 2 * std::numbers::pi * n;
        curve.push_back(along_x ? Vec2{p.x / k, y / k} : Vec2{y / k, p.x / k});
      }
      curves.push_back(std::move(curve));
    }
  }
  return curves;
}

std::vector<std::vector<Vec2>> gyroid(const Polygons& region, const Fill& fill) {
  // A plane cuts 2.44 mm of gyroid out of each mm2 per mm of period (surface 3.09 L^2 a cell, times the mean pi/4).
  const double period = 2.44 * fill.spacing_mm / fill.density;
  Rings rings;
  for (const Ring& ring : region) rings.push_back(to_mm(ring));
  const Border border(rings);
  const EdgeRows edges(rings);
  const auto place = [&](Vec2 end) {
    const EdgeRows::Edge* edge = edges.nearest(end, 1e-3);
    return edge ? border.place(edge->ring, edge->index, end) : Border::Place{};
  };
  std::vector<BorderLine> lines;
  for (const auto& curve : gyroid_curves(bounds_mm(region), fill.z_mm, period))
    for (auto& points : edges.clipped(curve)) {
      const Border::Place first = place(points.front()), last = place(points.back());
      lines.push_back({std::move(points), first, last, 2 * int(lines.size())});
    }
  return linked(std::move(lines), border, fill.max_link_mm);
}

std::vector<Path> concentric(const Polygons& region, const Fill& fill, const Road& road) {
  std::vector<Path> result;
  const double step = fill.spacing_mm / fill.density;
  for (Polygons loops = region; !loops.empty(); loops = offset(loops, -step))
    for (const Ring& ring : loops) {
      if (length_mm(ring) < 2 * fill.spacing_mm) continue;
      Path path;
      path.closed = true;
      path.points = to_mm(ring);
      path.stretches = {{0, road}};
      result.push_back(std::move(path));
    }
  std::reverse(result.begin(), result.end());  // from the middle outwards
  return result;
}

}  // namespace

std::vector<Path> filled(const Polygons& region, const Fill& fill, const Road& road) {
  // Only where a whole road fits beside the border; but lines go on over it, to bond with what lies beyond.
  Polygons inner = offset(region, -fill.spacing_mm / 2);
  if (fill.pattern != FillPattern::concentric) inner = offset(inner, reach_share * fill.spacing_mm);
  std::vector<Path> result;
  const auto add = [&](std::vector<Path> paths) { std::move(paths.begin(), paths.end(), std::back_inserter(result)); };
  for (const Island& island : islands(inner)) {
    const Polygons piece = polygons(island);
    switch (fill.pattern) {
      case FillPattern::rectilinear:
        add(as_paths(parallel_lines(piece, fill, fill.angle_rad, fill.density), road));
        break;
      case FillPattern::grid:
        add(as_paths(parallel_lines(piece, fill, fill.angle_rad, fill.density / 2), road));
        add(as_paths(parallel_lines(piece, fill, fill.angle_rad + std::numbers::pi / 2, fill.density / 2), road));
        break;
      case FillPattern::gyroid:
        if (fill.density >= 1)
          add(as_paths(parallel_lines(piece, fill, fill.angle_rad, 1), road));
        else
          add(as_paths(gyroid(piece, fill), road));
        break;
      case FillPattern::concentric:
        add(concentric(piece, fill, road));
        break;
    }
  }
  return result;
}

double fill_angle_rad(const Config& config, int layer_index) {
  return (config.fill_angle_deg + 90 * (layer_index % 2)) * std::numbers::pi / 180;
}

}  // namespace cleancolor
