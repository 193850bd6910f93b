#include "audit/audit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <span>
#include <tuple>

#include "audit/crossings.hpp"
#include "audit/replay.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"

namespace cleancolor {
namespace {

constexpr std::uint32_t least_moves = 512, most_moves = 4096;  // of a unit
constexpr double joined_places_mm = 5;

/// Moves that are looked at by one thread in one go.
struct Unit {
  LayerMoves::Range moves;
  std::vector<std::uint32_t> opens, closes;  // layers that no other unit before, or after, has moves of
};

std::vector<Unit> units(const GcodePrint& print) {
  std::vector<Unit> all;
  const auto count = std::uint32_t(print.moves.size());
  for (std::uint32_t first = 0, i = 1; i <= count; ++i) {
    const bool full = i - first >= most_moves;
    if (i < count && !full && (i - first < least_moves || print.moves[i].layer == print.moves[i - 1].layer)) continue;
    all.push_back({.moves = {first, i}, .opens = {}, .closes = {}});
    first = i;
  }
  std::vector<char> open(print.layers.size()), closed(print.layers.size());
  const auto visit = [&](Unit& unit, std::vector<char>& seen, std::vector<std::uint32_t>& layers) {
    for (std::uint32_t m = unit.moves.first; m < unit.moves.last; ++m) {
      const std::uint32_t layer = print.moves[m].layer;
      if (!seen[layer]) layers.push_back(layer);
      seen[layer] = 1;
    }
  };
  for (std::size_t u = 0; u < all.size(); ++u) visit(all[u], open, all[u].opens);
  for (std::size_t u = all.size(); u-- > 0;) visit(all[u], closed, all[u].closes);
  return all;
}

/// The print, layer by layer.
class Auditor {
 public:
  Auditor(const GcodePrint& print, const AuditMachine& machine, const AuditOptions& options, const Progress& progress)
      : print_(print),
        machine_(machine),
        options_(options),
        progress_(progress),
        time_(std::make_shared<Timeline>(timeline(print, machine))),
        layers_(layer_moves(print, *time_)) {}

  AuditResult result();

 private:
  LayerRoads roads(std::uint32_t layer) const {
    return layer < layers_.ranges.size() ? layer_roads(print_, machine_, *time_, layers_.ranges[layer]) : LayerRoads{};
  }
  PartLayer part_layer(std::uint32_t layer) const;
  std::shared_ptr<const LayerPlastic> plastic(std::uint32_t layer) const;
  Replay::Result replayed();

