#include "plan/clear_way.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace cleancolor {
namespace {

constexpr double hardly_visible = 0.05;
constexpr double cell_mm = 0.25;
constexpr double margin_mm = 45;  // around both ends
constexpr int nobody = -1;

/// Nodes every 0.25 mm, the first end on one of them, each joined to its eight neighbours.
class Grid {
 public:
  Grid(const TravelCost& cost, int extruder, Vec2 from_mm, Vec2 to_mm)
      : cost_(cost),
        nozzle_(*std::ranges::find(cost.nozzles(), extruder, &TravelCost::Nozzle::extruder)),
        from_mm_(from_mm),
        to_mm_(to_mm) {
    const auto cells = [](double mm) { return int(std::ceil(mm / cell_mm)); };
    const int left = cells(std::max(0., from_mm.x - to_mm.x) + margin_mm);
    const int below = cells(std::max(0., from_mm.y - to_mm.y) + margin_mm);
    columns_ = left + cells(std::max(0., to_mm.x - from_mm.x) + margin_mm) + 1;
    rows_ = below + cells(std::max(0., to_mm.y - from_mm.y) + margin_mm) + 1;
    low_ = from_mm - Vec2{double(left), double(below)} * cell_mm;
    from_ = below * columns_ + left;
    const Vec2 to = (to_mm - low_) * (1 / cell_mm);
    to_ = int(std::lround(to.y)) * columns_ + int(std::lround(to.x));
    passable_.resize(size());
  }

  /// Whether nodes that can be passed lead from one end to the other. Floods from both in turn: where one of them lies
  /// in a pocket that is soon known.
  bool hangs_together() {
    if (!is_passable(from_) || !is_passable(to_)) return false;
    std::vector<char> side(size(), 0);  // by which end a node was found
    std::array<std::vector<int>, 2> found{std::vector{from_}, std::vector{to_}};
    side[std::size_t(from_)] = 1;
    if (side[std::size_t(to_)] == 1) return true;
    side[std::size_t(to_)] = 2;
    for (std::size_t next = 0;; ++next)
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
  }

  /// Of the nodes that the cheapest way passes; empty: none is so short.
  std::vector<Vec2> cheapest(double longest_mm) {
    using Label = std::pair<double, int>;
    std::vector<double> cost(size(), std::numeric_limits<double>::infinity()), way_mm(size(), 0);
    std::vector<int> before(size(), nobody);
    const auto rest_mm = [&](int node) { return distance(place(node), place(to_)); };
    std::vector<Label> heap{{rest_mm(from_), from_}};
    cost[std::size_t(from_)] = 0;
    while (!heap.empty()) {
      std::ranges::pop_heap(heap, std::greater());
      const auto [estimate, node] = heap.back();
      heap.pop_back();
      const auto i = std::size_t(node);
      if (node == to_) return read_back(before);
      if (estimate > cost[i] + rest_mm(node) + 1e-9) continue;
      for_neighbours(node, [&](int other) {
        const auto k = std::size_t(other);
        if (cost[i] + distance(place(node), place(other)) >= cost[k]) return;
        if (cost_.crosses(place(node), place(other), hardly_visible)) return;
        const double length = way_mm[i] + distance(place(node), place(other));
        const double c = cost[i] + cost_.way(place(node), place(other));
        if (c >= cost[k] || length + rest_mm(other) > longest_mm) return;
        cost[k] = c;
        way_mm[k] = length;
        before[k] = node;
        heap.emplace_back(cost[k] + rest_mm(other), other);
        std::ranges::push_heap(heap, std::greater());
      });
    }
    return {};
  }

 private:
  std::size_t size() const { return std::size_t(columns_) * std::size_t(rows_); }
  Vec2 place(int node) const {
    return node == to_ ? to_mm_ : low_ + Vec2{double(node % columns_), double(node / columns_)} * cell_mm;
  }

  /// Whether the nozzle reaches the node, and none there hangs over what is barred.
  bool is_passable(int node) {
    char& known = passable_[std::size_t(node)];
    if (known == 0) {
      const bool is_end = node == from_ || node == to_;
      const bool is_reached = is_end || TravelCost::reaches(nozzle_, place(node));
      known = is_reached && !cost_.crosses(place(node), place(node), hardly_visible) ? 1 : 2;
    }
    return known == 1;
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
  const TravelCost::Nozzle& nozzle_;
  Vec2 from_mm_, to_mm_, low_;
  int columns_ = 0, rows_ = 0;
  int from_ = 0, to_ = 0;
  std::vector<char> passable_;  // 0: not known yet, 1: yes, 2: no
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
  Grid grid(cost, extruder, from_mm, to_mm);
  if (!grid.hangs_together()) return {};
  const std::vector<Vec2> way = grid.cheapest(longest_mm);
  return way.empty() ? way : pulled(way, cost);
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
