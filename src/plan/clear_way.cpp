#include "plan/clear_way.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

namespace cleancolor {
namespace {

constexpr double coarse_mm = 0.5, fine_mm = 0.25, finest_mm = 0.08;
constexpr double near_mm = 8;         // hops that the finest is for, and its margin
constexpr double most_nodes = 1.5e6;  // further apart where there would be more
constexpr double wide_mm = 45;        // around both ends
constexpr float hurry = 1.5F;         // of the rest of the way: fewer nodes are looked at, a way may be a little dearer
constexpr double largest_pocket_mm2 = 1500;

/// Nodes so far apart, the first end on one of them, each joined to its eight neighbours.
class Grid {
 public:
  Grid(const TravelCost& cost, int extruder, Vec2 from_mm, Vec2 to_mm, double cell_mm, double margin_mm)
      : cost_(cost),
        nozzle_(*std::ranges::find(cost.nozzles(), extruder, &TravelCost::Nozzle::extruder)),
        from_mm_(from_mm),
        to_mm_(to_mm) {
    const Vec2 box{std::abs(to_mm.x - from_mm.x) + 2 * margin_mm, std::abs(to_mm.y - from_mm.y) + 2 * margin_mm};
    cell_mm_ = std::max(cell_mm, std::sqrt(box.x * box.y / most_nodes));
    const auto cells = [&](double mm) { return int(std::ceil(mm / cell_mm_)) + border; };
    const int left = cells(std::max(0., from_mm.x - to_mm.x) + margin_mm);
    const int below = cells(std::max(0., from_mm.y - to_mm.y) + margin_mm);
    columns_ = left + cells(std::max(0., to_mm.x - from_mm.x) + margin_mm) + 1;
    const int rows = below + cells(std::max(0., to_mm.y - from_mm.y) + margin_mm) + 1;
    rows_of_node_ = 1. / columns_;
    low_ = from_mm - Vec2{double(left), double(below)} * cell_mm_;
    from_ = node(left, below);
    const Vec2 to = (to_mm - low_) * (1 / cell_mm_);
    to_ = node(int(std::lround(to.x)), int(std::lround(to.y)));
    passable_.assign(std::size_t(node(0, rows)), unknown);
    for (int x = 0; x < columns_; ++x) passable_[at(node(x, 0))] = passable_[at(node(x, rows - 1))] = no;
    for (int y = 0; y < rows; ++y) passable_[at(node(0, y))] = passable_[at(node(columns_ - 1, y))] = no;
    over_.resize(passable_.size(), NAN);
  }

  /// Whether nodes that can be passed lead from one end to the other, or may do so. Floods from both in turn: where one
  /// of them lies in a pocket that is soon known; where both lie in larger areas, a search must tell.
  bool may_hang_together() {
    if (!is_passable(from_) || !is_passable(to_)) return false;
    std::vector<char> side(passable_.size(), 0);  // by which end a node was found
    std::array<std::vector<int>, 2> found{std::vector{from_}, std::vector{to_}};
    side[at(from_)] = 1;
    if (side[at(to_)] == 1) return true;
    side[at(to_)] = 2;
    const auto most = std::size_t(largest_pocket_mm2 / (cell_mm_ * cell_mm_));
    for (std::size_t next = 0; next < most; ++next)
      for (const std::size_t end : {0U, 1U}) {
        if (next >= found[end].size()) return false;
        bool met = false;
        for_neighbours(found[end][next], [&](int node, double) {
          char& s = side[at(node)];
          met = met || (s != 0 && s != char(end + 1));
          if (s == 0) found[end].push_back(node), s = char(end + 1);
        });
        if (met) return true;
      }
    return true;
  }

