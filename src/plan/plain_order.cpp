#include "plan/plain_order.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace cleancolor {
namespace {

/// Squared distance from p to where the path can be begun: either end of an open one, any point of a closed one.
double distance_to(const Path& path, Vec2 p) {
  if (!path.closed) return std::min(length_squared(path.points.front() - p), length_squared(path.points.back() - p));
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2 q : path.points) least = std::min(least, length_squared(q - p));
  return least;
}

/// [extruder][island]; std::map keeps both in their order.
using Islands = std::map<int, std::map<int, std::vector<Path>>>;

class Orderer {
 public:
  Orderer(Layer& layer, OrderState& state, const Config& config) : layer_(layer), state_(state), config_(config) {}

  void run() {
    Islands paths;
    for (Path& path : layer_.paths) paths[path.extruder][path.island].push_back(std::move(path));
    layer_.paths.clear();
    for (const int extruder : sequence(paths)) print_extruder(extruder, paths[extruder]);
    state_.seams.next_layer();
  }

 private:
  /// The extruder of the layer below first. Before it, in the first layer, those that are only primed there: the part
  /// is not left for them.
  std::vector<int> sequence(const Islands& paths) const {
    std::vector<int> result;
    for (const auto& [extruder, islands] : paths) result.push_back(extruder);
    const auto rank = [&](int extruder) {
      const bool only_primed = paths.at(extruder).rbegin()->first == -1;
      return layer_.index == 0 && only_primed ? 0 : extruder == state_.extruder ? 1 : 2;
    };
    std::stable_sort(result.begin(), result.end(), [&](int a, int b) { return rank(a) < rank(b); });
    return result;
  }

  void print_extruder(int extruder, std::map<int, std::vector<Path>>& islands) {
    state_.extruder = extruder;
    if (const auto bed = islands.find(-1); bed != islands.end()) {
      for (Path& path : bed->second) print(std::move(path));
      islands.erase(bed);
    }
    while (!islands.empty()) {
      auto nearest = islands.begin();
      double least = std::numeric_limits<double>::infinity();
      for (auto it = islands.begin(); it != islands.end(); ++it)
        for (const Path& path : it->second)
          if (const double d = distance_to(path, state_.at); d < least) least = d, nearest = it;
      print_island(std::move(nearest->second));
      islands.erase(nearest);
    }
  }

  void print_island(std::vector<Path> paths) {
    // Perimeters by depth, the innermost first; what has no depth is infill and comes last.
    const bool out_first = config_.external_perimeters_first;
    const auto rank = [&](const Path& p) {
      return p.depth == fill_depth ? fill_depth : out_first ? p.depth : -p.depth;
    };
    std::stable_sort(paths.begin(), paths.end(), [&](const Path& a, const Path& b) { return rank(a) < rank(b); });
    for (auto from = paths.begin(); from != paths.end();) {
      const int depth = from->depth;
      const auto to = std::find_if(from, paths.end(), [&](const Path& p) { return p.depth != depth; });
      for (; from != to; ++from) {
        const auto nearest = std::min_element(from, to, [&](const Path& a, const Path& b) {
          return distance_to(a, state_.at) < distance_to(b, state_.at);
        });
        std::iter_swap(from, nearest);
        print(std::move(*from));
      }
    }
  }

  void print(Path path) {
    if (path.closed) {
      const auto seed = std::uint32_t(layer_.index) * 7919u + std::uint32_t(layer_.paths.size());
      path = seamed(std::move(path), config_.seam_position, state_.at, state_.seams, seed);
    } else if (length_squared(path.points.back() - state_.at) < length_squared(path.points.front() - state_.at)) {
      path = reversed(std::move(path));
    }
    state_.at = path.end();
    layer_.paths.push_back(std::move(path));
  }

  Layer& layer_;
  OrderState& state_;
  const Config& config_;
};

}  // namespace

void order(Layer& layer, OrderState& state, const Config& config) {
  Orderer(layer, state, config).run();
}

}  // namespace cleancolor
