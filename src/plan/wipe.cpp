#include "plan/wipe.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "plan/clear_way.hpp"

namespace cleancolor {
namespace {

constexpr double farthest_mm = 30;  // that a way may become longer
constexpr double least_mm3 = 2e-4;  // of smear that a pass must bring
constexpr double more_out = 1.5;    // times what would be smeared, more may come out on the way and stay on the wall
constexpr double left_over = 0.1;   // of what hangs on tips in the end is taken to be smeared later
constexpr std::size_t paths_ahead = 4;  // to the touch that a pass is for
constexpr std::size_t most_places = 3;  // of walls that are tried for each nozzle
constexpr double apart_mm = 4;          // between them
constexpr double way_share = 0.1;       // that a mm of way counts beside one from the wall to the touch
constexpr double cut_mm = 0.5;          // steps by which crossings are told from what is clear
constexpr double shortest_mm = 2;       // clear stretch between two crossings

/// A piece of a way on which no nozzle hangs over another colour.
struct ClearStretch {
  std::size_t first = 0, last = 0;  // places of the way
  double mm = 0;
};

/// The carriage's way to a path.
struct Hop {
  std::vector<Vec2> way;  // with both ends, and the places where a crossing of another colour begins or ends
  double mm = 0;
  std::vector<ClearStretch> clear;  // the first from where the way begins, though it may end there
};

/// The way, cut where crossings begin and end. crossing: for each place but the first whether the segment to it is part
/// of one is added.
std::vector<Vec2> cut(std::span<const Vec2> way, const TravelCost& cost, std::vector<char>& crossing) {
  std::vector<Vec2> result{way.front()};
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Vec2 a = way[i - 1], b = way[i];
    const bool any = crosses(cost, std::array{a, b});
    const int steps = any ? int(distance(a, b) / cut_mm) + 1 : 1;
    for (int k = 1; k <= steps; ++k) {
      const Vec2 p = lerp(a, b, double(k) / steps);
      const bool is_crossing = any && crosses(cost, std::array{lerp(a, b, double(k - 1) / steps), p});
      if (k > 1 && is_crossing == bool(crossing.back()))
        result.back() = p;
      else
        result.push_back(p), crossing.push_back(char(is_crossing));
    }
  }
  return result;
}

Hop hop_of(std::span<const Vec2> way, const TravelCost& cost) {
  std::vector<char> crossing{0};
  Hop hop{.way = cut(way, cost, crossing), .mm = 0, .clear = {{}}};
  for (std::size_t i = 1; i < hop.way.size(); ++i) {
    const double mm = distance(hop.way[i - 1], hop.way[i]);
    hop.mm += mm;
    if (crossing[i] != 0) continue;
    if (crossing[i - 1] != 0) hop.clear.push_back({.first = i - 1});
    hop.clear.back().last = i;
    hop.clear.back().mm += mm;
  }
  return hop;
}

/// Where a nozzle crosses a wall: a road width beyond its centre line.
struct Place {
  Vec2 at_mm;
  double way_mm = 0;  // from and to where the nozzle goes, by this place
  double on_mm = 0;   // of it from here on
};

/// Beyond a segment of a wall: where the way from p to q by it is shortest, and where it is nearest to q.
std::array<Place, 2> beyond(Vec2 a, Vec2 b, double by_mm, Vec2 p, Vec2 q) {
  const double length = std::max(distance(a, b), 1e-9);
  const Vec2 along = (b - a) * (1 / length), across{-along.y, along.x};
  const double p_off = dot(p - a, across), q_off = dot(q - a, across);
  // Straight to the mirror image of q, or to q on the other side.
  const double sum = std::max(std::abs(p_off) + std::abs(q_off), 1e-9);
  const double p_along = dot(p - a, along), q_along = dot(q - a, along);
  const auto place = [&](double t) {
    const Vec2 at = a + along * std::clamp(t, 0., length) + across * (p_off > 0 ? -by_mm : by_mm);
    return Place{at, distance(p, at) + distance(at, q), distance(at, q)};
  };
  return {place(p_along + (q_along - p_along) * std::abs(p_off) / sum), place(q_along)};
}

class Wipes {
 public:
  Wipes(std::span<Path> paths, const Roadmap& roads, const TravelCost& cost, const WipeOptions& options)
      : paths_(paths), roads_(roads), cost_(cost), options_(options) {}

  void find(const OozeModel& model) {
    std::vector<ForecastWalk> before;  // each hop
    std::vector<std::vector<ForecastWalk::Touches>> touches;
    ForecastWalk walk(paths_, cost_, model, options_.hop);
    for (const Path& path : paths_) {
      before.push_back(walk);
      walk.print(path);
      touches.push_back(walk.touches());
    }
    next_.assign(cost_.nozzles().size(), {});
    for (std::size_t k = paths_.size(); k-- > 1;) {
      remember(touches[k], k);
      improve(k, before[k]);
    }
  }

 private:
  /// Where a nozzle next leaves what it carries.
  struct Next {
    ForecastWalk::Touches touches;
    std::size_t path = 0;  // on the way to it, or beside it
  };
  struct Candidate {
    std::size_t nozzle = 0;
    Place place;
    ClearStretch instead;  // of this stretch of the way
  };