  /// Of the nodes that a cheap clear way passes; empty: none is so short. Can be asked once.
  std::vector<Vec2> cheap(double longest_mm) {
    using Label = std::pair<float, int>;  // cost with the estimated rest, node
    struct Known {
      float cost = std::numeric_limits<float>::infinity(), way_mm = 0;
      int before = 0;
    };
    std::vector<Known> known(passable_.size());
    std::vector<Label> heap{{0, from_}};
    known[at(from_)] = {.cost = 0, .before = from_};
    while (!heap.empty()) {
      std::ranges::pop_heap(heap, std::greater());
      const int node = heap.back().second;
      heap.pop_back();
      if (passable_[at(node)] == no) continue;
      passable_[at(node)] = no;  // it is settled
      const Known here = known[at(node)];
      if (node == to_) return read_back(known);
      for_neighbours(node, [&](int other, double edge_mm) {
        Known& there = known[at(other)];
        const float cost = here.cost + float(edge_mm) * (1 + (over(node) + over(other)) / 2);
        const float way_mm = here.way_mm + float(edge_mm);
        if (cost >= there.cost) return;
        const auto rest_mm = float(std::sqrt(length_squared(place(other) - to_mm_)));
        if (way_mm + rest_mm > longest_mm || cost_.crosses(place(node), place(other), hardly_visible)) return;
        there = {cost, way_mm, node};
        heap.emplace_back(cost + hurry * rest_mm, other);
        std::ranges::push_heap(heap, std::greater());
      });
    }
    return {};
  }

 private:
  static constexpr int border = 1;  // nodes that nothing passes, on all sides
  enum Passable : char { unknown, yes, no };

  static std::size_t at(int node) { return std::size_t(node); }
  int node(int x, int y) const { return y * columns_ + x; }
  Vec2 place(int node) const {
    if (node == to_) return to_mm_;
    const int row = int((node + 0.5) * rows_of_node_);
    return low_ + Vec2{double(node - row * columns_), double(row)} * cell_mm_;
  }

  /// Whether the nozzle reaches the node, and none there hangs over what is barred.
  bool is_passable(int node) {
    char& known = passable_[at(node)];
    if (known == unknown) {
      const Vec2 p = place(node);
      const bool is_reached = node == from_ || node == to_ || TravelCost::reaches(nozzle_, p);
      known = is_reached && !cost_.is_barred(p, hardly_visible) ? yes : no;
    }
    return known == yes;
  }

  /// Of a mm there, beside the way itself.
  float over(int node) {
    float& known = over_[at(node)];
    if (std::isnan(known)) known = float(cost_.over(place(node)));
    return known;
  }

  template <class Visit>
  void for_neighbours(int node, Visit visit) {
    const int row = columns_;
    for (const int other : {node - row, node - 1, node + 1, node + row})
      if (is_passable(other)) visit(other, cell_mm_);
    for (const int other : {node - row - 1, node - row + 1, node + row - 1, node + row + 1})
      if (is_passable(other)) visit(other, cell_mm_ * std::numbers::sqrt2);
  }

  template <class Known>
  std::vector<Vec2> read_back(const std::vector<Known>& known) const {
    std::vector<Vec2> way{to_mm_};
    for (int node = known[at(to_)].before; node != from_; node = known[at(node)].before) way.push_back(place(node));
    way.push_back(from_mm_);
    std::ranges::reverse(way);
    return way;
  }

  const TravelCost& cost_;
  double cell_mm_ = fine_mm;
  const TravelCost::Nozzle& nozzle_;
  Vec2 from_mm_, to_mm_, low_;
  int columns_ = 0;
  double rows_of_node_ = 0;  // 1 / columns_
  int from_ = 0, to_ = 0;
  std::vector<char> passable_;
  std::vector<float> over_;  // NaN: not known yet
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
  const auto grid = [&](double cell_mm, double margin_mm) {
    return Grid(cost, extruder, from_mm, to_mm, cell_mm, margin_mm);
  };
  const auto is_clear = [&](const std::vector<Vec2>& way) { return !way.empty() && !crosses(cost, way); };
  std::vector<Vec2> way;
  // Between the nodes of the coarse grid lie whole walls: only the fine one knows whether there may be a way.
  if (Grid fine = grid(fine_mm, wide_mm); fine.may_hang_together()) {
    way = grid(coarse_mm, wide_mm).cheap(longest_mm);
    if (!is_clear(way)) way = fine.cheap(longest_mm);
  }
  // Both ends within one cell, or a gap that lies between nodes.
  if (!is_clear(way) && distance(from_mm, to_mm) < near_mm) {
    Grid finest = grid(finest_mm, near_mm);
    way = finest.may_hang_together() ? finest.cheap(longest_mm) : std::vector<Vec2>{};
  }
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
