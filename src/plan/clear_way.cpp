#include "plan/clear_way.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace cleancolor {
namespace {

constexpr double coarse_mm = 0.5, fine_mm = 0.25, finest_mm = 0.08;
constexpr double near_mm = 8;         // hops that the finest is for, and its margin
constexpr double most_nodes = 1.5e6;  // further apart where there would be more
constexpr double wide_mm = 45;        // around both ends
constexpr double coarse_hurry = 2.5;  // of the rest of the way: fewer nodes are looked at, a way may be a little dearer
constexpr double largest_pocket_mm2 = 1500;
constexpr int nobody = -1;

/// Nodes so far apart, the first end on one of them, each joined to its eight neighbours. Coarse ones need room around
/// them, and edges between them are judged by their ends alone; fine ones find every gap.
class Grid {
 public:
  Grid(const TravelCost& cost, int extruder, Vec2 from_mm, Vec2 to_mm, double cell_mm, double margin_mm)
      : cost_(cost),
        is_coarse_(cell_mm > fine_mm),
        nozzle_(*std::ranges::find(cost.nozzles(), extruder, &TravelCost::Nozzle::extruder)),
        from_mm_(from_mm),
        to_mm_(to_mm) {
    const Vec2 box{std::abs(to_mm.x - from_mm.x) + 2 * margin_mm, std::abs(to_mm.y - from_mm.y) + 2 * margin_mm};
    cell_mm_ = std::max(cell_mm, std::sqrt(box.x * box.y / most_nodes));
    const auto cells = [&](double mm) { return int(std::ceil(mm / cell_mm_)); };
    const int left = cells(std::max(0., from_mm.x - to_mm.x) + margin_mm);
    const int below = cells(std::max(0., from_mm.y - to_mm.y) + margin_mm);
    columns_ = left + cells(std::max(0., to_mm.x - from_mm.x) + margin_mm) + 1;
    rows_ = below + cells(std::max(0., to_mm.y - from_mm.y) + margin_mm) + 1;
    low_ = from_mm - Vec2{double(left), double(below)} * cell_mm_;
    from_ = below * columns_ + left;
    const Vec2 to = (to_mm - low_) * (1 / cell_mm_);
    to_ = int(std::lround(to.y)) * columns_ + int(std::lround(to.x));
    passable_.resize(size());
    node_cost_.resize(size());
  }

  /// Whether nodes that can be passed lead from one end to the other, or may do so. Floods from both in turn: where one
  /// of them lies in a pocket that is soon known; where both lie in larger areas, a search must tell.
  bool may_hang_together() {
    if (!is_passable(from_) || !is_passable(to_)) return false;
    std::vector<char> side(size(), 0);  // by which end a node was found
    std::array<std::vector<int>, 2> found{std::vector{from_}, std::vector{to_}};
    side[std::size_t(from_)] = 1;
    if (side[std::size_t(to_)] == 1) return true;
    side[std::size_t(to_)] = 2;
    const auto most = std::size_t(largest_pocket_mm2 / (cell_mm_ * cell_mm_));
    for (std::size_t next = 0; next < most; ++next)
      for (const std::size_t end : {0U, 1U}) {
        if (next >= found[end].size()) return false;
        bool met = false;
        for_neighbours(found[end][next], [&](int node) {
          char& s = side[std::size_t(node)];
          met = met || (s != 0 && s != char(end + 1));
          if (s == 0) found[end].push_back(node), s = char(end + 1);
        });
        if (met) return true;
      }
    return true;
  }

  /// Of the nodes that the cheapest way passes; empty: none is so short.
  std::vector<Vec2> cheapest(double longest_mm) {
    using Label = std::pair<double, int>;
    std::vector<double> cost(size(), std::numeric_limits<double>::infinity()), way_mm(size(), 0);
    std::vector<int> before(size(), nobody);
    const auto rest_mm = [&](int node) { return distance(place(node), place(to_)); };
    const double hurry = is_coarse_ ? coarse_hurry : 1;
    std::vector<Label> heap{{hurry * rest_mm(from_), from_}};
    cost[std::size_t(from_)] = 0;
    while (!heap.empty()) {
      std::ranges::pop_heap(heap, std::greater());
      const auto [estimate, node] = heap.back();
      heap.pop_back();
      const auto i = std::size_t(node);
      if (node == to_) return read_back(before);
      if (estimate > cost[i] + hurry * rest_mm(node) + 1e-9) continue;
      for_neighbours(node, [&](int other) {
        const auto k = std::size_t(other);
        const bool is_straight = node / columns_ == other / columns_ || node % columns_ == other % columns_;
        const double edge_mm = node == to_ || other == to_ ? distance(place(node), place(other))
                                                           : cell_mm_ * (is_straight ? 1 : std::numbers::sqrt2);
        if (cost[i] + edge_mm >= cost[k]) return;
        if (!is_coarse_ && cost_.crosses(place(node), place(other), hardly_visible)) return;
        const double length = way_mm[i] + edge_mm;
        const double c = cost[i] + (is_coarse_ ? edge_mm * (node_cost(node) + node_cost(other)) / 2
                                               : cost_.way(place(node), place(other)));
        if (c >= cost[k] || length + rest_mm(other) > longest_mm) return;
        cost[k] = c;
        way_mm[k] = length;
        before[k] = node;
        heap.emplace_back(cost[k] + hurry * rest_mm(other), other);
        std::ranges::push_heap(heap, std::greater());
      });
    }
    return {};
  }

