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
      : map_(map), travel_(travel), nodes_(map.nodes_mm.size()), extra_(map.nodes_mm.size()) {}

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
    if (is_back) later_.resize(nodes_.size());
    std::size_t open = 0;
    targets_ = targets.size();
    for (const Seed& t : targets) {
      Node& node = nodes_[t.node];
      known_.push_back(t.node);
      open += node.wanted == 0;
      extra_[t.node] = node.wanted == 0 ? t.cost : std::min(extra_[t.node], t.cost);
      node.wanted = 1;
    }
    for (const Seed& s : seeds) {
      if (is_back && s.cost < nodes_[s.node].cost) later_[s.node] = {s.mm_cost, 0};
      offer(s.node, s.cost, 0, nobody);
    }
    double end = unreached;
    while (!heap_.empty() && open > 0) {
      std::ranges::pop_heap(heap_, is_later);
      const auto [cost, node] = heap_.back();
      heap_.pop_back();
      Node& here = nodes_[node];
      if (cost > here.cost) continue;
      if (cost > end) break;
      if (here.wanted == 1) {
        here.wanted = 2;
        --open;
        end = std::min(end, cost + extra_[node] + slack);
      }
      for (const Arc& arc : map_.arcs_of(node)) {
        Node& there = nodes_[arc.to];
        double c = cost + double(arc.cost);
        if (c >= there.cost || c > end) continue;  // what touches cost comes on top
        const double length = arc.length_mm;
        Later later;
        if (is_back) {
          later = later_[node];
          if (arc.foreign > 0) later.foreign = double(arc.foreign);
          c += travel_.smear(later.foreign, length) + later.mm_cost * length;
        } else if (arc.foreign > 0) {
          c += travel_.smear(double(arc.foreign), here.dirty_mm + length);
        }
        if (c >= there.cost || c > end) continue;
        if ((map_.reached_by[arc.to] >> nozzle & 1) == 0 && there.wanted == 0) continue;
        offer(arc.to, c, here.way_mm + length, node);
        there.dirty_mm = arc.foreign > 0 ? 0 : here.dirty_mm + length;
        if (is_back) later_[arc.to] = later;
      }
    }
    // What was reached but not settled is no shortest path yet.
    for (const Seed& t : targets)
      if (nodes_[t.node].wanted == 1) nodes_[t.node].cost = unreached;
    const auto is_reached = [&](const Seed& t) { return nodes_[t.node].cost < unreached; };
    if (std::ranges::none_of(targets, is_reached)) go_straight(seeds, targets);
  }

  double cost(std::uint32_t node) const { return nodes_[node].cost; }
  double way_mm(std::uint32_t node) const { return nodes_[node].way_mm; }
  /// Of the ways to the targets: their nodes, and the one before each, by node.
  Predecessors predecessors() {
    Predecessors log;
    for (std::size_t i = 0; i < targets_; ++i)
      for (std::uint32_t node = known_[i]; nodes_[node].before != nobody && !nodes_[node].logged;
           node = nodes_[node].before) {
        nodes_[node].logged = true;
        log.emplace_back(node, nodes_[node].before);
      }
    for (const auto& [node, before] : log) nodes_[node].logged = false;
    std::ranges::sort(log);
    return log;
  }
  /// Where the way to the node begins.
  std::uint32_t begin_of(std::uint32_t node) const {
    while (nodes_[node].before != nobody) node = nodes_[node].before;
    return node;
  }

 private:
  using Step = std::pair<double, std::uint32_t>;  // cost, node
  static constexpr auto is_later = [](const Step& a, const Step& b) {  // no function: the heap's code takes it in
    return a.first != b.first ? a.first > b.first : a.second > b.second;
  };

  /// What the search before found.
  void forget() {
    for (const std::uint32_t node : known_)
      nodes_[node].cost = unreached, nodes_[node].before = nobody, nodes_[node].wanted = 0;
    known_.clear();
    heap_.clear();
  }

  /// Where places within reach do not hang together.
  void go_straight(std::span<const Seed> seeds, std::span<const Seed> targets) {
    for (const std::uint32_t node : known_) nodes_[node].before = nobody;
    for (const Seed& s : seeds) nodes_[s.node].cost = s.cost;
    for (const auto& [t, extra, mm_cost] : targets)
      for (const Seed& s : seeds) {
        const double length = distance(map_.nodes_mm[s.node], map_.nodes_mm[t]);
        const double c = s.cost + travel_.way(map_.nodes_mm[s.node], map_.nodes_mm[t]) + s.mm_cost * length;
        if (c >= nodes_[t].cost) continue;
        nodes_[t].cost = c;
        nodes_[t].way_mm = length;
        nodes_[t].before = s.node == t ? nobody : s.node;
      }
  }

  void offer(std::uint32_t node, double cost, double way_mm, std::uint32_t from) {
    Node& n = nodes_[node];
    if (cost >= n.cost) return;
    if (n.cost == unreached) known_.push_back(node);
    n.cost = cost;
    n.way_mm = n.dirty_mm = way_mm;
    n.before = from;
    heap_.emplace_back(cost, node);
    std::ranges::push_heap(heap_, is_later);
  }

  /// Two to a line of the processor's cache.
  struct alignas(32) Node {
    double cost = unreached;
    double way_mm = 0;    // from the seed
    double dirty_mm = 0;  // since foreign plastic was touched
    std::uint32_t before = nobody;
    char wanted = 0;      // 1: it is a target, 2: it is settled
    bool logged = false;  // it is among the predecessors
  };

  /// What a way back is charged for each mm.
  struct Later {
    double mm_cost = 0;
    double foreign = 0;  // visibility of the next touch
  };

  const Roadmap& map_;
  const TravelCost& travel_;
  std::vector<Node> nodes_;
  std::vector<double> extra_;         // of targets: what entering there costs
  std::vector<Later> later_;          // backwards
  std::vector<std::uint32_t> known_;  // nodes that the arrays above say something of: first the targets
  std::size_t targets_ = 0;
  std::vector<Step> heap_;
};

}  // namespace cleancolor
