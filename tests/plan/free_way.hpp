// tests/plan/free_way.hpp
//
// Free way: whether a carriage could have gone from one place to another without hanging over visible plastic of
// another colour; by a fine grid, slow and obvious.
#pragma once

#include <cmath>
#include <limits>
#include <queue>
#include <span>
#include <vector>

#include "plan/cost.hpp"

namespace cleancolor::test {

/// The largest visibility of foreign plastic that nozzles hang over along a way of the carriage.
inline double foreign_on(const TravelCost& cost, std::span<const Vec2> way) {
  double foreign = 0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i)
    foreign = std::max(foreign, cost.straight(way[i], way[i + 1]).foreign);
  return foreign;
}

struct FreeWay {
  double longest_mm = 0;  // of the way
  double visible = 0;     // foreign plastic up to this visibility may be crossed
  int nozzle = -1;        // of the cost: the one that must stay where it reaches; -1: none
};

/// Whether a grid of 0.25 mm has such a way from a to b.
inline bool grid_finds_a_way(const TravelCost& cost, Vec2 a, Vec2 b, const FreeWay& wanted) {
  constexpr double cell = 0.25;
  const Vec2 low = Vec2{std::min(a.x, b.x), std::min(a.y, b.y)} - Vec2{45, 45};
  const int columns = int((std::abs(a.x - b.x) + 90) / cell), rows = int((std::abs(a.y - b.y) + 90) / cell);
  const auto place = [&](int i) { return low + Vec2{i % columns + 0.5, i / columns + 0.5} * cell; };
  const auto index = [&](Vec2 p) { return int((p.y - low.y) / cell) * columns + int((p.x - low.x) / cell); };
  const auto is_reached = [&](int i) {
    return wanted.nozzle < 0 || TravelCost::reaches(cost.nozzles()[std::size_t(wanted.nozzle)], place(i));
  };
  std::vector<double> way(std::size_t(columns) * std::size_t(rows), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  queue.emplace(way[std::size_t(index(a))] = 0, index(a));
  while (!queue.empty()) {
    const auto [w, i] = queue.top();
    queue.pop();
    if (w > wanted.longest_mm) return false;
    if (i == index(b)) return true;
    if (w > way[std::size_t(i)]) continue;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = i % columns + dx, y = i / columns + dy;
        if (x < 0 || y < 0 || x >= columns || y >= rows) continue;
        const int j = y * columns + x;
        const double next = w + cell * std::hypot(dx, dy);
        if (next >= way[std::size_t(j)] || cost.straight(place(i), place(j)).foreign > wanted.visible) continue;
        if (!is_reached(j)) continue;
        queue.emplace(way[std::size_t(j)] = next, j);
      }
  }
  return false;
}

}  // namespace cleancolor::test
