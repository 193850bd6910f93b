// tests/plan/free_way.hpp
//
// Free way: whether a carriage could have gone from one place to another without hanging over visible plastic of
// another colour; by a fine grid, slow and obvious.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <span>
#include <vector>

#include "plan/cost.hpp"

namespace cleancolor::test {

/// The largest visibility of foreign plastic that nozzles hang over along a way of the carriage. Where its places are
/// known to so many mm only, each straight piece is moved by that, and the least counts.
inline double foreign_on(const TravelCost& cost, std::span<const Vec2> way, double rounding_mm = 0) {
  const auto straight = [&](Vec2 a, Vec2 b) {
    int foreign = 0;
    for (const TravelCost::Nozzle& n : cost.nozzles())
      cost.map().any_along(a + n.offset_mm, b + n.offset_mm, [&](LayerMap::Cell cell) {
        if (cell.extruder != n.extruder) foreign = std::max(foreign, int(cell.visibility));
        return false;
      });
    return foreign / 255.;
  };
  double foreign = 0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    double piece = straight(way[i], way[i + 1]);
    for (const Vec2 by : {Vec2{1, 1}, Vec2{-1, 1}, Vec2{1, -1}, Vec2{-1, -1}})
      if (rounding_mm > 0 && piece > foreign)
        piece = std::min(piece, straight(way[i] + by * rounding_mm, way[i + 1] + by * rounding_mm));
    foreign = std::max(foreign, piece);
  }
  return foreign;
}

struct FreeWay {
  double longest_mm = 0;  // of the way
  double visible = 0;     // foreign plastic up to this visibility may be crossed
  int nozzle = -1;        // of the cost: the one that must stay where it reaches; -1: none
};

/// Such a way from a to b on a grid of 0.25 mm, the shortest; empty: it has none.
inline std::vector<Vec2> free_way(const TravelCost& cost, Vec2 a, Vec2 b, const FreeWay& wanted) {
  constexpr double cell = 0.25;
  constexpr int margin = int(45 / cell);
  // a is a node; the node nearest to b lies at b.
  const auto cells = [](double mm) { return int(std::lround(mm / cell)); };
  const int dx = cells(b.x - a.x), dy = cells(b.y - a.y);
  const int left = margin + std::max(0, -dx), below = margin + std::max(0, -dy);
  const int columns = 2 * margin + std::abs(dx) + 1, rows = 2 * margin + std::abs(dy) + 1;
  const int first = below * columns + left, last = (below + dy) * columns + left + dx;
  const auto place = [&](int i) {
    return i == last ? b : a + Vec2{double(i % columns - left), double(i / columns - below)} * cell;
  };
  const auto is_reached = [&](int i) {
    return wanted.nozzle < 0 || TravelCost::reaches(cost.nozzles()[std::size_t(wanted.nozzle)], place(i));
  };
  std::vector<int> before(std::size_t(columns) * std::size_t(rows), -1);
  std::vector<double> way(std::size_t(columns) * std::size_t(rows), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  queue.emplace(way[std::size_t(first)] = 0, first);
  while (!queue.empty()) {
    const auto [w, i] = queue.top();
    queue.pop();
    if (w > wanted.longest_mm) return {};
    if (i == last) {
      std::vector<Vec2> result;
      for (int k = i; k >= 0; k = before[std::size_t(k)]) result.push_back(place(k));
      if (first == last) result.push_back(a);
      std::ranges::reverse(result);
      return result;
    }
    if (w > way[std::size_t(i)]) continue;
    for (int y = i / columns - 1; y <= i / columns + 1; ++y)
      for (int x = i % columns - 1; x <= i % columns + 1; ++x) {
        if (x < 0 || y < 0 || x >= columns || y >= rows) continue;
        const int j = y * columns + x;
        const double next = w + distance(place(i), place(j));
        if (next >= way[std::size_t(j)] || !is_reached(j)) continue;
        if (foreign_on(cost, std::array{place(i), place(j)}) > wanted.visible) continue;
        before[std::size_t(j)] = i;
        queue.emplace(way[std::size_t(j)] = next, j);
      }
  }
  return {};
}

}  // namespace cleancolor::test
