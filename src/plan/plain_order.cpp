#include "plan/plain_order.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "plan/inclusion_order.hpp"
#include "plan/precedence.hpp"
#include "shield/start.hpp"

namespace cleancolor {
namespace {

/// Squared distance from p to where the path can be begun: either end of an open one, any point of a closed one.
double distance_to(const Path& path, Vec2 p) {
  if (!path.closed) return std::min(length_squared(path.points.front() - p), length_squared(path.points.back() - p));
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2 q : path.points) least = std::min(least, length_squared(q - p));
  return least;
}

/// Squared distance from p to the box; 0 inside.
double distance_to(const Box<Vec2>& box, Vec2 p) {
  return length_squared(p - Vec2{std::clamp(p.x, box.min.x, box.max.x), std::clamp(p.y, box.min.y, box.max.y)});
}

constexpr std::size_t walls_compared = 8;
constexpr int bed_island = -1;

/// [extruder][island]; std::map keeps both in their order.
using Islands = std::map<int, std::map<int, std::vector<Path>>>;

class Orderer {
 public:
  Orderer(Layer& layer, OrderState& state, const Config& config, const RampartSite& site)
      : layer_(layer), state_(state), config_(config), site_(site) {}

  void run() {
    Islands paths;
    for (Path& path : layer_.paths) {
      std::map<int, std::vector<Path>>& own = paths[path.extruder];
      std::vector<Path>& like_it = path.road().role == Role::rampart ? walls_[path.extruder]
                                   : irons(path)                     ? ironing_[path.extruder]
                                                                     : own[path.island];
      like_it.push_back(std::move(path));
    }
    layer_.paths.clear();
    if (prints_by_inclusion(config_)) {
      print_by_inclusion(paths);
    } else {
      print_by_extruder(paths);
    }
    for (auto& [extruder, all] : ironing_) print_ironing(extruder);
    state_.seams.next_layer();
  }

 private:
  void print_by_extruder(Islands& paths) {
    const std::vector<int> extruders = sequence(paths);
    print_all_walls(paths, extruders);
    for (const int extruder : extruders) {
      print_bed(paths[extruder]);
      print_walls(extruder);
      print_extruder(extruder, paths[extruder]);
      print_ironing(extruder);
    }
  }

  /// Each extruder's bed and walls come before its first path; those that print nothing of the part come first.
  void print_by_inclusion(Islands& paths) {
    std::vector<Path> part;
    for (auto& [extruder, islands] : paths)
      for (auto& [island, own] : islands)
        if (island != bed_island) std::ranges::move(own, std::back_inserter(part));
    const std::vector<int> order = inclusion_order(part);
    std::vector<int> extruders;
    const auto takes_part = [&](int extruder) { return std::ranges::find(extruders, extruder) != extruders.end(); };
    for (const int i : order)
      if (const int extruder = part[std::size_t(i)].extruder; !takes_part(extruder)) extruders.push_back(extruder);
    std::vector<int> others;
    for (const int extruder : sequence(paths))
      if (!takes_part(extruder)) others.push_back(extruder);
    extruders.insert(extruders.begin(), others.begin(), others.end());
    print_all_walls(paths, extruders);
    const auto prepare = [&](int extruder) {
      print_bed(paths[extruder]);
      print_walls(extruder);
    };
    for (const int extruder : others) prepare(extruder);
    for (const int i : order) {
      Path& path = part[std::size_t(i)];
      prepare(path.extruder);
      state_.extruder = path.extruder;
      print(std::move(path));
    }
  }

  void print_all_walls(Islands& paths, const std::vector<int>& extruders) {
    // The walls of the first extruder last, so that it goes on.
    if (config_.rampart_order == RampartOrder::layer_start)
      for (std::size_t i = extruders.size(); i-- > 0;) {
        print_bed(paths[extruders[i]]);
        print_walls(extruders[i]);
      }
  }

  /// The extruder of the layer below first. Before it, in the first layer, those that are only primed there: the part
  /// is not left for them.
  std::vector<int> sequence(const Islands& paths) const {
    std::vector<int> result;
    for (const auto& [extruder, islands] : paths) result.push_back(extruder);
    const auto rank = [&](int extruder) {
      const bool only_primed = paths.at(extruder).empty() || paths.at(extruder).rbegin()->first == bed_island;
      return layer_.index == 0 && only_primed ? 0 : extruder == state_.extruder ? 1 : 2;
    };
    std::stable_sort(result.begin(), result.end(), [&](int a, int b) { return rank(a) < rank(b); });
    return result;
  }

  /// Skirt, brim and prime lines.
  void print_bed(std::map<int, std::vector<Path>>& islands) {
    const auto bed = islands.find(bed_island);
    if (bed == islands.end()) return;
    for (Path& path : bed->second) print(std::move(path));
    islands.erase(bed);
  }