  void remember(const std::vector<ForecastWalk::Touches>& touches, std::size_t k) {
    for (std::size_t n = 0; n < touches.size(); ++n)
      if (touches[n].first) next_[n] = {touches[n], k};
  }

  /// The hop to path k by way of a wall, if one is worth it.
  void improve(std::size_t k, const ForecastWalk& before) {
    if (!may_bring(k, before)) return;
    const Hop hop = hop_to(k, before);
    const std::vector<Candidate> candidates = candidates_of(k, before, hop);
    if (candidates.empty()) return;
    std::size_t last = k;
    for (const Candidate& c : candidates) last = std::max(last, next_[c.nozzle].path);
    double best = spoilt(k, last, before, paths_[k].travel) - least_mm3;
    std::optional<std::vector<Vec2>> best_travel;
    for (const Candidate& c : candidates) {
      std::optional<std::vector<Vec2>> travel = travel_by(k, hop, c);
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
    remember(walk.touches(), k);
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

  /// What the nozzle carries on the hop to path k and next leaves on another colour, x visibility.
  double brought_mm3(std::size_t n, std::size_t k, const ForecastWalk& before) const {
    const Next& next = next_[n];
    if (next.path > k + paths_ahead) return 0;
    if (next.path == k) return next.touches.brought_mm3;
    return next.touches.first.value_or(0) * before.states()[n].carried_mm3;
  }
  bool may_bring(std::size_t k, const ForecastWalk& before) const {
    for (std::size_t n = 0; n < next_.size(); ++n)
      if (brought_mm3(n, k, before) >= least_mm3) return true;
    return false;
  }

  Hop hop_to(std::size_t k, const ForecastWalk& before) const {
    std::vector<Vec2> way{options_.stops_mm.empty() ? *before.carriage_mm() : options_.stops_mm[k - 1]};
    for (const Vec2 p : paths_[k].travel) way.push_back(p - offset_of(k));
    way.push_back(paths_[k].start() - offset_of(k));
    return hop_of(way, cost_);
  }

  /// Places by which a pass may be worth its time, whatever the forecast says of it.
  std::vector<Candidate> candidates_of(std::size_t k, const ForecastWalk& before, const Hop& hop) const {
    std::vector<Candidate> result;
    for (std::size_t n = 0; n < next_.size(); ++n) {
      const double smear_mm3 = brought_mm3(n, k, before);
      if (smear_mm3 < least_mm3) continue;
      const Vec2 offset = cost_.nozzles()[n].offset_mm;
      for (const ClearStretch& s : hop.clear) {
        if (s.first > 0 && s.mm < shortest_mm) continue;
        const Vec2 p = hop.way[s.first] + offset, q = hop.way[s.last] + offset;
        for (const Place& place : places_between(p, q, k, s.mm + farthest_mm)) {
          const double more_s = options_.hop.seconds(hop.mm - s.mm + place.way_mm) - options_.hop.seconds(hop.mm);
          if (more_out * smear_mm3 - options_.s_mm3 * more_s > least_mm3) result.push_back({n, place, s});
        }
      }
    }
    return result;
  }

  /// The best ways of a nozzle from p to q by walls that stand before path k.
  std::vector<Place> places_between(Vec2 p, Vec2 q, std::size_t k, double most_mm) const {
    std::vector<Place> found;
    for (const Path& wall : paths_.first(k)) {
      if (wall.road().role != Role::rampart) continue;
      for (std::size_t i = 0; i < wall.segments(); ++i) {
        const Vec2 a = wall.points[i], b = wall.points[(i + 1) % wall.points.size()];
        for (const Place& place : beyond(a, b, wall.road().width_mm, p, q))
          if (place.way_mm <= most_mm) found.push_back(place);
      }
    }
    // What comes out on the way from the wall counts more than the time of the whole.
    std::ranges::stable_sort(found, {}, [](const Place& place) { return place.on_mm + way_share * place.way_mm; });
    std::vector<Place> result;
    for (const Place& place : found) {
      const auto is_near = [&](const Place& other) { return distance(place.at_mm, other.at_mm) < apart_mm; };
      if (std::ranges::none_of(result, is_near)) result.push_back(place);
      if (result.size() == most_places) break;
    }
    return result;
  }

  /// Path::travel by way of the place; nothing where that crosses another colour.
  std::optional<std::vector<Vec2>> travel_by(std::size_t k, const Hop& hop, const Candidate& c) const {
    const Vec2 by = c.place.at_mm - cost_.nozzles()[c.nozzle].offset_mm;
    std::vector<Vec2> way = way_to(k, hop.way[c.instead.first], by);
    const std::vector<Vec2> on = way_to(k, by, hop.way[c.instead.last]);
    way.insert(way.end(), on.begin() + 1, on.end());
    if (crosses(cost_, way)) return std::nullopt;
    way.insert(way.begin(), hop.way.begin(), hop.way.begin() + std::ptrdiff_t(c.instead.first));
    way.insert(way.end(), hop.way.begin() + std::ptrdiff_t(c.instead.last) + 1, hop.way.end());
    std::vector<Vec2> travel(way.begin() + 1, way.end() - 1);
    const auto is_reached = [&](Vec2 p) { return TravelCost::reaches(nozzle_of(k), p); };
    if (!std::ranges::all_of(travel, is_reached)) return std::nullopt;
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
