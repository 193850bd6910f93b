#include "plan/tour.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <queue>

#include "plan/joined_loops.hpp"
#include "plan/ooze_forecast.hpp"

namespace cleancolor {
namespace {

constexpr double unreached = std::numeric_limits<double>::infinity();
constexpr double joint_of_seam = 0.1;  // how much of a seam shows where an outer wall ends inside
constexpr std::uint32_t nobody = 0xFFFFFFFF;

/// Where an entry is left again.
std::uint32_t exit_of(const Path& path, std::uint32_t entry) {
  return path.closed ? entry : 1 - entry;
}

/// Its index among the cost's nozzles.
int nozzle_of(const TravelCost& cost, int extruder) {
  const auto& all = cost.nozzles();
  const auto found = std::ranges::find(all, extruder, &TravelCost::Nozzle::extruder);
  assert(found != all.end());
  return int(found - all.begin());
}

/// One shortest path search after another over the same nodes.
class Search {
 public:
  Search(const Roadmap& map, const TravelCost& travel)
      : map_(map), travel_(travel), cost_(map.nodes_mm.size()), before_(map.nodes_mm.size()) {}

  struct Seed {
    std::uint32_t node = 0;
    double cost = 0;
  };

  /// Settles nodes from the seeds until all targets have their cost, or are more than `slack` dearer than the best,
  /// with what entering there costs. Predecessors of what was settled are appended to the log. Only places that the
  /// nozzle in use reaches, an index of the cost's nozzles, are passed.
  void run(std::span<const Seed> seeds, std::span<const Seed> targets, int nozzle, double slack) {
    std::ranges::fill(cost_, unreached);
    way_mm_.resize(cost_.size());
    dirty_mm_.resize(cost_.size());
    std::ranges::fill(before_, nobody);
    std::ranges::fill(wanted_, 0);
    wanted_.resize(cost_.size());
    heap_.clear();
    std::size_t open = 0;
    extra_.resize(cost_.size());
    for (const Seed& t : targets) {
      open += wanted_[t.node] == 0;
      extra_[t.node] = wanted_[t.node] == 0 ? t.cost : std::min(extra_[t.node], t.cost);
      wanted_[t.node] = 1;
    }
    for (const Seed& s : seeds) offer(s.node, s.cost, 0, nobody);
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
        if (arc.foreign > 0) c += travel_.smear(double(arc.foreign), dirty_mm_[node] + length);
        if (c >= cost_[arc.to]) continue;
        if ((map_.reached_by[arc.to] >> nozzle & 1) == 0 && wanted_[arc.to] == 0) continue;
        offer(arc.to, c, way_mm_[node] + length, node);
        dirty_mm_[arc.to] = arc.foreign > 0 ? 0 : dirty_mm_[node] + length;
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
  const std::vector<std::uint32_t>& before() const { return before_; }

 private:
  /// Where places within reach do not hang together.
  void go_straight(std::span<const Seed> seeds, std::span<const Seed> targets) {
    std::ranges::fill(before_, nobody);
    for (const Seed& s : seeds) cost_[s.node] = s.cost;
    for (const auto& [t, extra] : targets)
      for (const Seed& s : seeds) {
        const double c = s.cost + travel_.way(map_.nodes_mm[s.node], map_.nodes_mm[t]);
        if (c >= cost_[t]) continue;
        cost_[t] = c;
        way_mm_[t] = distance(map_.nodes_mm[s.node], map_.nodes_mm[t]);
        before_[t] = s.node == t ? nobody : s.node;
      }
  }

  void offer(std::uint32_t node, double cost, double way_mm, std::uint32_t from) {
    if (cost >= cost_[node]) return;
    cost_[node] = cost;
    way_mm_[node] = dirty_mm_[node] = way_mm;
    before_[node] = from;
    heap_.emplace_back(cost, node);
    std::ranges::push_heap(heap_, std::greater());
  }

  const Roadmap& map_;
  const TravelCost& travel_;
  std::vector<double> cost_;
  std::vector<double> way_mm_;    // from the seed
  std::vector<double> dirty_mm_;  // since foreign plastic was touched
  std::vector<std::uint32_t> before_;
  std::vector<double> extra_;  // of targets: what entering there costs
  std::vector<char> wanted_;
  std::vector<std::pair<double, std::uint32_t>> heap_;
};

/// Leaves out places that a straight way costs no more without.
void pull(std::vector<Vec2>& way, const TravelCost& cost) {
  std::vector<double> part;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) part.push_back(cost.way(way[i], way[i + 1]));
  for (std::size_t i = 0; i + 2 < way.size();) {
    const double straight = cost.way(way[i], way[i + 2]);
    if (straight > part[i] + part[i + 1] + 1e-9) {
      ++i;
      continue;
    }
    way.erase(way.begin() + std::ptrdiff_t(i) + 1);
    part.erase(part.begin() + std::ptrdiff_t(i));
    part[i] = straight;
    if (i > 0) --i;
  }
}

}  // namespace

std::vector<Visit> tour(const Roadmap& map, std::span<const Path> paths, const TravelCost& cost,
                        const TourOptions& options) {
  std::vector<Visit> visits(paths.size());
  if (paths.empty()) return visits;
  Search search(map, cost);
  // Of each stage: the cost of each entry with what it costs to enter, and the predecessors of all nodes.
  std::vector<std::vector<double>> entered(paths.size());
  std::vector<std::vector<std::uint32_t>> before(paths.size());
  for (std::size_t k = 0; k < paths.size(); ++k) {
    const std::vector<Entry>& entries = map.entries[k];
    std::vector<Search::Seed> seeds;
    if (k > 0) {
      for (std::uint32_t i = 0; i < map.entries[k - 1].size(); ++i)
        if (entered[k - 1][i] < unreached)
          seeds.push_back({map.entries[k - 1][exit_of(paths[k - 1], i)].node, entered[k - 1][i]});
    }
    std::vector<Search::Seed> targets;
    for (std::uint32_t i = 0; i < entries.size(); ++i) {
      double extra = cost.seam(entries[i].at_mm) + cost.seam(entries[exit_of(paths[k], i)].at_mm);
      if (!paths[k].inner.empty() || entries[i].lead_mm > 0) extra *= joint_of_seam;
      if (options.entry_cost) extra += options.entry_cost(k, i);
      targets.push_back({entries[i].node, extra});
    }
    if (k > 0) {
      search.run(seeds, targets, nozzle_of(cost, paths[k].extruder), options.slack_mm);
      before[k] = search.before();
    }
    for (std::uint32_t i = 0; i < entries.size(); ++i) {
      double c = options.from_mm ? cost.way(*options.from_mm, map.nodes_mm[entries[i].node]) : 0;
      if (k > 0) {
        c = search.cost(entries[i].node);
        if (begins_outer_wall(paths[k])) c += cost.hole(entries[i].ahead, search.way_mm(entries[i].node));
      }
      c += targets[i].cost;
      entered[k].push_back(c);
    }
    // Numbers stay small: only differences count.
    const double least = *std::ranges::min_element(entered[k]);
    for (double& c : entered[k]) c -= least;
  }
  // Back from the cheapest end.
  std::uint32_t entry = std::uint32_t(std::ranges::min_element(entered.back()) - entered.back().begin());
  for (std::size_t k = paths.size(); k-- > 0;) {
    visits[k].entry = entry;
    if (k == 0) break;
    std::vector<Vec2> way{map.nodes_mm[map.entries[k][entry].node]};
    std::uint32_t node = map.entries[k][entry].node;
    for (; before[k][node] != nobody; node = before[k][node]) way.push_back(map.nodes_mm[before[k][node]]);
    std::ranges::reverse(way);
    pull(way, cost);
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      visits[k].travel_cost += cost.way(way[i], way[i + 1]);
      visits[k].travel_way_mm += distance(way[i], way[i + 1]);
    }
    visits[k].travel_mm.assign(way.begin() + 1, way.end() - (way.size() > 1 ? 1 : 0));
    // Of the entries of the path before that are left here, the cheapest.
    std::uint32_t best = nobody;
    for (std::uint32_t i = 0; i < map.entries[k - 1].size(); ++i)
      if (map.entries[k - 1][exit_of(paths[k - 1], i)].node == node && entered[k - 1][i] < unreached &&
          (best == nobody || entered[k - 1][i] < entered[k - 1][best]))
        best = i;
    assert(best != nobody);
    entry = best;
  }
  return visits;
}

