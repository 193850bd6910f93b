#include "toolpath/medial.hpp"

#include <algorithm>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <cstdint>
#include <utility>

#include "toolpath/roads.hpp"

namespace bp = boost::polygon;

namespace cleancolor {
namespace {

// Boost's diagram takes 32-bit integers: 0.1 um, which reaches as far as base/polygon.hpp does.
constexpr double grid_mm = 1e-4;
// Corners of the region are rounded off to this before the diagram is made: it has a branch for each of them.
constexpr double detail_mm = 0.01;
// The axis of a strip has walls that run alongside it. Where the width changes by more than this per mm of length, the
// walls meet at a corner, and the branch leads into it.
constexpr double steepest_widening = 1.0;
// A new stretch begins where the width has changed by this much.
constexpr double width_step_mm = 0.05;

using Voronoi = bp::voronoi_diagram<double>;

struct GridPoint {
  std::int32_t x, y;
};
struct GridSegment {
  GridPoint p0, p1;
};

std::vector<GridSegment> grid_segments(const Polygons& region) {
  const auto on_grid = [](const Point& p) {
    const Vec2 mm = to_mm(p);
    return GridPoint{std::int32_t(std::lround(mm.x / grid_mm)), std::int32_t(std::lround(mm.y / grid_mm))};
  };
  std::vector<GridSegment> result;
  for (const Ring& ring : region)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const GridSegment s{on_grid(ring[i]), on_grid(ring[(i + 1) % ring.size()])};
      if (s.p0.x != s.p1.x || s.p0.y != s.p1.y) result.push_back(s);
    }
  return result;
}

/// Marks all edges outside the region: those that reach infinity and those connected to them, up to the region's
/// border.
void mark_outside(const Voronoi& diagram) {
  std::vector<const Voronoi::edge_type*> todo;
  for (const auto& edge : diagram.edges())
    if (!edge.is_finite()) todo.push_back(&edge);
  while (!todo.empty()) {
    const auto* edge = todo.back();
    todo.pop_back();
    if (edge->color() == 1) continue;
    edge->color(1);
    edge->twin()->color(1);
    if (!edge->is_primary()) continue;
    for (const auto* vertex : {edge->vertex0(), edge->vertex1()}) {
      if (!vertex || vertex->color() == 1) continue;
      vertex->color(1);
      const auto* around = vertex->incident_edge();
      do {
        todo.push_back(around);
        around = around->rot_next();
      } while (around != vertex->incident_edge());
    }
  }
}

/// A point of the axis and how wide the region is there.
struct Node {
  Vec2 at;
  double width_mm;
  std::vector<std::uint32_t> neighbours;
};

/// Distance from a diagram vertex to the border: to the source of any cell around it.
double clearance(const Voronoi::vertex_type& vertex, const std::vector<GridSegment>& segments) {
  const auto& cell = *vertex.incident_edge()->cell();
  const GridSegment& s = segments[cell.source_index()];
  const Vec2 v{vertex.x(), vertex.y()}, a{double(s.p0.x), double(s.p0.y)}, b{double(s.p1.x), double(s.p1.y)};
  if (cell.source_category() == bp::SOURCE_CATEGORY_SEGMENT_START_POINT) return distance(v, a);
  if (cell.source_category() == bp::SOURCE_CATEGORY_SEGMENT_END_POINT) return distance(v, b);
  return std::abs(cross(b - a, v - a)) / distance(a, b);
}

/// Joins two nodes of the axis. Where the region is too narrow or too wide at one of them, only up to where it is.
void connect(std::vector<Node>& nodes, std::uint32_t a, std::uint32_t b, double min_width_mm, double max_width_mm) {
  if (nodes[a].width_mm > nodes[b].width_mm) std::swap(a, b);
  const Node narrow = nodes[a], wide = nodes[b];
  const double widening = wide.width_mm - narrow.width_mm;
  if (a == b || wide.width_mm < min_width_mm || narrow.width_mm > max_width_mm) return;
  if (widening > steepest_widening * distance(narrow.at, wide.at)) return;
  const auto node_of_width = [&](double width_mm) {
    nodes.push_back({lerp(narrow.at, wide.at, (width_mm - narrow.width_mm) / widening), width_mm, {}});
    return std::uint32_t(nodes.size() - 1);
  };
  if (narrow.width_mm < min_width_mm) a = node_of_width(min_width_mm);
  if (wide.width_mm > max_width_mm) b = node_of_width(max_width_mm);
  nodes[a].neighbours.push_back(b);
  nodes[b].neighbours.push_back(a);
}

/// The axis as a graph of its nodes, spurs into corners and what is too narrow left out.
std::vector<Node> axis(const Polygons& region, double min_width_mm, double max_width_mm) {
  const std::vector<GridSegment> segments = grid_segments(region);
  Voronoi diagram;
  bp::voronoi_builder<std::int32_t> builder;
  for (const GridSegment& s : segments) builder.insert_segment(s.p0.x, s.p0.y, s.p1.x, s.p1.y);
  builder.construct(&diagram);
  mark_outside(diagram);

  std::vector<Node> nodes;
  nodes.reserve(diagram.vertices().size());
  for (const auto& v : diagram.vertices())
    nodes.push_back({Vec2{v.x(), v.y()} * grid_mm, 2 * clearance(v, segments) * grid_mm, {}});
  const auto index = [&](const Voronoi::vertex_type* v) { return std::uint32_t(v - diagram.vertices().data()); };
  for (const auto& edge : diagram.edges()) {
    if (edge.color() == 1 || !edge.is_primary() || !edge.is_finite() || &edge > edge.twin()) continue;
    connect(nodes, index(edge.vertex0()), index(edge.vertex1()), min_width_mm, max_width_mm);
  }
  return nodes;
}

/// The axis as lines: from a free end or a branching on to the next one, then the rings that have neither.
std::vector<std::vector<std::uint32_t>> lines(std::vector<Node>& nodes) {
  std::vector<std::vector<std::uint32_t>> result;
  const auto take = [&](std::uint32_t from, std::uint32_t to) {
    std::erase(nodes[from].neighbours, to);
    std::erase(nodes[to].neighbours, from);
  };
  std::vector<char> is_end(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) is_end[i] = nodes[i].neighbours.size() != 2;
  const auto walk = [&](std::uint32_t start) {
    std::vector<std::uint32_t> line{start};
    while (!nodes[line.back()].neighbours.empty()) {
      const std::uint32_t next = nodes[line.back()].neighbours.front();
      take(line.back(), next);
      line.push_back(next);
      if (is_end[next] || next == start) break;
    }
    result.push_back(std::move(line));
  };
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
    while (is_end[i] && !nodes[i].neighbours.empty()) walk(i);
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
    while (!nodes[i].neighbours.empty()) walk(i);
  return result;
}

/// One line as a path whose stretches follow the width.
Path medial_path(const std::vector<Node>& nodes, const std::vector<std::uint32_t>& line, const Road& road,
                 double extra_mm) {
  Path path;
  path.closed = line.size() > 3 && line.front() == line.back();
  path.points.push_back(nodes[line.front()].at);
  double current_width = -1;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Node &a = nodes[line[i]], &b = nodes[line[i + 1]];
    const int pieces = 1 + int(std::abs(b.width_mm - a.width_mm) / width_step_mm);
    for (int k = 0; k < pieces; ++k) {
      const double width = a.width_mm + (b.width_mm - a.width_mm) * (k + 0.5) / pieces;
      if (std::abs(width - current_width) > width_step_mm / 2) {
        current_width = width;
        path.stretches.push_back({std::uint32_t(path.points.size() - 1), with_width(road, width + extra_mm)});
      }
      path.points.push_back(lerp(a.at, b.at, double(k + 1) / pieces));
    }
  }
  if (path.closed) path.points.pop_back();
  return path;
}

}  // namespace

std::vector<Path> medial_roads(const Polygons& region, const Road& road, const MedialOptions& options) {
  // What a disc of the least width cannot enter has no axis worth printing; what the greatest fits into is not narrow.
  Polygons narrow = opened(region, options.min_width_mm / 2);
  narrow = difference(narrow, opened(narrow, options.max_width_mm / 2));
  narrow = united(simplified(narrow, detail_mm));
  if (narrow.empty()) return {};
  std::vector<Node> nodes = axis(narrow, options.min_width_mm, options.max_width_mm);
  std::vector<Path> result;
  for (const auto& line : lines(nodes)) {
    double widest = 0;
    for (const std::uint32_t n : line) widest = std::max(widest, nodes[n].width_mm);
    Path path = medial_path(nodes, line, road, options.extra_mm);
    if (length_mm(path) >= std::max(widest, road.width_mm / 2)) result.push_back(std::move(path));
  }
  return result;
}

}  // namespace cleancolor
