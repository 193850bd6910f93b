// plan/search.hpp
//
// Search: shortest paths on a roadmap from several places to several others, one search after another.
//
//   roadmap, costs; seeds, targets  ->  cost, length and way of each target
//
// Dijkstra with a bound: a search ends a little beyond the best target. What one search found is forgotten by the next,
// at the cost of what it touched alone.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "plan/roadmap.hpp"

namespace cleancolor {

inline constexpr double unreached = std::numeric_limits<double>::infinity();
inline constexpr std::uint32_t nobody = 0xFFFFFFFF;

/// Nodes that ways lead to, and the one before each, by node.
using Predecessors = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// nobody: a way begins there.
inline std::uint32_t before(const Predecessors& log, std::uint32_t node) {
  const auto found = std::ranges::lower_bound(log, node, {}, &Predecessors::value_type::first);
  return found != log.end() && found->first == node ? found->second : nobody;
}

/// One shortest path search after another over the same nodes.
class Search {
 public:
  Search(const Roadmap& map, const TravelCost& travel)
      : map_(map),
        travel_(travel),
        cost_(map.nodes_mm.size(), unreached),
        way_mm_(cost_.size()),
        dirty_mm_(cost_.size()),
        before_(cost_.size(), nobody),
        extra_(cost_.size()),
        wanted_(cost_.size(), 0) {}

  struct Seed {
    std::uint32_t node = 0;
    double cost = 0;
    double mm_cost = 0;  // backwards: what each mm of way to it costs beside
  };
  enum class Direction { forwards, backwards };

  /// Settles nodes from the seeds until all targets have their cost, or are more than `slack` dearer than the best,
  /// with what entering there costs. Only places that the nozzle in use reaches, an index of the cost's nozzles, are
  /// passed.
  ///
  /// Backwards, ways lead from the targets to the seeds. What a touch and the begin of a wall cost for the mm before
  /// them is then known at once, and charged mm by mm.
  void run(std::span<const Seed> seeds, std::span<const Seed> targets, int nozzle, double slack,
           Direction direction = Direction::forwards) {
    const bool is_back = direction == Direction::backwards;
    forget();
    if (is_back) later_.resize(cost_.size());
    std::size_t open = 0;
    for (const Seed& t : targets) {
      known_.push_back(t.node);
      open += wanted_[t.node] == 0;
      extra_[t.node] = wanted_[t.node] == 0 ? t.cost : std::min(extra_[t.node], t.cost);
      wanted_[t.node] = 1;
    }
    for (const Seed& s : seeds) {
      if (is_back && s.cost < cost_[s.node]) later_[s.node] = {s.mm_cost, 0};
      offer(s.node, s.cost, 0, nobody);
    }
    double end = unreached;
    while (!heap_.empty() && open > 0) {
      std::ranges::pop_heap(heap_, std::greater());
      const auto [cost, node] = heap_.back();
      heap_.pop_back();
      if (cost > cost_[node]) continue;
      if (cost > end) break;
      if (wanted_[node] == 1) {
        wanted_[node] = 2;
        --open;
        end = std::min(end, cost + extra_[node] + slack);
      }
      for (const Arc& arc : map_.arcs_of(node)) {
        const double length = distance(map_.nodes_mm[node], map_.nodes_mm[arc.to]);
        double c = cost + double(arc.cost);
        Later later;
        if (is_back) {
          later = later_[node];
          if (arc.foreign > 0) later.foreign = double(arc.foreign);
          c += travel_.smear(later.foreign, length) + later.mm_cost * length;
        } else if (arc.foreign > 0) {
          c += travel_.smear(double(arc.foreign), dirty_mm_[node] + length);
        }
        if (c >= cost_[arc.to]) continue;
        if ((map_.reached_by[arc.to] >> nozzle & 1) == 0 && wanted_[arc.to] == 0) continue;
        offer(arc.to, c, way_mm_[node] + length, node);
        dirty_mm_[arc.to] = arc.foreign > 0 ? 0 : dirty_mm_[node] + length;
        if (is_back) later_[arc.to] = later;
      }
    }
    // What was reached but not settled is no shortest path yet.
    for (const Seed& t : targets)
      if (wanted_[t.node] == 1) cost_[t.node] = unreached;
    const auto is_reached = [&](const Seed& t) { return cost_[t.node] < unreached; };
    if (std::ranges::none_of(targets, is_reached)) go_straight(seeds, targets);
  }

  double cost(std::uint32_t node) const { return cost_[node]; }
  double way_mm(std::uint32_t node) const { return way_mm_[node]; }
  /// The nodes that ways lead to, and the one before each, by node.
  Predecessors predecessors() const {
    Predecessors log;
    for (const std::uint32_t node : known_)
      if (before_[node] != nobody) log.emplace_back(node, before_[node]);
    std::ranges::sort(log);
    return log;
  }
  /// Where the way to the node begins.
  std::uint32_t begin_of(std::uint32_t node) const {
    while (before_[node] != nobody) node = before_[node];
    return node;
  }

 private:
  /// What the search before found.
  void forget() {
    for (const std::uint32_t node : known_) cost_[node] = unreached, before_[node] = nobody, wanted_[node] = 0;
    known_.clear();
    heap_.clear();
  }

  /// Where places within reach do not hang together.
  void go_straight(std::span<const Seed> seeds, std::span<const Seed> targets) {
    for (const std::uint32_t node : known_) before_[node] = nobody;
    for (const Seed& s : seeds) cost_[s.node] = s.cost;
    for (const auto& [t, extra, mm_cost] : targets)
      for (const Seed& s : seeds) {
        const double length = distance(map_.nodes_mm[s.node], map_.nodes_mm[t]);
        const double c = s.cost + travel_.way(map_.nodes_mm[s.node], map_.nodes_mm[t]) + s.mm_cost * length;
        if (c >= cost_[t]) continue;
        cost_[t] = c;
        way_mm_[t] = length;
        before_[t] = s.node == t ? nobody : s.node;
      }
  }

  void offer(std::uint32_t node, double cost, double way_mm, std::uint32_t from) {
    if (cost >= cost_[node]) return;
    if (cost_[node] == unreached) known_.push_back(node);
    cost_[node] = cost;
    way_mm_[node] = dirty_mm_[node] = way_mm;
    before_[node] = from;
    heap_.emplace_back(cost, node);
    std::ranges::push_heap(heap_, std::greater());
  }

  /// What a way back is charged for each mm.
  struct Later {
    double mm_cost = 0;
    double foreign = 0;  // visibility of the next touch
  };

  const Roadmap& map_;
  const TravelCost& travel_;
  std::vector<double> cost_;
  std::vector<double> way_mm_;    // from the seed
  std::vector<double> dirty_mm_;  // since foreign plastic was touched
  std::vector<Later> later_;      // backwards
  std::vector<std::uint32_t> before_;
  std::vector<double> extra_;  // of targets: what entering there costs
  std::vector<char> wanted_;
  std::vector<std::uint32_t> known_;  // nodes that the arrays above say something of
  std::vector<std::pair<double, std::uint32_t>> heap_;
};

}  // namespace cleancolor
