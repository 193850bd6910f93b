#include "plan/inclusion_order.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "plan/precedence.hpp"

namespace cleancolor {
namespace {

constexpr std::size_t asked = 9;  // places of a path: one alone could touch a loop

struct Cycle {
  Box<Vec2> box;
  Ring ring;
  double area_mm2 = 0;
};

bool divides(const Path& path) {
  return path.closed && is_loop(path);
}

Cycle cycle_of(const Path& path) {
  Cycle cycle;
  for (const Vec2 p : path.points) {
    cycle.box.add(p);
    cycle.ring.push_back(to_nm(p));
  }
  cycle.area_mm2 = std::abs(area_mm2(cycle.ring));
  return cycle;
}

bool lies_in(const Box<Vec2>& box, Vec2 p) {
  return p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y;
}

/// Most of the places asked decide: loops may touch, and fills may end on them.
bool is_inside(const Path& path, const Cycle& cycle) {
  const Polygons region{cycle.ring};
  const std::size_t n = path.segments(), count = std::min(n, asked);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = i * n / count;
    const Vec2 p = lerp(path.points[k], path.points[(k + 1) % path.points.size()], 0.5);
    inside += lies_in(cycle.box, p) && contains(region, to_nm(p));
  }
  return 2 * inside > count;
}

class InclusionTree {
 public:
  explicit InclusionTree(std::span<const Path> paths)
      : paths_(paths), loops_in_(paths.size() + 1), fills_in_(paths.size() + 1) {
    std::vector<Cycle> cycles(paths.size());
    for (std::size_t i = 0; i < paths.size(); ++i) {
      length_mm_.push_back(length_mm(paths[i]));
      if (divides(paths[i])) cycles[i] = cycle_of(paths[i]);
    }
    for (std::size_t i = 0; i < paths.size(); ++i)
      (divides(paths[i]) ? loops_in_ : fills_in_)[around(i, cycles)].push_back(int(i));
    const auto length = [&](int i) { return length_mm_[std::size_t(i)]; };
    for (std::vector<int>& loops : loops_in_) std::ranges::stable_sort(loops, std::greater(), length);
    const auto fill_rank = [&](int i) { return std::pair(paths_[std::size_t(i)].extruder, -length(i)); };
    for (std::vector<int>& fills : fills_in_) std::ranges::stable_sort(fills, {}, fill_rank);
  }

  std::vector<int> order() {
    gather(paths_.size());
    return std::move(order_);
  }

 private:
  /// The smallest loop that a path lies in; paths_.size(): none.
  std::size_t around(std::size_t i, const std::vector<Cycle>& cycles) const {
    std::size_t best = paths_.size();
    for (std::size_t k = 0; k < paths_.size(); ++k) {
      if (k == i || !divides(paths_[k])) continue;
      // Of two loops at the same place the first is taken to be the inner one.
      const auto size = [&](std::size_t c) { return std::pair(cycles[c].area_mm2, c); };
      if (divides(paths_[i]) && size(k) <= size(i)) continue;
      if (best < paths_.size() && size(best) <= size(k)) continue;
      if (is_inside(paths_[i], cycles[k])) best = k;
    }
    return best;
  }

  /// All that lies in the zone of a loop.
  void gather(std::size_t zone) {
    for (const int loop : loops_in_[zone]) {
      gather(std::size_t(loop));
      order_.push_back(loop);
    }
    order_.insert(order_.end(), fills_in_[zone].begin(), fills_in_[zone].end());
  }

  std::span<const Path> paths_;
  std::vector<double> length_mm_;
  // By the loop around them; the last: of no loop.
  std::vector<std::vector<int>> loops_in_, fills_in_;
  std::vector<int> order_;
};

}  // namespace

std::vector<int> inclusion_order(std::span<const Path> paths) {
  return InclusionTree(paths).order();
}

}  // namespace cleancolor
