// tests/plan/paper_grid.hpp
//
// Paper grid: section 6.4 of Clean color to the letter, slow and obvious; what the roadmap is compared with.
//
//   what lies where, paths in order  ->  the cheapest tour over a fine grid, and what any way costs on it
//
//   cost of an edge p -> q  =  W_d |pq| / extent  +  sum over nozzles i of M_i(q + delta_i) ao(q + delta_i)
//   W_d = 0.1; M_i = 10 over another colour, else 0; along the rampart a tenth; Z = ao where a path is entered and left
//
// Every cell is a node, joined to its eight neighbours; the paper has only those on its pathways, so its tours are no
// cheaper. A closed path can be entered at each of its nodes, an open one at both ends.
#pragma once

#include <cmath>
#include <limits>
#include <queue>
#include <span>
#include <vector>

#include "plan/layer_map.hpp"
#include "toolpath/path.hpp"

namespace cleancolor::test {

class PaperGrid {
 public:
  /// offsets_mm: of each extruder's nozzle. The grid covers the map for every nozzle, and margin_mm more.
  PaperGrid(const LayerMap& map, std::vector<Vec2> offsets_mm, double extent_mm, double cell_mm = 0.05,
            double margin_mm = 7)
      : map_(map), offsets_mm_(std::move(offsets_mm)), extent_mm_(extent_mm), cell_mm_(cell_mm) {
    Box<Vec2> box;
    for (const Vec2 offset : offsets_mm_)
      for (const Vec2 p : {map.box_mm().min, map.box_mm().max}) box.add(p - offset);
    low_ = box.min - Vec2{margin_mm, margin_mm};
    columns_ = int((box.size().x + 2 * margin_mm) / cell_mm) + 1;
    rows_ = int((box.size().y + 2 * margin_mm) / cell_mm) + 1;
    for (int i = 0; i < columns_ * rows_; ++i) mismatch_.push_back(mismatch(place(i)));
  }

  struct Tour {
    double cost = 0;
    std::vector<std::vector<Vec2>> ways_mm;  // of the carriage, from where path k - 1 ends to where path k begins
    std::vector<Vec2> starts_mm;             // of each path, where the plastic lies
    std::vector<Vec2> ends_mm;
  };

  Tour tour(std::span<const Path> paths) const {
    std::vector<std::vector<Node>> nodes;
    std::vector<std::vector<double>> entered(paths.size());  // of each node, with what entering and leaving costs
    std::vector<std::vector<int>> before(paths.size());      // of each cell
    for (const Path& path : paths) nodes.push_back(nodes_of(path));
    for (std::size_t k = 0; k < paths.size(); ++k) {
      std::vector<double> cost;
      if (k > 0) {
        cost.assign(mismatch_.size(), std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < nodes[k - 1].size(); ++i) {
          double& c = cost[std::size_t(nodes[k - 1][exit_of(paths[k - 1], i)].cell)];
          c = std::min(c, entered[k - 1][i]);
        }
        settle(cost, before[k]);
      }
      for (std::size_t i = 0; i < nodes[k].size(); ++i)
        entered[k].push_back((k > 0 ? cost[std::size_t(nodes[k][i].cell)] : 0) + ao(nodes[k][i].at_mm) +
                             ao(nodes[k][exit_of(paths[k], i)].at_mm));
    }
    return read_back(paths, nodes, entered, before);
  }

  /// What a way of the carriage costs, in edges of at most 0.05 mm.
  double cost_of(std::span<const Vec2> way) const {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      const int edges = std::max(1, int(std::ceil(distance(way[i], way[i + 1]) / 0.05 - 1e-9)));
      for (int e = 0; e < edges; ++e) {
        const Vec2 p = lerp(way[i], way[i + 1], double(e) / edges), q = lerp(way[i], way[i + 1], (e + 1.) / edges);
        sum += edge(p, q, mismatch(q));
      }
    }
    return sum;
  }

  /// Visibility of a place, in [0, 1].
  double ao(Vec2 p_mm) const { return map_.at(p_mm).visibility / 255.; }

 private:
  struct Node {
    Vec2 at_mm;  // on the path
    int cell = 0;
  };
  static std::size_t exit_of(const Path& path, std::size_t i) { return path.closed ? i : 1 - i; }

