// Roadmap and tour: on drawn layers, against exhaustive search over the same roadmap and against a fine grid.

#include "plan/tour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <queue>

#include "drawn_layer.hpp"
#include "free_way.hpp"

namespace cleancolor {
namespace {

using namespace test;

TravelCost cost_of(const LayerMap& map, Vec2 second, const TravelWeights& weights = {}) {
  return TravelCost(map, {{0, {0, 0}, {}}, {1, second, {}}}, weights);
}

std::vector<double> all_costs_from(const Roadmap& map, std::uint32_t from, double of_mm = 0) {
  std::vector<double> cost(map.nodes_mm.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  cost[from] = 0;
  queue.emplace(0, from);
  while (!queue.empty()) {
    const auto [c, node] = queue.top();
    queue.pop();
    if (c > cost[node]) continue;
    for (const Arc& arc : map.arcs_of(node)) {
      const double there = c + double(arc.cost) + of_mm * distance(map.nodes_mm[node], map.nodes_mm[arc.to]);
      if (there < cost[arc.to]) queue.emplace(cost[arc.to] = there, arc.to);
    }
  }
  return cost;
}

TEST(Roadmap, HangsTogetherAndEntersEveryPath) {
  std::mt19937 random(1);
  for (int t = 0; t < 10; ++t) {
    SCOPED_TRACE(t);
    std::vector<Path> paths;
    const DrawnLayer layer = random_drawn_layer(random, 8, 40, paths);
    paths.push_back(drawn_path(1, {{3, 3}, {9, 4}}, false));
    const LayerMap map = layer.map();
    const Roadmap roads = roadmap(paths, cost_of(map, {15, 0}));
    for (const double c : all_costs_from(roads, 0)) EXPECT_LT(c, 1e9);
    ASSERT_EQ(roads.entries.size(), paths.size());
    for (std::size_t k = 0; k < paths.size(); ++k) {
      if (!paths[k].closed) {
        ASSERT_EQ(roads.entries[k].size(), 2U);
        EXPECT_EQ(roads.entries[k][0].at_mm, paths[k].points.front());
        EXPECT_EQ(roads.entries[k][1].at_mm, paths[k].points.back());
        continue;
      }
      EXPECT_NEAR(double(roads.entries[k].size()), length_mm(paths[k]) / 1.5, 1.01);
      for (const Entry& e : roads.entries[k]) {
        const Path begun_there = begun(paths[k], roads, k, std::uint32_t(&e - roads.entries[k].data()));
        EXPECT_NEAR(length_mm(begun_there), length_mm(paths[k]), 1e-9);
        EXPECT_EQ(begun_there.start(), e.at_mm);
        const Vec2 node = roads.nodes_mm[e.node] + (paths[k].extruder == 1 ? Vec2{15, 0} : Vec2{});
        EXPECT_LT(distance(node, e.at_mm), 1e-9);
      }
    }
  }
}

TEST(Roadmap, EntersWhereAPathCanBeSeenLeast) {
  // Colour 1 covers all but one side of colour 0.
  const DrawnLayer layer(
      {rectangle({0, 0}, {10, 10}), difference(rectangle({-3, 0}, {13, 13}), rectangle({0, 0}, {10, 10}))});
  const std::vector<Path> paths{drawn_path(0, to_mm(rectangle({0.2, 0.2}, {9.8, 9.8}).front()), true, 0)};
  const LayerMap map = layer.map();
  const TravelCost cost = cost_of(map, {100, 0});
  const std::vector<Visit> visits = tour(roadmap(paths, cost), paths, cost);
  EXPECT_EQ(cost.visibility(roadmap(paths, cost).entries[0][visits[0].entry].at_mm), 0);
}

/// Nodes anywhere and arcs of any cost between them, each both ways; all hang together.
Roadmap random_roads(std::mt19937& random, std::uint32_t nodes) {
  std::uniform_real_distribution<double> any(0, 50);
  std::vector<std::vector<Arc>> arcs(nodes);
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    arcs[a].push_back({b, float(any(random)), 0, 0});
    arcs[b].push_back({a, float(any(random)), 0, 0});
  };
  for (std::uint32_t i = 1; i < nodes; ++i) join(i, std::uint32_t(random() % i));
  for (std::uint32_t i = 0; i < 2 * nodes; ++i) join(std::uint32_t(random() % nodes), std::uint32_t(random() % nodes));
  Roadmap roads;
  roads.first_arc = {0};
  for (const std::vector<Arc>& own : arcs) {
    roads.nodes_mm.push_back({any(random), any(random)});
    roads.reached_by.push_back(1);
    roads.arcs.insert(roads.arcs.end(), own.begin(), own.end());
    roads.first_arc.push_back(std::uint32_t(roads.arcs.size()));
  }
  for (std::uint32_t node = 0; node < nodes; ++node)
    for (std::uint32_t i = roads.first_arc[node]; i < roads.first_arc[node + 1]; ++i)
      roads.arcs[i].length_mm = distance(roads.nodes_mm[node], roads.nodes_mm[roads.arcs[i].to]);
  return roads;
}

TEST(Ways, CannotBeImprovedByAnyArcAndAreAttained) {
  const DrawnLayer layer({{}, {}});
  const LayerMap map = layer.map();
  const TravelCost cost(map, {{0, {0, 0}, {}}}, TravelWeights{});
  std::mt19937 random(4);
  for (int t = 0; t < 50; ++t) {
    SCOPED_TRACE(t);
    const Roadmap roads = random_roads(random, 60);
    std::vector<std::uint32_t> all(roads.nodes_mm.size());
    std::iota(all.begin(), all.end(), 0U);
    const std::vector<WayLength> ways_to = ways(roads, cost, 0, 7, all);
    EXPECT_EQ(ways_to[7].cost, 0);
    std::vector<char> attained(all.size(), 0);
    attained[7] = 1;
    for (const std::uint32_t node : all)
      for (const Arc& arc : roads.arcs_of(node)) {
        const double by_arc = ways_to[node].cost + double(arc.cost);
        EXPECT_LE(ways_to[arc.to].cost, by_arc + 1e-9);
        const double length = distance(roads.nodes_mm[node], roads.nodes_mm[arc.to]);
        if (std::abs(by_arc - ways_to[arc.to].cost) < 1e-9 &&
            std::abs(ways_to[node].way_mm + length - ways_to[arc.to].way_mm) < 1e-9)
          attained[arc.to] = 1;
      }
    EXPECT_EQ(std::ranges::count(attained, 1), std::ptrdiff_t(all.size()));
  }
}

/// The cheapest tour over all entries by trying every pair of neighbours.
double exhaustive_cost(const Roadmap& roads, const std::vector<Path>& paths, const TravelCost& cost) {
  std::vector<double> so_far;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    std::vector<double> here(roads.entries[k].size(), k == 0 ? 0 : std::numeric_limits<double>::infinity());
    if (k > 0)
      for (std::size_t i = 0; i < so_far.size(); ++i) {
        const std::size_t exit = paths[k - 1].closed ? i : 1 - i;
        const std::vector<double> way = all_costs_from(roads, roads.entries[k - 1][exit].node);
        for (std::size_t e = 0; e < here.size(); ++e)
          here[e] = std::min(here[e], so_far[i] + way[roads.entries[k][e].node]);
      }
    for (std::size_t e = 0; e < here.size(); ++e)
      here[e] += cost.seam(roads.entries[k][e].at_mm) + cost.seam(roads.entries[k][paths[k].closed ? e : 1 - e].at_mm);
    so_far = here;
  }
  return *std::ranges::min_element(so_far);
}

TEST(Tour, IsNoDearerThanTheBestOfAll) {
  std::mt19937 random(2);
  for (int t = 0; t < 12; ++t) {
    SCOPED_TRACE(t);
    std::vector<Path> paths;
    const DrawnLayer layer = random_drawn_layer(random, 5, 30, paths);
    paths.push_back(drawn_path(0, {{3, 3}, {9, 4}}, false));
    paths.push_back(drawn_path(1, {{20, 3}, {12, 24}}, false));
    const LayerMap map = layer.map();
    // What depends on the way so far is no matter for an exhaustive search.
    const TravelCost cost = cost_of(map, {12, 3}, {.smear = 0, .hole = 0});
    const Roadmap roads = roadmap(paths, cost, {.leads = false});
    const std::vector<Visit> visits = tour(roads, paths, cost, {.from_mm = {}, .slack_mm = 1e9, .entry_cost = {}});
    double sum = 0;
    for (std::size_t k = 0; k < paths.size(); ++k) {
      const std::uint32_t exit = paths[k].closed ? visits[k].entry : 1 - visits[k].entry;
      sum += visits[k].travel_cost + cost.seam(roads.entries[k][visits[k].entry].at_mm) +
             cost.seam(roads.entries[k][exit].at_mm);
      // The way begins where the path before ends and costs what it says.
      if (k == 0) continue;
      const std::uint32_t left = paths[k - 1].closed ? visits[k - 1].entry : 1 - visits[k - 1].entry;
      std::vector<Vec2> way{roads.nodes_mm[roads.entries[k - 1][left].node]};
      way.insert(way.end(), visits[k].travel_mm.begin(), visits[k].travel_mm.end());
      way.push_back(roads.nodes_mm[roads.entries[k][visits[k].entry].node]);
      double again = 0;
      for (std::size_t i = 0; i + 1 < way.size(); ++i) again += cost.way(way[i], way[i + 1]);
      EXPECT_NEAR(again, visits[k].travel_cost, 1e-6);
    }
    const double least = exhaustive_cost(roads, paths, cost);
    EXPECT_LE(sum, least * (1 + 1e-6) + 1e-3);
  }
}

TEST(Tour, CrossesForeignPlasticOnlyWhereAFineGridFindsNoWay) {
  std::mt19937 random(3);
  int around = 0, through = 0;
  for (int t = 0; t < 25; ++t) {
    std::vector<Path> paths;
    const DrawnLayer layer = random_drawn_layer(random, 7, 30, paths);
    if (paths.size() < 2) continue;
    const LayerMap map = layer.map();
    const TravelCost cost = cost_of(map, {11, 2});
    const Roadmap roads = roadmap(paths, cost);
    const std::vector<Visit> visits = tour(roads, paths, cost);
    const Vec2 extent = bounds_mm(layer.outline).size();
    for (std::size_t k = 1; k < paths.size(); ++k) {
      std::vector<Vec2> way{roads.nodes_mm[roads.entries[k - 1][visits[k - 1].entry].node]};
      way.insert(way.end(), visits[k].travel_mm.begin(), visits[k].travel_mm.end());
      way.push_back(roads.nodes_mm[roads.entries[k][visits[k].entry].node]);
      double foreign = 0;
      for (std::size_t i = 0; i + 1 < way.size(); ++i)
        foreign = std::max(foreign, cost.straight(way[i], way[i + 1]).foreign);
      const bool straight_is_bad = cost.straight(way.front(), way.back()).foreign > 0.05;
      around += foreign <= 0.05 && straight_is_bad;
      if (foreign <= 0.05) continue;
      ++through;
      const FreeWay wanted{.longest_mm = 4 * std::max(extent.x, extent.y)};
      EXPECT_TRUE(free_way(cost, way.front(), way.back(), wanted).empty()) << "layer " << t << ", path " << k;
    }
  }
  EXPECT_GT(around, 10);
  RecordProperty("around", around);
  RecordProperty("through", through);
}

TEST(Tour, StaysWhereTheNozzleReaches) {
  // The shortest way around the other colour leaves the bed.
  const DrawnLayer layer(
      {united(rectangle({0, 0}, {5, 5}), rectangle({25, 0}, {30, 5})), rectangle({10, -1}, {20, 30})});
  const std::vector<Path> paths{drawn_path(0, {{1, 1}, {4, 1}}, false), drawn_path(0, {{26, 1}, {29, 1}}, false)};
  const LayerMap map = layer.map();
  for (const bool limited : {false, true}) {
    const Polygons reach = limited ? rectangle({-5, -1.5}, {40, 50}) : Polygons{};
    const TravelCost cost(map, {{0, {0, 0}, reach}}, {});
    const std::vector<Visit> visits = tour(roadmap(paths, cost), paths, cost);
    double lowest = 0, highest = 0;
    for (const Vec2 p : visits[1].travel_mm) lowest = std::min(lowest, p.y), highest = std::max(highest, p.y);
    EXPECT_EQ(highest > 29, limited);
    EXPECT_EQ(lowest < -1.5, !limited);
  }
}

/// What is left to do from each entry of the first path, by trying every pair of neighbours, more than 1 mm apart.
std::vector<double> exhaustive_to_go(const Roadmap& roads, const std::vector<Path>& paths, const TravelCost& cost) {
  std::vector<double> later;
  for (std::size_t k = paths.size(); k-- > 0;) {
    std::vector<double> here;
    for (std::size_t e = 0; e < roads.entries[k].size(); ++e) {
      const std::size_t exit = paths[k].closed ? e : 1 - e;
      double least = later.empty() ? 0 : std::numeric_limits<double>::infinity();
      if (!later.empty()) {
        for (std::size_t i = 0; i < later.size(); ++i) {
          const Entry& next = roads.entries[k + 1][i];
          // A way costs so much a mm, and something once.
          const double of_mm = cost.hole(next.ahead, 3) - cost.hole(next.ahead, 2);
          const std::vector<double> way = all_costs_from(roads, roads.entries[k][exit].node, of_mm);
          least = std::min(least, way[next.node] + cost.hole(next.ahead, 2) - 2 * of_mm + later[i]);
        }
      }
      here.push_back(least + cost.seam(roads.entries[k][e].at_mm) + cost.seam(roads.entries[k][exit].at_mm));
    }
    later = here;
  }
  return later;
}

TEST(CostToGo, IsWhatExhaustiveSearchFindsFromEveryEntry) {
  std::mt19937 random(4);
  for (int t = 0; t < 12; ++t) {
    SCOPED_TRACE(t);
    std::vector<Path> paths;
    const DrawnLayer layer = random_drawn_layer(random, 5, 30, paths);
    paths.push_back(drawn_path(0, {{3, 3}, {9, 4}}, false));
    paths.push_back(drawn_path(1, {{20, 3}, {12, 24}}, false));
    if (t % 2 == 1) std::ranges::reverse(paths);
    const LayerMap map = layer.map();
    const TravelCost cost = cost_of(map, {12, 3}, {.smear = 0, .hole = 0});
    const Roadmap roads = roadmap(paths, cost, {.leads = false});
    const CostToGo to_go = cost_to_go(roads, paths, cost, {.from_mm = {}, .slack_mm = 1e9, .entry_cost = {}});
    const std::vector<double> expected = exhaustive_to_go(roads, paths, cost);
    ASSERT_EQ(to_go.cost.size(), expected.size());
    for (std::size_t e = 0; e < expected.size(); ++e)
      EXPECT_NEAR(to_go.cost[e], expected[e], 1e-6 * expected[e] + 1e-3) << e;
    // The tour that it tells of costs no more.
    for (std::uint32_t start = 0; start < expected.size(); ++start) {
      double sum = 0;
      std::uint32_t before = 0, entry = start;
      for (std::size_t k = 0; k < paths.size(); ++k) {
        const std::uint32_t exit = paths[k].closed ? entry : 1 - entry;
        sum += cost.seam(roads.entries[k][entry].at_mm) + cost.seam(roads.entries[k][exit].at_mm);
        if (k > 0) sum += visit_from(roads, paths, cost, k, before, entry).travel_cost;
        before = entry;
        if (k < to_go.next.size()) entry = to_go.next[k][entry];
      }
      EXPECT_LE(sum, expected[start] * (1 + 1e-6) + 1e-3) << start;
    }
  }
}

TEST(CostToGo, ChargesWhatIsMissingAfterAWayAsTheTourDoes) {
  // One colour, so that what has oozed out matters for outer walls alone.
  std::mt19937 random(5);
  for (int t = 0; t < 12; ++t) {
    SCOPED_TRACE(t);
    std::vector<Path> paths;
    DrawnLayer drawn = random_drawn_layer(random, 6, 30, paths);
    const DrawnLayer layer({drawn.outline, {}});
    for (Path& path : paths) path.extruder = 0;
    const LayerMap map = layer.map();
    const TravelCost cost(map, {{0, {0, 0}, {}}}, {});
    const Roadmap roads = roadmap(paths, cost, {.leads = false});
    const CostToGo to_go = cost_to_go(roads, paths, cost, {.from_mm = {}, .slack_mm = 1e9, .entry_cost = {}});
    const std::vector<double> expected = exhaustive_to_go(roads, paths, cost);
    for (std::size_t e = 0; e < expected.size(); ++e) {
      EXPECT_GE(to_go.cost[e], expected[e] * (1 - 1e-6) - 1e-3) << e;
      EXPECT_LE(to_go.cost[e], expected[e] * 1.01) << e;
    }
  }
}

TEST(CheapestStart, WeighsTheWayThereAgainstWhatFollows) {
  std::mt19937 random(6);
  int others = 0;
  for (int t = 0; t < 12; ++t) {
    SCOPED_TRACE(t);
    std::vector<Path> paths;
    const DrawnLayer layer = random_drawn_layer(random, 5, 30, paths);
    paths.front().depth = 1;
    const LayerMap map = layer.map();
    const TravelCost cost = cost_of(map, {12, 3}, {.smear = 0, .hole = 0});
    const Roadmap roads = roadmap(paths, cost, {.leads = false});
    const CostToGo to_go = cost_to_go(roads, paths, cost, {.from_mm = {}, .slack_mm = 1e9, .entry_cost = {}});
    for (const Vec2 corner : {Vec2{-8, -8}, {45, -8}, {45, 45}, {-8, 45}}) {
      const std::uint32_t start = cheapest_start(roads, paths.front(), cost, to_go, corner);
      const auto all = [&](std::uint32_t e) {
        const Vec2 at = roads.nodes_mm[roads.entries.front()[e].node];
        return to_go.cost[e] + way_between(roads, cost, paths.front().extruder, corner, at).cost;
      };
      for (std::uint32_t e = 0; e < to_go.cost.size(); ++e) EXPECT_LE(all(start), all(e) * 1.02 + 2) << e;
      others += start != std::uint32_t(std::ranges::min_element(to_go.cost) - to_go.cost.begin());
    }
  }
  EXPECT_GT(others, 3);
}

TEST(WayBetween, GoesAroundForeignPlastic) {
  const DrawnLayer layer({rectangle({20, 0}, {25, 5}), rectangle({8, -6}, {12, 8})});
  const std::vector<Path> paths{drawn_path(0, {{21, 1}, {24, 1}}, false), drawn_path(1, {{9, -5}, {11, -5}}, false)};
  const LayerMap map = layer.map();
  const TravelCost cost(map, {{0, {0, 0}, {}}, {1, {100, 0}, {}}}, {});
  const Roadmap roads = roadmap(paths, cost);
  const Vec2 from{1, 1};
  const PlannedWay planned = way_between(roads, cost, 0, from, paths[0].points.front());
  std::vector<Vec2> way{from};
  way.insert(way.end(), planned.between_mm.begin(), planned.between_mm.end());
  way.push_back(paths[0].points.front());
  EXPECT_GT(cost.straight(way.front(), way.back()).foreign, 0.5);
  for (std::size_t i = 0; i + 1 < way.size(); ++i) EXPECT_EQ(cost.straight(way[i], way[i + 1]).foreign, 0) << i;
}

TEST(Roadmap, WallsOfASourceAreNotLedInside) {
  std::mt19937 random(4);
  std::vector<Path> paths;
  const DrawnLayer layer = random_drawn_layer(random, 5, 30, paths);
  const LayerMap map = layer.map();
  const TravelCost cost = cost_of(map, {12, 3});
  const auto led = [&] {
    int count = 0;
    for (const std::vector<Entry>& entries : roadmap(paths, cost).entries)
      count += int(std::ranges::count_if(entries, [](const Entry& e) { return e.lead_mm > 0; }));
    return count;
  };
  EXPECT_GT(led(), 0);
  for (Path& path : paths) path.source = 0;
  EXPECT_EQ(led(), 0);
}

}  // namespace
}  // namespace cleancolor
