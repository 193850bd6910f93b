#include "plan/planner.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <span>

#include "plan/cleaner_tour.hpp"
#include "plan/clear_way.hpp"
#include "plan/joined_loops.hpp"
#include "plan/precedence.hpp"
#include "plan/refill.hpp"
#include "plan/tour.hpp"
#include "plan/wipe.hpp"
#include "shield/start.hpp"

namespace cleancolor {

/// Paths that are planned together.
struct PlannedLayer::Run {
  TravelCost cost;
  Roadmap roads;
  double longest_mm = 0;  // of ways around another colour

  /// Where no wall of a rampart says where the layer begins: what each start costs, and the first paths as they were
  /// before they were begun, up to where the tours from all starts have become the planned one.
  CostToGo to_go = {};
  std::vector<Path> begin = {};
  std::vector<std::uint32_t> entries = {};  // of `begin`, as planned

  void keep_starts(std::span<const Path> paths, std::span<const Visit> visits, TourOptions options);
};

namespace {

// Mm of way for each mm of an unwiped nozzle over the part: only where both ends expose it.
constexpr double exposure_weight = 1e5;
constexpr double unlimited_mm = 1e12;
constexpr double forbidden_mm = 1e9;
constexpr double longest_in_extents = 4;  // of ways around another colour

constexpr double start_slack_mm = 60;

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

/// Path k as it is walked; offset_mm: of its nozzle.
Path walked(Path path, const Roadmap& roads, std::size_t k, const Visit& visit, Vec2 offset_mm) {
  path = led_inside(joined(begun(std::move(path), roads, k, visit.entry)), roads.entries[k][visit.entry].lead_mm);
  // The carriage is where nozzle 0 is; the path's own nozzle is beside it.
  path.travel.clear();
  for (const Vec2 c : visit.travel_mm) path.travel.push_back(c + offset_mm);
  return path;
}

/// After how many paths the tours from all starts have become the planned one.
std::size_t paths_until_same(const CostToGo& to_go, std::span<const Visit> visits) {
  std::size_t most = 0;
  for (std::uint32_t start = 0; start < to_go.cost.size(); ++start) {
    if (!std::isfinite(to_go.cost[start])) continue;
    std::uint32_t entry = start;
    std::size_t k = 0;
    for (; k < visits.size() && entry != visits[k].entry; ++k)
      if (k < to_go.next.size()) entry = to_go.next[k][entry];
    most = std::max(most, k);
  }
  return most;
}

}  // namespace

void PlannedLayer::Run::keep_starts(std::span<const Path> paths, std::span<const Visit> visits, TourOptions options) {
  const auto is_wall = [](const Path& path) { return path.road().role == Role::rampart; };
  if (std::ranges::any_of(paths, is_wall) || roads.entries.front().size() < 2) return;
  // A start far away may yet be the nearest to where the layer below ends.
  options.slack_mm = start_slack_mm;
  to_go = cost_to_go(roads, paths, cost, options);
  const std::size_t count = std::min(paths.size(), paths_until_same(to_go, visits) + 1);
  begin.assign(paths.begin(), paths.begin() + std::ptrdiff_t(count));
  for (std::size_t k = 0; k < count; ++k) entries.push_back(visits[k].entry);
}

namespace {

/// Open walls are walked from the end from which idle nozzles are wiped first, ironing as it is given.
std::function<double(std::size_t, std::uint32_t)> wall_cost(std::span<const Path> paths, const TravelCost& cost,
                                                            const Polygons& part) {
  std::vector<std::array<double, 2>> of_path(paths.size());
  WallScene scene{.idle_mm = {}, .part = part, .standing = {}};
  for (std::size_t k = 0; k < paths.size(); ++k) {
    if (irons(paths[k])) of_path[k][1] = forbidden_mm;
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
    const Path* before = layer_.paths.empty() ? nullptr : &layer_.paths.back();
    std::vector<Path> run = planned({at(first), at(last)}, nozzles, scene, before);
    std::ranges::move(run, std::back_inserter(layer_.paths));
  }
}

PlannedLayer::~PlannedLayer() = default;
PlannedLayer::PlannedLayer(PlannedLayer&&) noexcept = default;
PlannedLayer& PlannedLayer::operator=(PlannedLayer&&) noexcept = default;

namespace {

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

Vec2 PlannedLayer::stop_mm(const Path& path) const {
  return cleancolor::stop_mm(path, *config_) - offset_mm(path);
}

void PlannedLayer::find_clear_ways(std::span<Path> paths, const Run& run, const Path* before) const {
  for (std::size_t k = before != nullptr ? 0 : 1; k < paths.size(); ++k) {
    Path& path = paths[k];
    std::vector<Vec2> way{stop_mm(k > 0 ? paths[k - 1] : *before)};
    for (const Vec2 p : path.travel) way.push_back(p - offset_mm(path));
    way.push_back(path.start() - offset_mm(path));
    if (!crosses(run.cost, way)) continue;
    path.travel = clearest_way_between(run.roads, run.cost, path.extruder, way.front(), way.back(), run.longest_mm);
    for (Vec2& p : path.travel) p = p + offset_mm(path);
  }
}

std::vector<Path> PlannedLayer::planned(std::vector<Path> paths, const std::vector<int>& nozzles,
                                        const PlanScene& scene, const Path* before) {
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
  if (before != nullptr) options.from_mm = stop_mm(*before);
  if (is_paper) options.slack_mm = unlimited_mm;
  std::vector<Visit> visits = tour(run.roads, paths, run.cost, options);
  if (config_->print_order == PrintOrder::exposure && !is_paper)
    visits =
        cleaner_tour(paths, run.roads, run.cost, *config_, std::uint32_t(layer_.index), std::move(visits), options);
  // The paper's costs depend on the direction; ways back are not looked at then.
  if (!first_ && !is_paper) run.keep_starts(paths, visits, options);
  for (std::size_t k = 0; k < paths.size(); ++k) {
    const Vec2 offset = offset_mm(paths[k]);
    paths[k] = walked(std::move(paths[k]), run.roads, k, visits[k], offset);
  }
  if (!is_paper) find_clear_ways(paths, run, before);
  if (config_->wipe_passes && !is_paper && nozzles.size() > 1) {
    WipeOptions wipes = wipe_options(*config_, paths.front().extruder);
    for (const Path& path : paths) wipes.stops_mm.push_back(stop_mm(path));
    paths = with_wipes(std::move(paths), run.roads, run.cost, {}, wipes);
  }
  if (config_->refill_mode != RefillMode::off && layer_.index >= config_->refill_skipped_layers)
    paths = with_refills(std::move(paths), run.roads, run.cost, {}, refill_options(*config_, paths.front().extruder));
  if (!first_) first_ = std::make_unique<Run>(std::move(run));
  return paths;
}

void PlannedLayer::arrive_from(const Layer& below) {
  if (!first_ || below.paths.empty()) return;
  const Vec2 from = stop_mm(below.paths.back());
  if (!first_->begin.empty()) {
    const std::size_t begun_anew =
        begin_at(cheapest_start(first_->roads, first_->begin.front(), first_->cost, first_->to_go, from));
    find_clear_ways(std::span(layer_.paths).first(begun_anew), *first_);
  }
  Path& path = layer_.paths.front();
  const Vec2 to = path.start() - offset_mm(path);
  path.travel = config_->planner == Planner::paper
                    ? way_between(first_->roads, first_->cost, path.extruder, from, to).between_mm
                    : clearest_way_between(first_->roads, first_->cost, path.extruder, from, to, first_->longest_mm);
  for (Vec2& p : path.travel) p = p + offset_mm(path);
}

std::vector<Vec2> PlannedLayer::way(int extruder, Vec2 from_mm, Vec2 to_mm) const {
  const auto hangs = [&](const TravelCost::Nozzle& n) { return n.extruder == extruder; };
  if (!first_ || std::ranges::none_of(first_->cost.nozzles(), hangs)) return {};
  const Vec2 offset = config_->extruders[std::size_t(extruder)].nozzle_offset_mm;
  std::vector<Vec2> between =
      clearest_way_between(first_->roads, first_->cost, extruder, from_mm - offset, to_mm - offset, first_->longest_mm);
  for (Vec2& p : between) p = p + offset;
  return between;
}

std::size_t PlannedLayer::begin_at(std::uint32_t entry) {
  assert(layer_.paths.size() >= first_->begin.size());  // no refill among them: there is no wall
  const Run& run = *first_;
  std::uint32_t before = 0;
  std::size_t k = 0;
  for (; k < run.begin.size() && (k > 0 || entry != run.entries[k]); ++k) {
    const Path& path = run.begin[k];
    const Visit visit =
        k == 0 ? Visit{.entry = entry, .travel_mm = {}} : visit_from(run.roads, run.begin, run.cost, k, before, entry);
    layer_.paths[k] = walked(path, run.roads, k, visit, offset_mm(path));
    // From here on it is the tour that was planned.
    if (entry == run.entries[k]) return k + 1;
    before = entry;
    if (k < run.to_go.next.size()) entry = run.to_go.next[k][entry];
  }
  return k;
}

Vec2 PlannedLayer::offset_mm(const Path& path) const {
  return config_->extruders[std::size_t(path.extruder)].nozzle_offset_mm;
}

LayerForecast PlannedLayer::forecast() const {
  if (!first_) return {};
  return layer_forecast(layer_.paths, first_->cost, {}, hop_time(*config_, layer_.paths.front().extruder));
}

Layer PlannedLayer::release() && {
  map_.reset();
  first_.reset();
  return std::move(layer_);
}

}  // namespace cleancolor