std::vector<WayLength> ways(const Roadmap& map, const TravelCost& cost, int extruder, std::uint32_t from,
                            std::span<const std::uint32_t> to) {
  std::vector<Search::Seed> targets;
  for (const std::uint32_t node : to) targets.push_back({node, 0});
  Search search(map, cost);
  const Search::Seed seed{from, 0};
  search.run(std::span(&seed, 1), targets, nozzle_of(cost, extruder), unreached);
  std::vector<WayLength> result;
  for (const std::uint32_t node : to) {
    const double straight = distance(map.nodes_mm[from], map.nodes_mm[node]);
    const bool reached = search.cost(node) < unreached;
    result.push_back(reached ? WayLength{search.cost(node), search.way_mm(node)} : WayLength{straight, straight});
  }
  return result;
}

PlannedWay way_between(const Roadmap& map, const TravelCost& cost, int extruder, Vec2 from_mm, Vec2 to_mm) {
  const int nozzle = nozzle_of(cost, extruder);
  // The nearest places are tried as the first and the last.
  const auto nearest = [&](Vec2 p) {
    std::vector<std::pair<double, std::uint32_t>> all;
    for (std::uint32_t i = 0; i < map.nodes_mm.size(); ++i)
      if (map.reached_by[i] >> nozzle & 1) all.emplace_back(length_squared(map.nodes_mm[i] - p), i);
    constexpr std::size_t tried = 24;
    const std::size_t count = std::min(tried, all.size());
    std::ranges::partial_sort(all, all.begin() + std::ptrdiff_t(count));
    std::vector<Search::Seed> seeds;
    for (std::size_t i = 0; i < count; ++i) seeds.push_back({all[i].second, cost.way(p, map.nodes_mm[all[i].second])});
    return seeds;
  };
  const std::vector<Search::Seed> seeds = nearest(from_mm), targets = nearest(to_mm);
  PlannedWay best{.between_mm = {}, .cost = cost.way(from_mm, to_mm)};
  if (!seeds.empty()) {
    Search search(map, cost);
    search.run(seeds, targets, nozzle, 0);
    std::uint32_t last = nobody;
    for (const Search::Seed& t : targets) {
      if (search.cost(t.node) + t.cost >= best.cost) continue;
      best.cost = search.cost(t.node) + t.cost;
      last = t.node;
    }
    for (; last != nobody; last = search.before()[last]) best.between_mm.push_back(map.nodes_mm[last]);
  }
  std::vector<Vec2>& way = best.between_mm;
  way.push_back(from_mm);
  std::ranges::reverse(way);
  way.push_back(to_mm);
  pull(way, cost);
  best.cost = 0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    best.cost += cost.way(way[i], way[i + 1]);
    best.way_mm += distance(way[i], way[i + 1]);
  }
  way.erase(way.begin());
  way.pop_back();
  return best;
}

Path begun(Path path, const Roadmap& map, std::size_t index, std::uint32_t entry) {
  const Entry& e = map.entries[index][entry];
  if (!path.closed) return entry == 1 ? reversed(std::move(path)) : path;
  return inner_aligned(e.at_mm == path.points[e.segment] ? started_at(std::move(path), e.segment)
                                                         : started_on(std::move(path), e.segment, e.at_mm));
}

}  // namespace cleancolor
