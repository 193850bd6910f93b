#include "plan/roadmap.hpp"

#include <algorithm>
#include <boost/polygon/voronoi.hpp>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>

#include "plan/joined_loops.hpp"
#include "plan/ooze_forecast.hpp"

namespace cleancolor {
namespace {

constexpr double unit_per_mm = 1000;  // of the triangulation's whole numbers
constexpr double field_mm = 0.5;      // cells of the distance field
constexpr double most_cells = 5e5;    // larger ones where there would be more
constexpr int samples_a_stretch = 4;
constexpr double ridge_mm = 2.5;  // nearest shapes this far apart: a way between two

/// Numbers nodes as they come; those at one place are linked (delaunay).
class Nodes {
 public:
  explicit Nodes(Roadmap& map) : map_(map) {}
  std::uint32_t add(Vec2 p) {
    map_.nodes_mm.push_back(p);
    return std::uint32_t(map_.nodes_mm.size() - 1);
  }

 private:
  Roadmap& map_;
};

/// The places of a closed path where it can be entered.
void add_entries(const Path& path, Vec2 offset_mm, const TravelCost& cost, const RoadmapOptions& options, Nodes& nodes,
                 std::span<const Path* const> loops, std::vector<Entry>& entries) {
  const double stretch = options.spacing_mm, sample = stretch / samples_a_stretch;
  double next = 0, way = 0;  // of the next sample; of the segment's begin
  int taken = 0;
  Entry best;
  double best_cost = 0;
  const auto add_best = [&](Vec2 node_mm) {
    best.node = nodes.add(node_mm - offset_mm);
    if (begins_outer_wall(path)) {
      best.ahead = visibility_ahead(path, best.segment, best.at_mm, cost.map());
      best.lead_mm = options.leads && path.source < 0 ? lead_mm(path, best.segment, best.at_mm, loops) : 0;
    }
    entries.push_back(best);
  };
  const auto close_stretch = [&] {
    const bool any = taken > 0;
    taken = 0;
    if (!any) return;
    if (path.inner.empty())
      add_best(best.at_mm);
    else if (const auto joint = joint_at(path, best.at_mm))
      add_best(joint->at_mm);
  };
  for (std::size_t i = 0; i < path.segments(); ++i) {
    const Vec2 a = path.points[i], b = path.points[(i + 1) % path.points.size()];
    const double length = distance(a, b);
    for (; next < way + length; next += sample) {
      const Vec2 p = length > 0 ? lerp(a, b, (next - way) / length) : a;
      const double c = cost.seam(p);
      if (taken == 0 || c < best_cost) best = {.node = 0, .segment = std::uint32_t(i), .at_mm = p}, best_cost = c;
      if (++taken == samples_a_stretch) close_stretch();
    }
    way += length;
  }
  close_stretch();
  // Where none of the places looked at has a joint, one of the corners has: the loops would not be together else.
  for (std::size_t i = 0; i < path.points.size() && entries.empty(); ++i) {
    best = {.node = 0, .segment = std::uint32_t(i), .at_mm = path.points[i]};
    taken = 1;
    close_stretch();
  }
  if (!entries.empty()) return;
  // Nor has any corner, where the inner loop is thin since it begins beside the start of the outer one.
  best = {.node = 0, .segment = 0, .at_mm = path.start()};
  add_best(path.inner.back().start());
}

struct Cell {
  std::int32_t x, y;
  friend bool operator==(Cell, Cell) = default;
};

/// A field of distances to what must not be crossed, in the carriage's frame.
class Field {
 public:
  Field(const TravelCost& cost, const Box<Vec2>& box) : origin_(box.min) {
    const double area_mm2 = box.size().x * box.size().y;
    cell_mm_ = std::max(field_mm, std::sqrt(area_mm2 / most_cells));
    columns_ = int(box.size().x / cell_mm_) + 1;
    rows_ = int(box.size().y / cell_mm_) + 1;
    nearest_.assign(std::size_t(columns_) * std::size_t(rows_), none);
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < columns_; ++x)
        if (cost.is_barred(place(x, y), 0)) nearest_[index(x, y)] = {x, y};
    sweep();
  }