  const GcodePrint& print_;
  const AuditMachine& machine_;
  const AuditOptions& options_;
  const Progress& progress_;
  std::shared_ptr<const Timeline> time_;
  LayerMoves layers_;
  std::shared_ptr<const PrintedVisibility> visibility_;
  int cut_short_ = 0;
};

PartLayer Auditor::part_layer(std::uint32_t layer) const {
  const GcodeLayer& l = print_.layers[layer];
  PartLayer part{.bottom_mm = l.z_mm - l.height_mm, .top_mm = l.z_mm, .roads = {}};
  const LayerRoads all = roads(layer);
  for (std::size_t i = 0; i < all.roads.size(); ++i) {
    const LabelledRoad& r = all.roads[i];
    if (!is_auxiliary(r.role)) part.roads.push_back({r.a_mm, r.b_mm, r.width_mm, all.nozzles[i]});
  }
  return part;
}

std::shared_ptr<const LayerPlastic> Auditor::plastic(std::uint32_t layer) const {
  return std::make_shared<LayerPlastic>(
      layer_plastic(roads(layer), roads(layers_.above[layer]), print_.layers[layer].z_mm, options_.exposed));
}

Replay::Result Auditor::replayed() {
  std::vector<Unit> all = units(print_);
  std::vector<std::shared_ptr<const LayerPlastic>> ground(print_.layers.size());
  std::vector<Crossings> found(all.size());
  Replay replay(print_, machine_, *time_, *visibility_, options_.scenarios);

  Stream stream;
  stream.count = int(all.size());
  stream.stages.push_back({0, [&](int i) {
                             if (progress_.interrupted()) throw Error("interrupted");
                             for (const std::uint32_t l : all[std::size_t(i)].opens) ground[l] = plastic(l);
                           }});
  stream.stages.push_back({0, [&](int i) {
                             found[std::size_t(i)] = crossings({.print = print_,
                                                                .machine = machine_,
                                                                .time = *time_,
                                                                .visibility = *visibility_,
                                                                .plastic = ground,
                                                                .step_mm = options_.step_mm},
                                                               all[std::size_t(i)].moves);
                           }});
  stream.consume = [&](int i) {
    Crossings& unit = found[std::size_t(i)];
    replay.follow(unit, ground);
    cut_short_ += unit.cut_short;
    unit = {};
    for (const std::uint32_t l : all[std::size_t(i)].closes) ground[l].reset();
    progress_.advance("audit", double(i + 1) / double(all.size()));
  };
  run(stream, options_.threads);
  return replay.finish();
}

AuditResult Auditor::result() {
  visibility_ = std::make_shared<PrintedVisibility>(
      int(print_.layers.size()), [&](int layer) { return part_layer(std::uint32_t(layer)); }, options_.visibility,
      options_.threads, progress_);
  Replay::Result replay = replayed();
  AuditResult result;
  result.scenarios = std::move(replay.scenarios);
  result.nozzles = std::move(replay.nozzles);
  result.print_time_s = time_->print_time_s;
  result.travel_mm = time_->travel_mm;
  result.layers = int(print_.layers.size());
  result.tool_changes = replay.tool_changes;
  if (cut_short_ > 0) {
    result.warnings.push_back(
        "nozzles pass over so many roads in so few moves that some of them were left out: the figures are too low");
  }
  if (std::ranges::all_of(print_.moves, [](const GcodeMove& m) { return m.role == Role::unknown; })) {
    result.warnings.push_back(
        "the file does not say what is wall, infill or skirt: walls are told by the geometry, and skirts and towers "
        "count as "
        "part of the print; let the slicer write verbose G-code");
  }
  for (const std::string& warning : result.warnings) progress_.warn(fmt::format("{}: {}", print_.name, warning));
  result.time = time_;
  result.visibility = visibility_;
  return result;
}

}  // namespace

AuditResult audit(const GcodePrint& print, const AuditMachine& machine, const AuditOptions& options,
                  const Progress& progress) {
  assert(machine.nozzles.size() >= std::size_t(print.tools));
  assert(!options.scenarios.empty() && options.step_mm > 0);
  return Auditor(print, machine, options, progress).result();
}

std::vector<Defect> defects(const ScenarioResult& result) {
  std::vector<Defect> single;
  for (std::size_t i = 0; i < result.places.size(); ++i) {
    const Place& p = result.places[i];
    if (p.kind == Place::Kind::smear || p.kind == Place::Kind::hole) single.push_back({i, p.mm3, p.length_mm});
  }
  std::ranges::stable_sort(single, std::ranges::greater(), &Defect::mm3);

  // Each place joins the first worse one that is near enough; cells as large as that hold few of them.
  using Cell = std::tuple<std::uint32_t, Place::Kind, std::uint8_t, std::uint8_t, std::int64_t, std::int64_t>;
  std::map<Cell, std::vector<std::size_t>> cells;
  std::vector<Defect> joined;
  const auto to_cell = [](double mm) { return std::int64_t(std::floor(mm / joined_places_mm)); };
  for (const Defect& one : single) {
    const Place& p = result.places[one.place];
    const std::int64_t x = to_cell(p.at_mm.x), y = to_cell(p.at_mm.y);
    std::size_t home = joined.size();
    for (std::int64_t dy = -1; dy <= 1; ++dy)
      for (std::int64_t dx = -1; dx <= 1; ++dx) {
        const auto found = cells.find({p.layer, p.kind, p.nozzle, p.over, x + dx, y + dy});
        if (found == cells.end()) continue;
        for (const std::size_t j : found->second)
          if (j < home && distance(result.places[joined[j].place].at_mm, p.at_mm) < joined_places_mm) home = j;
      }
    if (home == joined.size()) {
      joined.push_back(one);
      cells[{p.layer, p.kind, p.nozzle, p.over, x, y}].push_back(home);
    } else {
      joined[home].mm3 += one.mm3;
      joined[home].length_mm += one.length_mm;
    }
  }
  std::ranges::stable_sort(joined, std::ranges::greater(), &Defect::mm3);
  return joined;
}

std::vector<Place> worst_places(const ScenarioResult& result, std::size_t count) {
  std::vector<Place> worst;
  for (const Defect& defect : defects(result)) {
    if (worst.size() == count) break;
    Place& p = worst.emplace_back(result.places[defect.place]);
    p.mm3 = defect.mm3;
    p.length_mm = defect.length_mm;
  }
  return worst;
}

}  // namespace cleancolor
