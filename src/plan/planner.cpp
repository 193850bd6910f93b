#include "plan/planner.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <span>

#include "plan/clear_way.hpp"
#include "plan/exposure_order.hpp"
#include "plan/joined_loops.hpp"
#include "plan/refill.hpp"
#include "plan/tour.hpp"
#include "shield/start.hpp"

namespace cleancolor {

/// Paths that are planned together.
struct PlannedLayer::Run {
  TravelCost cost;
  Roadmap roads;
  double longest_mm = 0;  // of ways around another colour
};

namespace {

// Mm of way for each mm of an unwiped nozzle over the part: only where both ends expose it.
constexpr double exposure_weight = 1e5;
constexpr double unlimited_mm = 1e12;
constexpr double longest_in_extents = 4;  // of ways around another colour

TravelWeights travel_weights(const Config& c) {
  return {.crossing = c.weight_crossing,
          .foreign = c.weight_foreign,
          .own = c.weight_own,
          .hidden = c.weight_hidden,
          .seam = c.weight_seam,
          .smear = c.weight_smear,
          .hole = c.weight_hole};
}

/// The largest of the part's layer.
double extent_mm(const LayerScene& part) {
  const Box<Vec2> box = bounds_mm(part.outline);
  return box.empty() ? 1 : std::max({1., box.size().x, box.size().y});
}

TravelCost travel_cost(const LayerMap& map, std::vector<TravelCost::Nozzle> nozzles, const Config& config,
                       const LayerScene& part) {
  if (config.planner != Planner::paper) return TravelCost(map, std::move(nozzles), travel_weights(config));
  return TravelCost::of_paper(map, std::move(nozzles), {.extent_mm = extent_mm(part)});
}

OrderWeights order_weights(const Config& c, int extruder) {
  return {.hole_weight = c.weight_hole_volume, .s_mm3 = c.weight_time, .hop = hop_time(c, extruder)};
}

int steps_a_path(Effort effort) {
  return effort == Effort::fast ? 8 : effort == Effort::normal ? 30 : 200;
}

/// Open walls are walked from the end from which idle nozzles are wiped first.
std::function<double(std::size_t, std::uint32_t)> wall_cost(std::span<const Path> paths, const TravelCost& cost,
                                                            const Polygons& part) {
  std::vector<std::array<double, 2>> of_path(paths.size());
  WallScene scene{.idle_mm = {}, .part = part, .standing = {}};
  for (std::size_t k = 0; k < paths.size(); ++k) {
    if (paths[k].road().role != Role::rampart) continue;
    if (!paths[k].closed) {
      Vec2 own;
      for (const auto& n : cost.nozzles())
        if (n.extruder == paths[k].extruder) own = n.offset_mm;
      scene.idle_mm.clear();
      for (const auto& n : cost.nozzles())
        if (n.extruder != paths[k].extruder) scene.idle_mm.push_back(n.offset_mm - own);
      for (const bool backwards : {false, true})
        of_path[k][backwards] = exposure_weight * exposure_mm(paths[k], scene, backwards);
    }
    scene.standing.push_back(paths[k]);
  }
  return [of_path](std::size_t path, std::uint32_t entry) { return entry < 2 ? of_path[path][entry] : 0; };
}

}  // namespace

PlannedLayer::PlannedLayer(Layer layer, OrderState& state, const Config& config, const PlanScene& scene,
                           const SurfaceVisibility& visibility)
    : layer_(std::move(layer)), config_(&config) {
  order(layer_, state, config, scene.site);
  if (layer_.paths.empty()) return;
  std::vector<Path> walls;
  for (const Path& path : layer_.paths)
    if (path.road().role == Role::rampart) walls.push_back(path);
  map_ = std::make_unique<LayerMap>(scene.part, walls, visibility);
  // Nozzles that leave the print while they idle are planned for one after the other.
  const std::vector<Path> paths = std::move(layer_.paths);
  layer_.paths.clear();
  for (std::size_t first = 0, last = 0; first < paths.size(); first = last) {
    std::vector<int> nozzles = scene.hanging;
    if (nozzles.empty()) {
      while (last < paths.size() && paths[last].extruder == paths[first].extruder) ++last;
      nozzles = {paths[first].extruder};
    } else {
      last = paths.size();
    }
    const auto at = [&](std::size_t k) { return paths.begin() + std::ptrdiff_t(k); };
    std::ranges::move(planned({at(first), at(last)}, nozzles, scene), std::back_inserter(layer_.paths));
  }
}

PlannedLayer::~PlannedLayer() = default;
PlannedLayer::PlannedLayer(PlannedLayer&&) noexcept = default;
PlannedLayer& PlannedLayer::operator=(PlannedLayer&&) noexcept = default;

namespace {

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

