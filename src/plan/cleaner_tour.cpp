#include "plan/cleaner_tour.hpp"

#include <algorithm>
#include <map>

namespace cleancolor {
namespace {

// A smear on a wall that stands already counts by so much more: whether one still to come takes any is not sure.
constexpr double laid_weight = 0.5;

int steps_a_path(Effort effort) {
  return effort == Effort::fast ? 8 : effort == Effort::normal ? 30 : 200;
}

/// Paths of one extruder, one after the other.
struct Turn {
  std::size_t first = 0, part = 0, last = 0;  // of the paths; those of the part begin at `part`
};

std::vector<Turn> turns_of(std::span<const Path> paths) {
  std::vector<Turn> turns;
  for (std::size_t i = 0; i < paths.size();) {
    Turn t{.first = i, .part = i, .last = i};
    while (t.last < paths.size() && paths[t.last].extruder == paths[i].extruder) ++t.last;
    while (t.part < t.last && paths[t.part].island < 0) ++t.part;
    turns.push_back(t);
    i = t.last;
  }
  return turns;
}

/// Puts the paths of each turn into the order of least predicted ooze, and the roadmap's entries with them.
class Reorder {
 public:
  Reorder(std::span<Path> paths, Roadmap& roads, const TravelCost& cost, const Config& config, std::uint32_t seed)
      : paths_(paths),
        roads_(roads),
        cost_(cost),
        config_(config),
        seed_(seed),
        weights_(order_weights(config, paths.front().extruder)),
        entry_cost_(paths.size()) {
    mm_of_mm3_ = config.travel_speed_mm_s / weights_.s_mm3;
  }

  /// visits: a first tour through the paths as they are.
  void run(const std::vector<Visit>& visits) {
    begun_.clear();
    for (std::size_t k = 0; k < paths_.size(); ++k) begun_.push_back(begun(paths_[k], roads_, k, visits[k].entry));
    start_layer();
    for (const Turn& turn : turns_of(paths_)) {
      const std::uint64_t before = standing_;
      build_walls(turn);
      take(turn, before);
    }
  }

  /// What each path makes idle nozzles smear when it is entered there, in mm of way; empty: nothing.
  const std::vector<std::vector<double>>& entry_costs() const { return entry_cost_; }

  /// What a tour through the paths in their present order is predicted to spoil, in mm of way.
  double predicted_cost(const std::vector<Visit>& visits) {
    begun_.clear();
    for (std::size_t k = 0; k < paths_.size(); ++k) begun_.push_back(begun(paths_[k], roads_, k, visits[k].entry));
    start_layer();
    laid_ = LaidWalls(begun_);
    double sum = 0;
    for (const Turn& turn : turns_of(paths_)) {
      std::uint64_t walls = standing_;
      build_walls(turn);
      for (std::size_t k = turn.first; k < turn.last; ++k) {
        if (k == turn.part) walls = standing_;
        sum += visits[k].travel_cost + mm_of_mm3_ * print(k, visits[k].travel_way_mm, walls);
      }
    }
    return sum;
  }

 private:
  /// The others have been idle since the layer below; what hangs on them is a guess until they cross a wall.
  void start_layer() {
    double first_s = 0;
    const Turn turn = turns_of(paths_).front();
    for (std::size_t k = turn.first; k < turn.last; ++k) first_s += seconds_of(begun_[k]);
    states_.clear();
    for (const auto& n : cost_.nozzles())
      states_.push_back({n.extruder, n.offset_mm, {model_.left(first_s), 0.1 * model_.volume_mm3}});
    standing_ = 0;
    walls_ = 0;
  }

  void build_walls(const Turn& turn) {
    for (std::size_t k = turn.first; k < turn.part; ++k)
      if (paths_[k].road().role == Role::rampart) standing_ |= std::uint64_t(1) << std::min(walls_++, 63);
  }

  Vec2 offset_mm(int extruder) const {
    const auto is_it = [&](const HangingNozzle& n) { return n.extruder == extruder; };
    return std::ranges::find_if(states_, is_it)->offset_mm;
  }

  /// Prints path k as it is begun: what it smears and lacks, mm3.
  double print(std::size_t k, double way_mm, std::uint64_t walls) {
    const Path& path = begun_[k];
    const Vec2 own = offset_mm(path.extruder);
    const double hop_left = model_.left(weights_.hop.seconds(way_mm));
    double sum = 0;
    if (begins_outer_wall(path))
      sum += weights_.hole_weight * model_.volume_mm3 * (1 - hop_left) *
             visibility_ahead(path, 0, path.start(), cost_.map());
    for (HangingNozzle& n : states_) {
      if (n.extruder == path.extruder) {
        n.state = {};
        continue;
      }
      n.state.carried_mm3 += model_.volume_mm3 * n.state.left * (1 - hop_left);
      n.state.left *= hop_left;
      const TouchTrack track(path, n.offset_mm - own, n.extruder, cost_.map(), walls, {&laid_, int(k), laid_weight});
      sum += track.forwards(model_).apply(n.state, model_);
    }
    return sum;
  }