  double cell_mm() const { return cell_mm_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  Vec2 place(int x, int y) const { return origin_ + Vec2{x + 0.5, y + 0.5} * cell_mm_; }
  /// In mm; infinite where nothing is barred.
  double distance_mm(int x, int y) const {
    const Cell n = nearest_[index(x, y)];
    return n == none ? INFINITY : cell_mm_ * std::sqrt(double(squared({x, y}, n)));
  }
  /// Whether the nearest barred places of this cell and of one of its neighbours lie far apart.
  bool is_between(int x, int y) const {
    const Cell n = nearest_[index(x, y)];
    if (n == none) return false;
    const double far = ridge_mm / cell_mm_;
    const auto lies_far = [&](int i, int j) {
      return i < columns_ && j<rows_&& double(squared(n, nearest_[index(i, j)]))> far * far;
    };
    return lies_far(x + 1, y) || lies_far(x, y + 1);
  }

 private:
  static constexpr Cell none{-1, -1};

  std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(columns_) + std::size_t(x); }
  static std::int64_t squared(Cell a, Cell b) {
    const std::int64_t dx = a.x - b.x, dy = a.y - b.y;
    return dx * dx + dy * dy;
  }
  void take(int x, int y, int i, int j) {
    if (i < 0 || j < 0 || i >= columns_ || j >= rows_) return;
    const Cell other = nearest_[index(i, j)];
    Cell& own = nearest_[index(x, y)];
    if (other == none || other == own) return;
    if (own == none || squared({x, y}, other) < squared({x, y}, own)) own = other;
  }
  /// Every cell asks its neighbours, forwards and back (Danielsson): off by less than a cell.
  void sweep() {
    for (int y = 0; y < rows_; ++y) {
      for (int x = 0; x < columns_; ++x) take(x, y, x - 1, y), take(x, y, x, y - 1), take(x, y, x - 1, y - 1);
      for (int x = columns_; x-- > 0;) take(x, y, x + 1, y), take(x, y, x + 1, y - 1);
    }
    for (int y = rows_; y-- > 0;) {
      for (int x = columns_; x-- > 0;) take(x, y, x + 1, y), take(x, y, x, y + 1), take(x, y, x + 1, y + 1);
      for (int x = 0; x < columns_; ++x) take(x, y, x - 1, y), take(x, y, x - 1, y + 1);
    }
  }

  Vec2 origin_;
  double cell_mm_ = field_mm;
  int columns_ = 0, rows_ = 0;
  std::vector<Cell> nearest_;  // that is barred
};

/// Ways around shapes and between them, thinned to one node for each square of pathway_mm.
void add_pathways(const TravelCost& cost, const Box<Vec2>& box, const RoadmapOptions& options, Nodes& nodes) {
  const Field field(cost, box);
  const int square = std::max(1, int(options.pathway_mm / field.cell_mm()));
  const int squares = field.columns() / square + 1;
  std::vector<char> around(std::size_t(squares), 0), between(std::size_t(squares), 0);
  for (int y = 0; y < field.rows(); ++y) {
    if (y % square == 0) std::ranges::fill(around, 0), std::ranges::fill(between, 0);
    for (int x = 0; x < field.columns(); ++x) {
      const double d = field.distance_mm(x, y);
      if (d == 0) continue;
      const auto s = std::size_t(x / square);
      if (!around[s] && std::abs(d - options.clearance_mm) < field.cell_mm() / 2) {
        around[s] = 1;
        nodes.add(field.place(x, y));
      } else if (!between[s] && d < 10 * options.clearance_mm && field.is_between(x, y)) {
        between[s] = 1;
        nodes.add(field.place(x, y));
      }
    }
  }
}

/// Along walls, for each nozzle; the more nozzles, and so walls, the further apart.
void add_wall(const Path& wall, const TravelCost& cost, const RoadmapOptions& options, Nodes& nodes) {
  const double spacing_mm = options.pathway_mm * double(std::max<std::size_t>(cost.nozzles().size(), 2));
  double rest = 0;
  for (std::size_t i = 0; i < wall.segments(); ++i) {
    const Vec2 a = wall.points[i], b = wall.points[(i + 1) % wall.points.size()];
    const double length = distance(a, b);
    for (; rest < length; rest += spacing_mm)
      for (const auto& n : cost.nozzles()) nodes.add(lerp(a, b, rest / length) - n.offset_mm);
    rest -= length;
  }
}

/// Edges of the Delaunay triangulation; nodes at one place are linked in a row.
std::vector<std::pair<std::uint32_t, std::uint32_t>> delaunay(const std::vector<Vec2>& nodes_mm) {
  using Site = boost::polygon::point_data<int>;
  std::vector<std::uint32_t> order(nodes_mm.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto site = [&](std::uint32_t i) {
    return Site(int(std::lround(nodes_mm[i].x * unit_per_mm)), int(std::lround(nodes_mm[i].y * unit_per_mm)));
  };
  std::vector<Site> all;
  for (const std::uint32_t i : order) all.push_back(site(i));
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(all[a].x(), all[a].y(), a) < std::tuple(all[b].x(), all[b].y(), b);
  });
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::vector<Site> sites;
  std::vector<std::uint32_t> node;  // of each site
  for (const std::uint32_t i : order) {
    if (!sites.empty() && sites.back() == all[i]) {
      edges.emplace_back(node.back(), i);
    } else {
      sites.push_back(all[i]);
      node.push_back(i);
    }
  }
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(sites.begin(), sites.end(), &diagram);
  for (const auto& edge : diagram.edges()) {
    const std::size_t a = edge.cell()->source_index(), b = edge.twin()->cell()->source_index();
    if (a < b) edges.emplace_back(node[a], node[b]);
  }
  return edges;
}

