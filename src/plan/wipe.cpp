#include "plan/wipe.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "plan/clear_way.hpp"

namespace cleancolor {
namespace {

constexpr double farthest_mm = 30;      // that a way may become longer
constexpr double least_mm3 = 2e-4;      // of smear that a pass must bring
constexpr double left_over = 0.1;       // of what hangs on tips in the end is taken to be smeared later
constexpr std::size_t paths_ahead = 4;  // to the touch that a pass is for
constexpr std::size_t most_places = 3;  // of walls that are tried for each nozzle
constexpr double apart_mm = 4;          // between them

/// Where a nozzle crosses a wall: a road width beyond its centre line.
struct Place {
  Vec2 at_mm;
  double way_mm = 0;  // from and to where the nozzle goes, by this place
};

/// Beyond a segment of a wall, where the way from p to q by it is shortest.
Place beyond(Vec2 a, Vec2 b, double by_mm, Vec2 p, Vec2 q) {
  const double length = std::max(distance(a, b), 1e-9);
  const Vec2 along = (b - a) * (1 / length), across{-along.y, along.x};
  const double p_off = dot(p - a, across), q_off = dot(q - a, across);
  // Straight to the mirror image of q, or to q on the other side.
  const double sum = std::max(std::abs(p_off) + std::abs(q_off), 1e-9);
  const double p_along = dot(p - a, along), q_along = dot(q - a, along);
  const double t = std::clamp(p_along + (q_along - p_along) * std::abs(p_off) / sum, 0., length);
  const Vec2 at = a + along * t + across * (p_off > 0 ? -by_mm : by_mm);
  return {at, distance(p, at) + distance(at, q)};
}

class Wipes {
 public:
  Wipes(std::span<Path> paths, const Roadmap& roads, const TravelCost& cost, const WipeOptions& options)
      : paths_(paths), roads_(roads), cost_(cost), options_(options) {}

  void find(const OozeModel& model) {
    std::vector<ForecastWalk> before;  // each hop
    std::vector<std::vector<std::optional<double>>> touched;
    ForecastWalk walk(paths_, cost_, model, options_.hop);
    for (const Path& path : paths_) {
      before.push_back(walk);
      walk.print(path);
      touched.push_back(walk.first_touches());
    }
    next_.assign(cost_.nozzles().size(), {});
    for (std::size_t k = paths_.size(); k-- > 1;) {
      remember(touched[k], k);
      if (!is_auxiliary(paths_[k].road().role)) improve(k, before[k]);
    }
  }

 private:
  /// Where a nozzle next leaves what it carries.
  struct Next {
    double visibility = 0;  // of foreign plastic
    std::size_t path = 0;
  };
  struct Candidate {
    double most_mm3 = 0;  // that it can bring
    std::size_t nozzle = 0;
    Place place;
  };

  void remember(const std::vector<std::optional<double>>& touched, std::size_t k) {
    for (std::size_t n = 0; n < touched.size(); ++n)
      if (touched[n]) next_[n] = {*touched[n], k};
  }

  /// The hop to path k by way of a wall, if one is worth it.
  void improve(std::size_t k, const ForecastWalk& before) {
    const std::vector<Candidate> candidates = candidates_of(k, before);
    if (candidates.empty()) return;
    std::size_t last = k;
    for (const Candidate& c : candidates) last = std::max(last, next_[c.nozzle].path);
    double best = spoilt(k, last, before, paths_[k].travel) - least_mm3;
    std::optional<std::vector<Vec2>> best_travel;
    for (const Candidate& c : candidates) {
      std::optional<std::vector<Vec2>> travel = travel_by(k, before, c);
      if (!travel) continue;
      const double with = spoilt(k, last, before, *travel);
      if (with >= best) continue;
      best = with;
      best_travel = std::move(travel);
    }
    if (!best_travel) return;
    paths_[k].travel = std::move(*best_travel);
    ForecastWalk walk = before;
    walk.print(paths_[k]);
    remember(walk.first_touches(), k);
  }

  /// What is spoilt and lost from before path `first` to the end of path `last`, in mm3 of smear.
  double spoilt(std::size_t first, std::size_t last, ForecastWalk walk, std::span<const Vec2> travel) const {
    const LayerForecast before = walk.result();
    walk.print(paths_[first], travel);
    for (std::size_t i = first + 1; i <= last; ++i) walk.print(paths_[i]);
    const LayerForecast& after = walk.result();
    double sum = after.smear_mm3 - before.smear_mm3 + options_.hole_weight * (after.hole_mm3 - before.hole_mm3) +
                 options_.s_mm3 * (after.seconds - before.seconds);
    for (const IdleState& state : walk.states()) sum += left_over * state.carried_mm3;
    return sum;
  }