  Vec2 place(int i) const { return low_ + Vec2{i % columns_ + 0.5, i / columns_ + 0.5} * cell_mm_; }
  int cell(Vec2 p) const { return int((p.y - low_.y) / cell_mm_) * columns_ + int((p.x - low_.x) / cell_mm_); }

  /// Sum over nozzles of M x ao, the carriage at q.
  double mismatch(Vec2 q) const {
    double sum = 0;
    for (std::size_t i = 0; i < offsets_mm_.size(); ++i) {
      const LayerMap::Cell c = map_.at(q + offsets_mm_[i]);
      if (c.extruder != LayerMap::air && c.extruder != int(i)) sum += 10 * c.visibility / 255.;
    }
    return sum;
  }
  double edge(Vec2 p, Vec2 q, double mismatch_at_q) const {
    bool along_rampart = false;
    for (const Vec2 offset : offsets_mm_) {
      const int wall = map_.at(q + offset).wall;
      along_rampart = along_rampart || (wall != 0 && wall == map_.at(p + offset).wall);
    }
    return (0.1 * distance(p, q) / extent_mm_ + mismatch_at_q) * (along_rampart ? 0.1 : 1);
  }

  std::vector<Node> nodes_of(const Path& path) const {
    const Vec2 offset = offsets_mm_[std::size_t(path.extruder)];
    const auto node = [&](Vec2 p) { return Node{p, cell(p - offset)}; };
    if (!path.closed) return {node(path.points.front()), node(path.points.back())};
    if (path.road().role == Role::rampart) return {node(path.start())};
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < path.segments(); ++i) {
      const Vec2 a = path.points[i], b = path.points[(i + 1) % path.points.size()];
      const int steps = int(distance(a, b) / cell_mm_) + 1;
      for (int s = 0; s < steps; ++s) nodes.push_back(node(lerp(a, b, double(s) / steps)));
    }
    return nodes;
  }

  /// Dijkstra from all cells that have a cost.
  void settle(std::vector<double>& cost, std::vector<int>& before) const {
    using Label = std::pair<double, int>;
    std::priority_queue<Label, std::vector<Label>, std::greater<>> queue;
    before.assign(cost.size(), -1);
    for (std::size_t i = 0; i < cost.size(); ++i)
      if (cost[i] < std::numeric_limits<double>::infinity()) queue.emplace(cost[i], int(i));
    while (!queue.empty()) {
      const auto [c, i] = queue.top();
      queue.pop();
      if (c > cost[std::size_t(i)]) continue;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int x = i % columns_ + dx, y = i / columns_ + dy, j = y * columns_ + x;
          if (x < 0 || y < 0 || x >= columns_ || y >= rows_ || j == i) continue;
          const double next = c + edge(place(i), place(j), mismatch_[std::size_t(j)]);
          if (next >= cost[std::size_t(j)]) continue;
          before[std::size_t(j)] = i;
          queue.emplace(cost[std::size_t(j)] = next, j);
        }
    }
  }

  Tour read_back(std::span<const Path> paths, const std::vector<std::vector<Node>>& nodes,
                 const std::vector<std::vector<double>>& entered, const std::vector<std::vector<int>>& before) const {
    Tour tour;
    tour.ways_mm.resize(paths.size());
    tour.starts_mm.resize(paths.size());
    tour.ends_mm.resize(paths.size());
    std::size_t i =
        std::size_t(std::min_element(entered.back().begin(), entered.back().end()) - entered.back().begin());
    tour.cost = entered.back()[i];
    for (std::size_t k = paths.size(); k-- > 0;) {
      tour.starts_mm[k] = nodes[k][i].at_mm;
      tour.ends_mm[k] = nodes[k][exit_of(paths[k], i)].at_mm;
      if (k == 0) break;
      std::vector<Vec2>& way = tour.ways_mm[k];
      int c = nodes[k][i].cell;
      for (; c >= 0; c = before[k][std::size_t(c)]) way.insert(way.begin(), place(c));
      const int left = cell(way.front());
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t n = 0; n < nodes[k - 1].size(); ++n)
        if (nodes[k - 1][exit_of(paths[k - 1], n)].cell == left && entered[k - 1][n] < least)
          least = entered[k - 1][n], i = n;
    }
    return tour;
  }

  const LayerMap& map_;
  std::vector<Vec2> offsets_mm_;
  double extent_mm_, cell_mm_;
  Vec2 low_;
  int columns_ = 0, rows_ = 0;
  std::vector<double> mismatch_;  // of each cell
};

}  // namespace cleancolor::test
