#include "plan/tour.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "plan/joined_loops.hpp"
#include "plan/ooze_forecast.hpp"
#include "plan/search.hpp"

namespace cleancolor {
namespace {

constexpr double joint_of_seam = 0.1;  // how much of a seam shows where an outer wall ends inside

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

/// What walking path k from this entry costs, beside the way there.
double walk_cost(const Roadmap& map, std::span<const Path> paths, const TravelCost& cost, const TourOptions& options,
                 std::size_t k, std::uint32_t i) {
  const std::vector<Entry>& entries = map.entries[k];
  double extra = cost.seam(entries[i].at_mm) + cost.seam(entries[exit_of(paths[k], i)].at_mm);
  if (!paths[k].inner.empty() || entries[i].lead_mm > 0) extra *= joint_of_seam;
  if (options.entry_cost) extra += options.entry_cost(k, i);
  return extra;
}

double ahead_of(const Entry& entry, const Path& path) {
  return begins_outer_wall(path) ? entry.ahead : 0;
}

/// TravelCost::hole of a way that is no short hop, as a sum: it then does not matter how a search gets on.
struct HoleCost {
  double stop = 0, mm = 0;
};
HoleCost hole_cost(const Entry& entry, const Path& path, const TravelCost& cost) {
  const double ahead = ahead_of(entry, path);
  const double mm = cost.hole(ahead, 3) - cost.hole(ahead, 2);
  return {cost.hole(ahead, 2) - 2 * mm, mm};
}

/// Entries that can be reached, together where a mm of way to them costs about the same.
std::vector<std::vector<std::uint32_t>> alike(const std::vector<Entry>& entries, const Path& path,
                                              const std::vector<double>& to_go) {
  constexpr std::array bands{0.05, 0.2, 0.4, 0.7, 2.};  // of visibility
  std::vector<std::vector<std::uint32_t>> groups(bands.size());
  for (std::uint32_t i = 0; i < entries.size(); ++i)
    if (to_go[i] < unreached)
      groups[std::size_t(std::ranges::upper_bound(bands, ahead_of(entries[i], path)) - bands.begin())].push_back(i);
  std::erase_if(groups, [](const auto& group) { return group.empty(); });
  return groups;
}

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

/// The way that a search has found to the node; returns where it begins.
std::uint32_t add_way(Visit& visit, const Roadmap& map, const TravelCost& cost, const Predecessors& log,
                      std::uint32_t node) {
  std::vector<Vec2> way{map.nodes_mm[node]};
  for (std::uint32_t next = before(log, node); next != nobody; next = before(log, node)) {
    way.push_back(map.nodes_mm[next]);
    node = next;
  }
  std::ranges::reverse(way);
  pull(way, cost);
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    visit.travel_cost += cost.way(way[i], way[i + 1]);
    visit.travel_way_mm += distance(way[i], way[i + 1]);
  }
  visit.travel_mm.assign(way.begin() + 1, way.end() - (way.size() > 1 ? 1 : 0));
  return node;
}

/// The nodes nearest to a place, and what the straight ways there cost.
std::vector<Search::Seed> nearest_nodes(const Roadmap& map, const TravelCost& cost, int nozzle, Vec2 p) {
  std::vector<std::pair<double, std::uint32_t>> all;
  for (std::uint32_t i = 0; i < map.nodes_mm.size(); ++i)
    if (map.reached_by[i] >> nozzle & 1) all.emplace_back(length_squared(map.nodes_mm[i] - p), i);
  constexpr std::size_t tried = 24;
  const std::size_t count = std::min(tried, all.size());
  std::ranges::partial_sort(all, all.begin() + std::ptrdiff_t(count));
  std::vector<Search::Seed> seeds;
  for (std::size_t i = 0; i < count; ++i) seeds.push_back({all[i].second, cost.way(p, map.nodes_mm[all[i].second])});
  return seeds;
}

}  // namespace