 private:
  std::size_t size() const { return std::size_t(columns_) * std::size_t(rows_); }
  Vec2 place(int node) const {
    return node == to_ ? to_mm_ : low_ + Vec2{double(node % columns_), double(node / columns_)} * cell_mm_;
  }

  /// Whether the nozzle reaches the node, and none there hangs over what is barred.
  bool is_passable(int node) {
    char& known = passable_[std::size_t(node)];
    if (known == 0) {
      const bool is_end = node == from_ || node == to_;
      const bool is_reached = is_end || TravelCost::reaches(nozzle_, place(node));
      known = is_reached && is_clear(place(node), is_end ? 0 : cell_mm_) ? 1 : 2;
    }
    return known == 1;
  }
  bool is_clear(Vec2 p, double room_mm) const {
    if (cost_.is_barred(p, hardly_visible)) return false;
    if (!is_coarse_ || room_mm == 0) return true;
    const auto is_barred = [&](Vec2 aside) { return cost_.is_barred(p + aside * room_mm, hardly_visible); };
    return std::ranges::none_of(std::array{Vec2{1, 0}, Vec2{-1, 0}, Vec2{0, 1}, Vec2{0, -1}}, is_barred);
  }

  /// Of a mm there.
  double node_cost(int node) {
    float& known = node_cost_[std::size_t(node)];
    if (known == 0) known = float(1 + cost_.over(place(node)));
    return double(known);
  }

  template <class Visit>
  void for_neighbours(int node, Visit visit) {
    const int column = node % columns_, row = node / columns_;
    for (int y = std::max(0, row - 1); y <= std::min(rows_ - 1, row + 1); ++y)
      for (int x = std::max(0, column - 1); x <= std::min(columns_ - 1, column + 1); ++x)
        if (const int other = y * columns_ + x; other != node && is_passable(other)) visit(other);
  }

  std::vector<Vec2> read_back(const std::vector<int>& before) const {
    std::vector<Vec2> way;
    for (int node = to_; node != nobody; node = before[std::size_t(node)]) way.push_back(place(node));
    way.push_back(from_mm_);
    std::ranges::reverse(way);
    return way;
  }

  const TravelCost& cost_;
  double cell_mm_ = fine_mm;
  bool is_coarse_;
  const TravelCost::Nozzle& nozzle_;
  Vec2 from_mm_, to_mm_, low_;
  int columns_ = 0, rows_ = 0;
  int from_ = 0, to_ = 0;
  std::vector<char> passable_;    // 0: not known yet, 1: yes, 2: no
  std::vector<float> node_cost_;  // 0: not known yet
};

/// Leaves out places that a straight way, as clear, costs no more without.
std::vector<Vec2> pulled(const std::vector<Vec2>& way, const TravelCost& cost) {
  std::vector<Vec2> result{way.front()};
  double cost_here = 0;  // since the last place that stays
  for (std::size_t i = 1; i + 1 < way.size(); ++i) {
    cost_here += cost.way(way[i - 1], way[i]);
    const double without = cost.way(result.back(), way[i + 1]), with = cost_here + cost.way(way[i], way[i + 1]);
    if (without <= with + 1e-9 && !cost.crosses(result.back(), way[i + 1], hardly_visible)) continue;
    result.push_back(way[i]);
    cost_here = 0;
  }
  result.push_back(way.back());
  return result;
}

}  // namespace

bool crosses(const TravelCost& cost, std::span<const Vec2> way) {
  for (std::size_t i = 0; i + 1 < way.size(); ++i)
    if (cost.crosses(way[i], way[i + 1], hardly_visible)) return true;
  return false;
}

std::vector<Vec2> clear_way(const TravelCost& cost, int extruder, Vec2 from_mm, Vec2 to_mm, double longest_mm) {
  const auto search = [&](double cell_mm, double margin_mm) {
    Grid grid(cost, extruder, from_mm, to_mm, cell_mm, margin_mm);
    return grid.may_hang_together() ? grid.cheapest(longest_mm) : std::vector<Vec2>{};
  };
  const auto is_clear = [&](const std::vector<Vec2>& way) { return !way.empty() && !crosses(cost, way); };
  std::vector<Vec2> way = search(coarse_mm, wide_mm);
  if (!is_clear(way)) way = search(fine_mm, wide_mm);
  // Both ends within one cell, or a gap that lies between nodes.
  if (!is_clear(way) && distance(from_mm, to_mm) < near_mm) way = search(finest_mm, near_mm);
  return is_clear(way) ? pulled(way, cost) : std::vector<Vec2>{};
}

std::vector<Vec2> clearest_way_between(const Roadmap& map, const TravelCost& cost, int extruder, Vec2 from_mm,
                                       Vec2 to_mm, double longest_mm) {
  std::vector<Vec2> between = way_between(map, cost, extruder, from_mm, to_mm).between_mm;
  std::vector<Vec2> way{from_mm};
  way.insert(way.end(), between.begin(), between.end());
  way.push_back(to_mm);
  if (!crosses(cost, way)) return between;
  const std::vector<Vec2> clear = clear_way(cost, extruder, from_mm, to_mm, longest_mm);
  if (clear.size() > 1) between.assign(clear.begin() + 1, clear.end() - 1);
  return between;
}

}  // namespace cleancolor