  /// Places by which a pass may be worth its time, whatever the forecast says of it.
  std::vector<Candidate> candidates_of(std::size_t k, const ForecastWalk& before) const {
    const Vec2 from = *before.carriage_mm(), to = paths_[k].start() - offset_of(k);
    const double hop_mm = travel_mm(from + offset_of(k), paths_[k]);
    std::vector<Candidate> result;
    for (std::size_t n = 0; n < next_.size(); ++n) {
      if (next_[n].path > k + paths_ahead) continue;
      const double carried_mm3 = before.states()[n].carried_mm3 * next_[n].visibility;
      if (carried_mm3 < least_mm3) continue;
      const Vec2 offset = cost_.nozzles()[n].offset_mm;
      for (const Place& place : places_between(from + offset, to + offset, k, hop_mm + farthest_mm)) {
        const double more_s = options_.hop.seconds(place.way_mm) - options_.hop.seconds(hop_mm);
        // More comes out on the way to the wall, and all that stays there.
        const double most_mm3 = 1.5 * carried_mm3 - options_.s_mm3 * more_s;
        if (most_mm3 > least_mm3) result.push_back({most_mm3, n, place});
      }
    }
    return result;
  }

  /// The shortest ways of a nozzle by walls that stand before path k.
  std::vector<Place> places_between(Vec2 p, Vec2 q, std::size_t k, double most_mm) const {
    std::vector<Place> found;
    for (const Path& wall : paths_.first(k)) {
      if (wall.road().role != Role::rampart) continue;
      for (std::size_t i = 0; i < wall.segments(); ++i) {
        const Place place =
            beyond(wall.points[i], wall.points[(i + 1) % wall.points.size()], wall.road().width_mm, p, q);
        if (place.way_mm <= most_mm) found.push_back(place);
      }
    }
    std::ranges::stable_sort(found, {}, &Place::way_mm);
    std::vector<Place> result;
    for (const Place& place : found) {
      const auto is_near = [&](const Place& other) { return distance(place.at_mm, other.at_mm) < apart_mm; };
      if (std::ranges::none_of(result, is_near)) result.push_back(place);
      if (result.size() == most_places) break;
    }
    return result;
  }

  /// Path::travel by way of the place; nothing where that crosses another colour.
  std::optional<std::vector<Vec2>> travel_by(std::size_t k, const ForecastWalk& before, const Candidate& c) const {
    const Vec2 from = *before.carriage_mm(), to = paths_[k].start() - offset_of(k);
    const Vec2 by = c.place.at_mm - cost_.nozzles()[c.nozzle].offset_mm;
    std::vector<Vec2> way = way_to(k, from, by);
    const std::vector<Vec2> on = way_to(k, by, to);
    way.insert(way.end(), on.begin() + 1, on.end());
    std::vector<Vec2> travel(way.begin() + 1, way.end() - 1);
    const auto is_reached = [&](Vec2 p) { return TravelCost::reaches(nozzle_of(k), p); };
    if (crosses(cost_, way) || !std::ranges::all_of(travel, is_reached)) return std::nullopt;
    for (Vec2& p : travel) p = p + offset_of(k);
    return travel;
  }

  /// Straight where that is clear, else on the roadmap.
  std::vector<Vec2> way_to(std::size_t k, Vec2 from, Vec2 to) const {
    std::vector<Vec2> way{from, to};
    if (!crosses(cost_, way)) return way;
    const PlannedWay planned = way_between(roads_, cost_, paths_[k].extruder, from, to);
    way.insert(way.begin() + 1, planned.between_mm.begin(), planned.between_mm.end());
    return way;
  }

  const TravelCost::Nozzle& nozzle_of(std::size_t k) const {
    return *std::ranges::find(cost_.nozzles(), paths_[k].extruder, &TravelCost::Nozzle::extruder);
  }
  Vec2 offset_of(std::size_t k) const { return nozzle_of(k).offset_mm; }

  std::span<Path> paths_;
  const Roadmap& roads_;
  const TravelCost& cost_;
  const WipeOptions& options_;
  std::vector<Next> next_;  // of each nozzle
};

}  // namespace

WipeOptions wipe_options(const Config& c, int extruder) {
  return {.hole_weight = c.weight_hole_volume, .s_mm3 = c.weight_time, .hop = hop_time(c, extruder)};
}

std::vector<Path> with_wipes(std::vector<Path> paths, const Roadmap& roads, const TravelCost& cost,
                             const OozeModel& model, const WipeOptions& options) {
  Wipes(paths, roads, cost, options).find(model);
  return paths;
}

}  // namespace cleancolor
