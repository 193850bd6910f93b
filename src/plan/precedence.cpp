#include "plan/precedence.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace cleancolor {
namespace {

/// Squared distance from p to the nearest place of the path.
double distance_to_line(const Path& path, Vec2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < path.segments(); ++i) {
    const Vec2 q = nearest_on_segment(path.points[i], path.points[(i + 1) % path.points.size()], p);
    least = std::min(least, length_squared(p - q));
  }
  return least;
}

/// A loop, and the path that it belongs to: itself, or the one that it is joined to.
struct Loop {
  const Path* path = nullptr;
  int owner = 0;
};

}  // namespace

std::vector<int> outer_loops(std::span<const Path> paths) {
  std::map<int, std::vector<Loop>> by_depth;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (!is_loop(paths[i])) continue;
    by_depth[paths[i].depth].push_back({&paths[i], int(i)});
    for (const Path& inner : paths[i].inner) by_depth[inner.depth].push_back({&inner, int(i)});
  }
  std::vector<int> result(paths.size(), -1);
  for (const auto& [depth, loops] : by_depth) {
    const auto outside = by_depth.find(depth - 1);
    if (outside == by_depth.end()) continue;
    const std::vector<Loop>& around = outside->second;
    for (const auto& [path, owner] : loops) {
      if (path != &paths[std::size_t(owner)]) continue;
      const auto distance = [start = path->start()](const Loop& loop) { return distance_to_line(*loop.path, start); };
      result[std::size_t(owner)] =
          around.size() == 1 ? around.front().owner : std::ranges::min_element(around, {}, distance)->owner;
    }
  }
  return result;
}

std::vector<std::vector<int>> precedence(std::span<const Path> paths, bool external_first) {
  std::vector<std::vector<int>> before(paths.size());
  std::map<int, std::vector<int>> islands;
  std::vector<int> ironing;
  for (std::size_t i = 0; i < paths.size(); ++i)
    (irons(paths[i]) ? ironing : islands[paths[i].island]).push_back(int(i));
  for (std::size_t k = 0; k < ironing.size(); ++k) {
    std::vector<int>& own = before[std::size_t(ironing[k])];
    if (k > 0) own = {ironing[k - 1]};
    for (std::size_t i = 0; k == 0 && i < paths.size(); ++i)
      if (!irons(paths[i])) own.push_back(int(i));
  }
  for (const auto& [island, own] : islands) {
    std::vector<Path> copies;
    for (const int i : own) copies.push_back(paths[std::size_t(i)]);
    const std::vector<int> outer = outer_loops(copies);
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (!is_loop(copies[k])) {
        for (std::size_t l = 0; l < own.size(); ++l)
          if (is_loop(copies[l])) before[std::size_t(own[k])].push_back(own[l]);
      } else if (outer[k] >= 0) {
        const int out = own[std::size_t(outer[k])];
        before[std::size_t(external_first ? own[k] : out)].push_back(external_first ? out : own[k]);
      }
    }
  }
  return before;
}

}  // namespace cleancolor