std::vector<Visit> tour(const Roadmap& map, std::span<const Path> paths, const TravelCost& cost,
                        const TourOptions& options) {
  std::vector<Visit> visits(paths.size());
  if (paths.empty()) return visits;
  Search search(map, cost);
  // Of each stage: the cost of each entry with what it costs to enter, and how the nodes were reached.
  std::vector<std::vector<double>> entered(paths.size());
  std::vector<Predecessors> reached(paths.size());
  for (std::size_t k = 0; k < paths.size(); ++k) {
    const std::vector<Entry>& entries = map.entries[k];
    std::vector<Search::Seed> seeds;
    if (k > 0) {
      for (std::uint32_t i = 0; i < map.entries[k - 1].size(); ++i)
        if (entered[k - 1][i] < unreached)
          seeds.push_back({map.entries[k - 1][exit_of(paths[k - 1], i)].node, entered[k - 1][i]});
    }
    std::vector<Search::Seed> targets;
    for (std::uint32_t i = 0; i < entries.size(); ++i)
      targets.push_back({entries[i].node, walk_cost(map, paths, cost, options, k, i)});
    if (k > 0) {
      search.run(seeds, targets, nozzle_of(cost, paths[k].extruder), options.slack_mm);
      reached[k] = search.predecessors();
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
    const std::uint32_t node = add_way(visits[k], map, cost, reached[k], map.entries[k][entry].node);
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

namespace {

/// One stage of the way back: from the entries of path k + 1, which cost to_go from there on, to where path k is left.
class BackStage {
 public:
  BackStage(const Roadmap& map, const Path& later, std::size_t k, const TravelCost& cost,
            const std::vector<double>& to_go)
      : map_(map), later_(later), entries_(map.entries[k + 1]), cost_(cost), to_go_(to_go) {}

  struct Result {
    std::vector<double> cost;         // of each target
    std::vector<std::uint16_t> next;  // its entry of path k + 1
  };
  Result run(Search& search, const std::vector<Search::Seed>& targets, double slack_mm) const {
    Result result{std::vector<double>(targets.size(), unreached), std::vector<std::uint16_t>(targets.size())};
    for (const std::vector<std::uint32_t>& starts : alike(entries_, later_, to_go_)) {
      std::vector<Search::Seed> seeds;
      for (const std::uint32_t e : starts) {
        const HoleCost hole = hole_cost(entries_[e], later_, cost_);
        seeds.push_back({entries_[e].node, to_go_[e] + hole.stop, hole.mm});
      }
      search.run(seeds, targets, nozzle_of(cost_, later_.extruder), slack_mm, Search::Direction::backwards);
      for (std::size_t i = 0; i < targets.size(); ++i)
        if (search.cost(targets[i].node) < result.cost[i]) {
          result.cost[i] = search.cost(targets[i].node);
          result.next[i] = cheapest_at(search.begin_of(targets[i].node), starts);
        }
    }
    if (begins_outer_wall(later_)) hop(targets, result);
    return result;
  }

 private:
  /// Of the entries at one place.
  std::uint16_t cheapest_at(std::uint32_t node, const std::vector<std::uint32_t>& starts) const {
    double least = unreached;
    std::uint16_t best = 0;
    for (const std::uint32_t e : starts)
      if (entries_[e].node == node && to_go_[e] < least) least = to_go_[e], best = std::uint16_t(e);
    return best;
  }
  /// Short hops, which are no stop.
  void hop(const std::vector<Search::Seed>& targets, Result& result) const {
    constexpr double longest_mm = 2;
    for (std::size_t i = 0; i < targets.size(); ++i)
      for (std::uint32_t e = 0; e < entries_.size(); ++e) {
        const Vec2 from = map_.nodes_mm[targets[i].node], to = map_.nodes_mm[entries_[e].node];
        if (length_squared(to - from) > longest_mm * longest_mm || to_go_[e] == unreached) continue;
        const double c =
            to_go_[e] + cost_.way(from, to) + cost_.hole(ahead_of(entries_[e], later_), distance(from, to));
        if (c < result.cost[i]) result.cost[i] = c, result.next[i] = std::uint16_t(e);
      }
  }

  const Roadmap& map_;
  const Path& later_;
  const std::vector<Entry>& entries_;
  const TravelCost& cost_;
  const std::vector<double>& to_go_;
};

}  // namespace

CostToGo cost_to_go(const Roadmap& map, std::span<const Path> paths, const TravelCost& cost,
                    const TourOptions& options) {
  CostToGo result;
  if (paths.empty()) return result;
  result.next.resize(paths.size() - 1);
  Search search(map, cost);
  for (std::size_t k = paths.size(); k-- > 0;) {
    std::vector<Search::Seed> targets;  // where path k is left
    for (std::uint32_t i = 0; i < map.entries[k].size(); ++i)
      targets.push_back({map.entries[k][exit_of(paths[k], i)].node, walk_cost(map, paths, cost, options, k, i)});
    std::vector<double> here(targets.size(), 0);
    if (k + 1 < paths.size()) {
      const BackStage stage(map, paths[k + 1], k, cost, result.cost);
      BackStage::Result back = stage.run(search, targets, options.slack_mm);
      here = std::move(back.cost);
      result.next[k] = std::move(back.next);
    }
    for (std::size_t i = 0; i < here.size(); ++i) here[i] += targets[i].cost;
    result.cost = std::move(here);
  }
  return result;
}

std::uint32_t cheapest_start(const Roadmap& map, const Path& first, const TravelCost& cost, const CostToGo& to_go,
                             Vec2 from_mm) {
  const std::vector<Entry>& entries = map.entries.front();
  const int nozzle = nozzle_of(cost, first.extruder);
  std::vector<Search::Seed> targets;
  for (std::size_t i = 0; i < entries.size(); ++i) targets.push_back({entries[i].node, to_go.cost[i]});
  Search search(map, cost);
  search.run(nearest_nodes(map, cost, nozzle, from_mm), targets, nozzle, 0);
  std::uint32_t best = 0;
  double least = unreached;
  for (std::uint32_t i = 0; i < entries.size(); ++i) {
    const Vec2 at = map.nodes_mm[entries[i].node];
    double way = cost.way(from_mm, at), way_mm = distance(from_mm, at);
    if (search.cost(entries[i].node) < way) way = search.cost(entries[i].node), way_mm = search.way_mm(entries[i].node);
    if (begins_outer_wall(first)) way += cost.hole(entries[i].ahead, way_mm);
    if (way + to_go.cost[i] < least) least = way + to_go.cost[i], best = i;
  }
  return best;
}

Visit visit_from(const Roadmap& map, std::span<const Path> paths, const TravelCost& cost, std::size_t k,
                 std::uint32_t entry_before, std::uint32_t entry) {
  const Search::Seed seed{map.entries[k - 1][exit_of(paths[k - 1], entry_before)].node, 0};
  const Search::Seed target{map.entries[k][entry].node, 0};
  Search search(map, cost);
  search.run(std::span(&seed, 1), std::span(&target, 1), nozzle_of(cost, paths[k].extruder), 0);
  Visit visit{.entry = entry, .travel_mm = {}};
  add_way(visit, map, cost, search.predecessors(), target.node);
  // A hop that is short when it is straight is no stop.
  const double ahead = ahead_of(map.entries[k][entry], paths[k]);
  const Vec2 from = map.nodes_mm[seed.node], to = map.nodes_mm[target.node];
  const double straight = cost.way(from, to), straight_mm = distance(from, to);
  if (straight + cost.hole(ahead, straight_mm) < visit.travel_cost + cost.hole(ahead, visit.travel_way_mm))
    visit = {.entry = entry, .travel_mm = {}, .travel_cost = straight, .travel_way_mm = straight_mm};
  return visit;
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
  const std::vector<Search::Seed> seeds = nearest_nodes(map, cost, nozzle, from_mm),
                                  targets = nearest_nodes(map, cost, nozzle, to_mm);
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
    const Predecessors log = search.predecessors();
    for (; last != nobody; last = before(log, last)) best.between_mm.push_back(map.nodes_mm[last]);
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