  /// One after the other, each begun where it wipes best.
  void print_walls(int extruder) {
    std::vector<Path> walls = std::move(walls_[extruder]);
    walls_.erase(extruder);
    if (walls.empty()) return;
    scene_.idle_mm.clear();
    const Vec2 own = config_.extruders[std::size_t(extruder)].nozzle_offset_mm;
    for (const int e : site_.extruders)
      if (e != extruder) scene_.idle_mm.push_back(config_.extruders[std::size_t(e)].nozzle_offset_mm - own);
    if (scene_.part.empty()) scene_.part = site_.part;
    state_.extruder = extruder;
    while (!walls.empty()) {
      // Of the nearest few the one that exposes the part least.
      std::ranges::stable_sort(walls, {}, [&](const Path& wall) { return distance_to(wall, state_.at); });
      std::size_t best = 0;
      WallStart start = wall_start(walls.front(), scene_, state_.at);
      for (std::size_t i = 1; i < std::min(walls.size(), walls_compared) && start.exposure_mm > 0; ++i)
        if (const WallStart other = wall_start(walls[i], scene_, state_.at); other.exposure_mm < start.exposure_mm)
          start = other, best = i;
      Path wall = begun(std::move(walls[best]), start);
      walls.erase(walls.begin() + std::ptrdiff_t(best));
      state_.at = wall.end();
      scene_.standing.push_back(wall);
      layer_.paths.push_back(std::move(wall));
    }
  }

  void print_extruder(int extruder, std::map<int, std::vector<Path>>& islands) {
    state_.extruder = extruder;
    // An island whose box is farther than the nearest path so far need not be looked at.
    std::map<int, Box<Vec2>> boxes;
    for (const auto& [island, paths] : islands)
      for (const Path& path : paths)
        for (const Vec2 p : path.points) boxes[island].add(p);
    while (!islands.empty()) {
      auto nearest = islands.begin();
      double least = std::numeric_limits<double>::infinity();
      for (auto it = islands.begin(); it != islands.end(); ++it) {
        if (distance_to(boxes[it->first], state_.at) >= least) continue;
        for (const Path& path : it->second)
          if (const double d = distance_to(path, state_.at); d < least) least = d, nearest = it;
      }
      print_island(std::move(nearest->second));
      islands.erase(nearest);
    }
  }

  void print_island(std::vector<Path> paths) {
    // How many paths each one waits for: a loop for those within it, or for the one around it; a fill for all loops.
    const std::vector<int> outer = outer_loops(paths);
    const bool out_first = config_.external_perimeters_first;
    std::vector<int> waits(paths.size(), 0);
    for (std::size_t i = 0; i < paths.size(); ++i)
      if (outer[i] >= 0) ++waits[out_first ? i : std::size_t(outer[i])];
    int loops = int(std::count_if(paths.begin(), paths.end(), is_loop));
    std::vector<std::size_t> rest(paths.size());
    std::iota(rest.begin(), rest.end(), std::size_t{0});
    while (!rest.empty()) {
      auto next = rest.end();
      double least = std::numeric_limits<double>::infinity();
      for (auto it = rest.begin(); it != rest.end(); ++it) {
        if (is_loop(paths[*it]) ? waits[*it] > 0 : loops > 0) continue;
        const double d = distance_to(paths[*it], state_.at);
        if (d < least) least = d, next = it;
      }
      const std::size_t i = *next;
      rest.erase(next);
      if (is_loop(paths[i])) --loops;
      for (std::size_t k = 0; k < paths.size(); ++k)
        if (out_first ? outer[k] == int(i) : outer[i] == int(k)) --waits[k];
      print(std::move(paths[i]));
    }
  }

  /// As it is given.
  void print_ironing(int extruder) {
    for (Path& path : std::exchange(ironing_[extruder], {})) {
      state_.extruder = extruder;
      state_.at = path.end();
      layer_.paths.push_back(std::move(path));
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
  const RampartSite& site_;
  std::map<int, std::vector<Path>> walls_, ironing_;  // by extruder
  WallScene scene_;
};

}  // namespace

void order(Layer& layer, OrderState& state, const Config& config, const RampartSite& site) {
  Orderer(layer, state, config, site).run();
}

std::vector<int> first_extruders(const std::vector<std::vector<int>>& printing, int first) {
  std::vector<int> result;
  int current = first;
  for (const std::vector<int>& here : printing) {
    if (std::ranges::find(here, current) == here.end() && !here.empty()) current = here.front();
    result.push_back(current);
    // The others follow in ascending order.
    if (!here.empty() && here.size() > 1) current = here.back() != current ? here.back() : here[here.size() - 2];
  }
  return result;
}

}  // namespace cleancolor