  /// What a path makes idle nozzles smear when it is entered there, in mm of way.
  double entry_cost(std::size_t path, std::uint32_t entry) const {
    return entry < entry_cost_[path].size() ? entry_cost_[path][entry] : 0;
  }

  /// What a tour through the paths in their present order is predicted to spoil, in mm of way.
  double predicted_cost(const std::vector<Visit>& visits) {
    begun_.clear();
    for (std::size_t k = 0; k < paths_.size(); ++k) begun_.push_back(begun(paths_[k], roads_, k, visits[k].entry));
    start_layer();
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
      const TouchTrack track(path, n.offset_mm - own, n.extruder, cost_.map(), walls);
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
    entry_cost_[k].assign(entries.size(), 0);
    for (std::size_t h = 0; h < states.size(); ++h) {
      const TouchTrack track(path, hanging[h].offset_mm, hanging[h].extruder, cost_.map(), standing_);
      for (std::size_t e = 0; e < entries.size(); ++e) {
        IdleState state = states[h];
        const double from_s = path.closed ? track.seconds_at(path, entries[e].segment, entries[e].at_mm) : 0;
        const Touches touches = !path.closed && e == 1 ? track.backwards(model_) : track.forwards(model_, from_s);
        const double smeared = touches.apply(state, model_);
        entry_cost_[k][e] += (path.closed ? 0.1 : 1.) * mm_of_mm3_ * (smeared + left_over * state.carried_mm3);
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
  std::vector<std::vector<double>> entry_cost_;
};

/// Where its nozzle stops: closed paths leave a gap (seam_gap_distance).
Vec2 stop_mm(const Path& path, const Config& config) {
  if (!path.closed) return path.end();
  const double nozzle_mm = config.extruders[std::size_t(path.extruder)].nozzle_diameter_mm;
  double rest = std::min(config.seam_gap_distance.of(nozzle_mm), length_mm(path) / 4);
  Vec2 at = path.start();
  for (std::size_t i = path.points.size(); i-- > 0 && rest > 0;) {
    const double length = distance(at, path.points[i]);
    at = length > rest ? lerp(at, path.points[i], rest / length) : path.points[i];
    rest -= length;
  }
  return at;
}

}  // namespace

void PlannedLayer::find_clear_ways(std::vector<Path>& paths, const Run& run) const {
  const auto offset = [&](const Path& path) { return config_->extruders[std::size_t(path.extruder)].nozzle_offset_mm; };
  for (std::size_t k = 1; k < paths.size(); ++k) {
    Path& path = paths[k];
    std::vector<Vec2> way{stop_mm(paths[k - 1], *config_) - offset(paths[k - 1])};
    for (const Vec2 p : path.travel) way.push_back(p - offset(path));
    way.push_back(path.start() - offset(path));
    if (!crosses(run.cost, way)) continue;
    path.travel = clearest_way_between(run.roads, run.cost, path.extruder, way.front(), way.back(), run.longest_mm);
    for (Vec2& p : path.travel) p = p + offset(path);
  }
}

std::vector<Path> PlannedLayer::planned(std::vector<Path> paths, const std::vector<int>& nozzles,
                                        const PlanScene& scene) {
  std::vector<TravelCost::Nozzle> hanging;
  for (const int e : nozzles) {
    Polygons reach = e < int(scene.reach.size()) ? scene.reach[std::size_t(e)] : Polygons{};
    hanging.push_back({e, config_->extruders[std::size_t(e)].nozzle_offset_mm, std::move(reach)});
  }
  const bool hidden_seams = config_->seam_position == SeamPosition::hidden;
  const bool is_paper = config_->planner == Planner::paper;
  const bool joins = config_->join_perimeters && !config_->external_perimeters_first && !is_paper;
  if (joins) paths = with_inner_loops(std::move(paths), hidden_seams);
  Run run{.cost = travel_cost(*map_, std::move(hanging), *config_, scene.part),
          .roads = {},
          .longest_mm = longest_in_extents * extent_mm(scene.part)};
  run.roads = roadmap(paths, run.cost, {.fixed_seams = !hidden_seams, .leads = joins});
  const auto walls = wall_cost(paths, run.cost, scene.site.part);
  TourOptions options{.from_mm = {}, .entry_cost = walls};
  if (is_paper) options.slack_mm = unlimited_mm;
  std::vector<Visit> visits = tour(run.roads, paths, run.cost, options);
  if (config_->print_order == PrintOrder::exposure && !is_paper) {
    Reorder reorder(paths, run.roads, run.cost, *config_, std::uint32_t(layer_.index));
    const double plain_cost = reorder.predicted_cost(visits);
    const std::vector<Path> plain = paths;
    const std::vector<std::vector<Entry>> plain_entries = run.roads.entries;
    reorder.run(visits);
    const auto entry_cost = [&](std::size_t path, std::uint32_t entry) {
      return walls(path, entry) + reorder.entry_cost(path, entry);
    };
    std::vector<Visit> better = tour(run.roads, paths, run.cost, {.from_mm = {}, .entry_cost = entry_cost});
    if (reorder.predicted_cost(better) <= plain_cost) {
      visits = std::move(better);
    } else {
      std::ranges::copy(plain, paths.begin());
      run.roads.entries = plain_entries;
    }
  }
  for (std::size_t k = 0; k < paths.size(); ++k) {
    const Entry& entry = run.roads.entries[k][visits[k].entry];
    paths[k] = led_inside(joined(begun(std::move(paths[k]), run.roads, k, visits[k].entry)), entry.lead_mm);
    // The carriage is where nozzle 0 is; the path's own nozzle is beside it.
    paths[k].travel.clear();
    for (const Vec2 c : visits[k].travel_mm)
      paths[k].travel.push_back(c + config_->extruders[std::size_t(paths[k].extruder)].nozzle_offset_mm);
  }
  if (!is_paper) find_clear_ways(paths, run);
  if (config_->refill_mode != RefillMode::off && layer_.index > 0) {
    const OrderWeights weights = order_weights(*config_, paths.front().extruder);
    const double mm_of_mm3 = config_->travel_speed_mm_s / weights.s_mm3;
    paths = with_refills(std::move(paths), run.roads, run.cost, {},
                         {.hole_mm = weights.hole_weight * mm_of_mm3, .hop = weights.hop});
  }
  if (!first_) first_ = std::make_unique<Run>(std::move(run));
  return paths;
}

void PlannedLayer::arrive_from(const Layer& below) {
  if (!first_ || below.paths.empty()) return;
  const auto offset = [&](const Path& path) { return config_->extruders[std::size_t(path.extruder)].nozzle_offset_mm; };
  Path& path = layer_.paths.front();
  const Vec2 from = stop_mm(below.paths.back(), *config_) - offset(below.paths.back());
  const Vec2 to = path.start() - offset(path);
  path.travel = config_->planner == Planner::paper
                    ? way_between(first_->roads, first_->cost, path.extruder, from, to).between_mm
                    : clearest_way_between(first_->roads, first_->cost, path.extruder, from, to, first_->longest_mm);
  for (Vec2& p : path.travel) p = p + offset(path);
}

Layer PlannedLayer::release() && {
  map_.reset();
  first_.reset();
  return std::move(layer_);
}

}  // namespace cleancolor