void add_arcs(Roadmap& map, const TravelCost& cost) {
  const auto edges = delaunay(map.nodes_mm);
  map.first_arc.assign(map.nodes_mm.size() + 1, 0);
  for (const auto& [a, b] : edges) ++map.first_arc[a + 1], ++map.first_arc[b + 1];
  std::partial_sum(map.first_arc.begin(), map.first_arc.end(), map.first_arc.begin());
  map.arcs.resize(2 * edges.size());
  std::vector<std::uint32_t> next(map.first_arc.begin(), map.first_arc.end() - 1);
  for (const auto& [a, b] : edges) {
    const TravelCost::Way way = cost.straight(map.nodes_mm[a], map.nodes_mm[b]);
    const double length_mm = distance(map.nodes_mm[a], map.nodes_mm[b]);
    map.arcs[next[a]++] = {b, float(way.cost), float(way.foreign), length_mm};
    const TravelCost::Way back = cost.is_directed() ? cost.straight(map.nodes_mm[b], map.nodes_mm[a]) : way;
    map.arcs[next[b]++] = {a, float(back.cost), float(back.foreign), length_mm};
  }
}

}  // namespace

Roadmap roadmap(std::span<const Path> paths, const TravelCost& cost, const RoadmapOptions& options) {
  Roadmap map;
  Nodes nodes(map);
  std::vector<Vec2> offset_mm;
  for (const auto& n : cost.nozzles()) {
    offset_mm.resize(std::max(offset_mm.size(), std::size_t(n.extruder) + 1));
    offset_mm[std::size_t(n.extruder)] = n.offset_mm;
  }
  std::map<std::pair<int, int>, std::vector<const Path*>> loops;  // of each extruder and island
  for (const Path& path : paths) {
    if (!path.closed || path.island < 0) continue;
    loops[{path.extruder, path.island}].push_back(&path);
    for (const Path& inner : path.inner) loops[{path.extruder, path.island}].push_back(&inner);
  }
  Box<Vec2> box;
  for (const Path& path : paths) {
    assert(std::size_t(path.extruder) < offset_mm.size());
    const Vec2 offset = offset_mm[std::size_t(path.extruder)];
    std::vector<Entry>& entries = map.entries.emplace_back();
    if (!path.closed) {
      const auto last = std::uint32_t(path.segments() - 1);
      entries.push_back({.node = nodes.add(path.points.front() - offset), .segment = 0, .at_mm = path.points.front()});
      entries.push_back({.node = nodes.add(path.points.back() - offset), .segment = last, .at_mm = path.points.back()});
    } else if (options.fixed_seams || path.road().role == Role::rampart) {
      entries.push_back({.node = nodes.add(path.start() - offset), .segment = 0, .at_mm = path.start()});
      const bool leads = options.leads && path.source < 0 && path.island >= 0 && begins_outer_wall(path);
      if (leads) entries.back().lead_mm = lead_mm(path, 0, path.start(), loops[{path.extruder, path.island}]);
    } else {
      add_entries(path, offset, cost, options, nodes, loops[{path.extruder, path.island}], entries);
    }
    for (const Vec2 p : path.points) box.add(p - offset);
  }
  if (box.empty()) return map;
  // Around all that lies there, for whichever nozzle is in use.
  if (!cost.map().box_mm().empty())
    for (const auto& n : cost.nozzles())
      for (const Vec2 p : {cost.map().box_mm().min, cost.map().box_mm().max}) box.add(p - n.offset_mm);
  const Vec2 margin{options.margin_mm, options.margin_mm};
  add_pathways(cost, {box.min - margin, box.max + margin}, options, nodes);
  for (const Path& path : paths)
    if (path.road().role == Role::rampart) add_wall(path, cost, options, nodes);
  for (const Vec2 c : map.nodes_mm) {
    std::uint32_t nozzles = 0;
    for (std::size_t k = 0; k < cost.nozzles().size(); ++k)
      nozzles |= std::uint32_t(TravelCost::reaches(cost.nozzles()[k], c)) << k;
    map.reached_by.push_back(nozzles);
  }
  add_arcs(map, cost);
  return map;
}

}  // namespace cleancolor