  void take(const Turn& turn, std::uint64_t before) {
    const int extruder = paths_[turn.first].extruder;
    const Vec2 own = offset_mm(extruder);
    ExposureRun run{.walls = std::span(begun_).subspan(turn.first, turn.part - turn.first),
                    .paths = std::span(begun_).subspan(turn.part, turn.last - turn.part),
                    .standing = before,
                    .own_walls = standing_,
                    .hanging = {},
                    .from_mm = begun_[turn.first].start(),
                    .external_first = config_.external_perimeters_first,
                    .detours = {},
                    .island_row = {},
                    .seed = seed_,
                    .steps_a_path = steps_a_path(config_.effort)};
    for (const HangingNozzle& n : states_)
      if (n.extruder != extruder) run.hanging.push_back({n.extruder, n.offset_mm - own, n.state});
    find_detours(turn, run);
    const ExposureOrder best = exposure_order(run, cost_.map(), model_, weights_);
    permute(turn, best.order);
    laid_ = LaidWalls(paths_);
    for (std::size_t k = 0; k < best.order.size(); ++k) judge_entries(turn.part + k, run.hanging, best.at_start[k]);
    std::size_t k = 0;
    for (HangingNozzle& n : states_) n.state = n.extruder == extruder ? IdleState{} : best.after[k++].state;
  }

  /// From the first entry of each island to that of each other one.
  void find_detours(const Turn& turn, ExposureRun& run) const {
    constexpr std::size_t most_islands = 24;
    std::map<int, int> row_of;
    std::vector<std::uint32_t> nodes;
    for (std::size_t k = turn.part; k < turn.last; ++k) {
      const auto [found, added] = row_of.try_emplace(paths_[k].island, int(nodes.size()));
      if (added) nodes.push_back(roads_.entries[k].front().node);
      run.island_row.push_back(found->second);
    }
    if (nodes.size() < 2 || nodes.size() > most_islands) return;
    for (const std::uint32_t from : nodes) {
      std::vector<ExposureRun::Detour>& row = run.detours.emplace_back();
      const std::vector<WayLength> found = ways(roads_, cost_, paths_[turn.first].extruder, from, nodes);
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const double straight = distance(roads_.nodes_mm[from], roads_.nodes_mm[nodes[i]]);
        row.push_back({.factor = straight > 0 ? std::max(1., found[i].way_mm / straight) : 1.,
                       .extra_s = (found[i].cost - found[i].way_mm) / config_.travel_speed_mm_s});
      }
    }
  }

  void permute(const Turn& turn, const std::vector<int>& order) {
    std::vector<Path> paths;
    std::vector<std::vector<Entry>> entries;
    for (const int i : order) {
      paths.push_back(std::move(paths_[turn.part + std::size_t(i)]));
      entries.push_back(std::move(roads_.entries[turn.part + std::size_t(i)]));
    }
    for (std::size_t k = 0; k < paths.size(); ++k) {
      paths_[turn.part + k] = std::move(paths[k]);
      roads_.entries[turn.part + k] = std::move(entries[k]);
    }
  }

  void judge_entries(std::size_t k, const std::vector<HangingNozzle>& hanging, const std::vector<IdleState>& states) {
    constexpr double left_over = 0.1;  // of what still hangs on a tip is taken to be smeared later
    const Path& path = paths_[k];
    const std::vector<Entry>& entries = roads_.entries[k];
    // Where a loop begins changes little but what stands when idle nozzles come over it.
    const double share = path.closed ? 0.1 : 1.;
    const LaidSoFar laid{&laid_, int(k), laid_weight / share};
    entry_cost_[k].assign(entries.size(), 0);
    for (std::size_t h = 0; h < states.size(); ++h) {
      const TouchTrack track(path, hanging[h].offset_mm, hanging[h].extruder, cost_.map(), standing_, laid);
      for (std::size_t e = 0; e < entries.size(); ++e) {
        IdleState state = states[h];
        const double from_s = path.closed ? track.seconds_at(path, entries[e].segment, entries[e].at_mm) : 0;
        const Touches touches = !path.closed && e == 1 ? track.backwards(model_) : track.forwards(model_, from_s);
        const double smeared = touches.apply(state, model_);
        entry_cost_[k][e] += share * mm_of_mm3_ * (smeared + left_over * state.carried_mm3);
      }
    }
  }

  std::span<Path> paths_;
  Roadmap& roads_;
  const TravelCost& cost_;
  const Config& config_;
  std::uint32_t seed_;
  OozeModel model_;
  OrderWeights weights_;
  double mm_of_mm3_ = 0;
  std::vector<Path> begun_;
  std::vector<HangingNozzle> states_;  // of all nozzles; offsets are the carriage's
  std::uint64_t standing_ = 0;         // walls of the layer so far
  int walls_ = 0;
  LaidWalls laid_;  // of paths_ or begun_
  std::vector<std::vector<double>> entry_cost_;
};

}  // namespace

OrderWeights order_weights(const Config& c, int extruder) {
  return {.hole_weight = c.weight_hole_volume, .s_mm3 = c.weight_time, .hop = hop_time(c, extruder)};
}

std::vector<Visit> cleaner_tour(std::span<Path> paths, Roadmap& roads, const TravelCost& cost, const Config& config,
                                std::uint32_t seed, std::vector<Visit> visits, TourOptions& options) {
  Reorder reorder(paths, roads, cost, config, seed);
  const double plain_cost = reorder.predicted_cost(visits);
  const std::vector<Path> plain(paths.begin(), paths.end());
  const std::vector<std::vector<Entry>> plain_entries = roads.entries;
  reorder.run(visits);
  TourOptions minding = options;
  minding.entry_cost = [before = options.entry_cost, own = reorder.entry_costs()](std::size_t k, std::uint32_t e) {
    return (before ? before(k, e) : 0) + (e < own[k].size() ? own[k][e] : 0);
  };
  std::vector<Visit> better = tour(roads, paths, cost, minding);
  if (reorder.predicted_cost(better) <= plain_cost) {
    options = std::move(minding);
    return better;
  }
  std::ranges::copy(plain, paths.begin());
  roads.entries = plain_entries;
  return visits;
}

}  // namespace cleancolor
