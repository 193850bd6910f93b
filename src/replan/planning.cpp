#include "replan/planning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <span>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "model/ini.hpp"
#include "model/reach.hpp"
#include "model/text_scan.hpp"
#include "plan/planner.hpp"
#include "protection.hpp"
#include "replan/change_places.hpp"
#include "replan/columns.hpp"
#include "replan/cura.hpp"
#include "replan/file_parts.hpp"
#include "replan/leads.hpp"
#include "replan/staged_layer.hpp"
#include "replan/storeys.hpp"
#include "replan/walled_layers.hpp"

namespace cleancolor {
namespace {

bool is_support(Role role) {
  return role == Role::support || role == Role::support_interface;
}

/// The extruders that print part or supports in each layer, ascending.
std::vector<std::vector<int>> extruders_by_layer(const Scene& scene) {
  std::vector<std::vector<int>> result;
  for (const Layer& layer : scene.layers) {
    std::set<int> here;
    for (const Path& path : layer.paths)
      if (const Role role = path.road().role; !is_auxiliary(role) || is_support(role)) here.insert(path.extruder);
    result.emplace_back(here.begin(), here.end());
  }
  return result;
}

/// Of the storeys, by part or supports.
Use use_of(const Scene& scene, const std::vector<std::vector<int>>& extruders) {
  Use use(scene.storeys.part);
  for (std::size_t k = 0; k < extruders.size(); ++k)
    for (const int e : extruders[k]) {
      if (use.last_layer.size() <= std::size_t(e)) use.last_layer.resize(std::size_t(e) + 1);
      std::optional<int>& last = use.last_layer[std::size_t(e)];
      if (!last) use.extruders.push_back(e);
      last = std::max(last.value_or(0), int(scene.storeys.of_layer[k]));
    }
  std::ranges::sort(use.extruders);
  return use;
}

/// As the writer would print it: never faster than the filament allows.
void limit_speeds(std::vector<Path>& paths, const Config& config) {
  for (Path& path : paths) {
    const Extruder& e = config.extruders[std::size_t(path.extruder)];
    for (Stretch& s : path.stretches)
      for (const double limit : {config.max_volumetric_speed_mm3_s, e.filament_max_volumetric_speed_mm3_s})
        if (limit > 0)
          s.road.speed_mm_s = std::min(s.road.speed_mm_s, limit / (s.road.area_mm2 * e.extrusion_multiplier));
  }
}

/// No wall brings a change of tools of its own.
void by_tools_of(const RecoveredLayer& layer, std::vector<Path>& walls) {
  for (Path& wall : walls)
    if (std::ranges::find(layer.runs, wall.extruder, &RecoveredRun::tool) == layer.runs.end())
      wall.extruder = layer.runs.front().tool;
}

constexpr double beside_skirt_mm = 0.3;  // between two roads

bool meets(const Path& path, const Polygons& skirt) {
  if (skirt.empty()) return false;
  const double apart_mm = path.road().width_mm / 2 + beside_skirt_mm;
  for (std::size_t i = 0; i < path.segments(); ++i) {
    const Vec2 a = path.points[i], b = path.points[(i + 1) % path.points.size()];
    const int steps = 1 + int(distance(a, b) / path.road().width_mm);
    for (int s = 0; s <= steps; ++s)
      if (border_distance_mm(skirt, lerp(a, b, double(s) / steps)) < apart_mm) return true;
  }
  return false;
}

/// Whether a wall would stand on a skirt.
bool meets_skirts(const Scene& scene, const PrintedRampart& rampart) {
  for (std::size_t k = 0; k < scene.skirts.size(); ++k) {
    if (scene.skirts[k].empty() || !scene.storeys.is_storey[k]) continue;
    const Polygons skirt = scene.skirts[k];
    for (const Path& wall : rampart.paths(int(scene.storeys.of_layer[k])))
      if (wall.road().role == Role::rampart && meets(wall, skirt)) return true;
  }
  return false;
}

/// Between storeys it has none.
Layer with_walls(Layer layer, const Scene& scene, const PrintedRampart& rampart, const RecoveredPrint& recovered,
                 const Config& config) {
  const auto k = std::size_t(layer.index);
  if (!scene.storeys.is_storey[k]) return layer;
  std::vector<Path> paths = rampart.paths(int(scene.storeys.of_layer[k]));
  const Polygons skirt = scene.skirts[k];
  std::erase_if(paths, [&](const Path& loop) { return loop.road().role != Role::rampart && meets(loop, skirt); });
  if (recovered.keeps_tools) by_tools_of(recovered.layers[k], paths);
  limit_speeds(paths, config);
  std::ranges::move(layer.paths, std::back_inserter(paths));
  layer.paths = std::move(paths);
  return layer;
}

/// Where each nozzle can go; empty where the print itself lies beyond what the configuration says of the bed.
std::vector<Polygons> reaches(const Scene& scene, const Config& config) {
  std::vector<Polygons> result;
  for (int e = 0; e < int(config.extruders.size()); ++e) {
    result.push_back(reach(config, e));
    for (const Layer& layer : scene.layers)
      for (const Path& path : layer.paths)
        if (path.extruder == e && !within(path, result.back())) return {};
  }
  return result;
}

/// A loop begun at the nearest place to one.
Path begun_beside(Path loop, Vec2 p) {
  const std::size_t count = loop.points.size();
  std::size_t segment = 0;
  Vec2 on = loop.start();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 q = nearest_on_segment(loop.points[i], loop.points[(i + 1) % count], p);
    if (distance(q, p) < distance(on, p)) segment = i, on = q;
  }
  for (const std::size_t i : {segment, (segment + 1) % count})
    if (on == loop.points[i]) return started_at(std::move(loop), i);
  return started_on(std::move(loop), segment, on);
}

/// The loops that the planner joined as they are in the file, with a stroke between them.
Layer with_loops_apart(Layer layer, const RecoveredLayer& source, const GcodePrint& print, const AuditMachine& machine,
                       const LeadOptions& leads) {
  std::vector<Path> paths;
  for (Path& path : layer.paths) {
    if (path.inner_source < 0) {
      paths.push_back(std::move(path));
      continue;
    }
    const Vec2 start = path.points[path.outer_from];
    const auto loop = [&](int index, int depth) {
      Path own = path_of(source.runs[std::size_t(index)], index, source.height_mm, print, machine);
      own.island = path.island;
      own.depth = depth;
      return own;
    };
    Path whole = loop(path.inner_source, path.depth);
    const RecoveredRun& run = source.runs[std::size_t(path.inner_source)];
    const double gap_mm =
        distance(place_mm(run.from, run.tool, machine), place_mm(run.roads.back().to, run.tool, machine));
    Path inner = begun_beside(std::move(whole), start), outer = begun_beside(loop(path.source, 0), start);
    inner.travel = std::move(path.travel);
    outer.inner_source = path.inner_source;
    std::optional<Path> stroke = stroke_between(inner, gap_mm, outer, leads);
    paths.push_back(std::move(inner));
    if (stroke) paths.push_back(std::move(*stroke));
    paths.push_back(std::move(outer));
  }
  layer.paths = std::move(paths);
  return layer;
}

/// So far that each has its own rampart.
double columns_apart_mm(const Config& config) {
  const bool split = config.rampart_walls == RampartWalls::split && config.extruders.size() == 2;
  const double walls = split ? 1 : double(config.extruders.size());
  return 2 * (config.ooze_shield_dist_mm + (walls - 1) * config.rampart_gap_mm +
              config.extruders.front().nozzle_diameter_mm);
}

class Planning {
 public:
  Planning(const Scene& scene, const RecoveredPrint& recovered, const GcodePrint& print, const AuditMachine& machine,
           Config config, const ReplanOptions& options, const Progress& progress)
      : scene_(scene),
        recovered_(recovered),
        print_(print),
        machine_(machine),
        config_(std::move(config)),
        options_(options),
        progress_(progress),
        extruders_(extruders_by_layer(scene)),
        use_(use_of(scene, extruders_)),
        reach_(options.knows_bed ? reaches(scene, config_) : std::vector<Polygons>{}) {
    if (use_.extruders.size() < 2)
      throw Error(fmt::format("{}: one nozzle prints it all; there is nothing to keep apart", print.name));
    choose_what_is_walled();
    make_rampart();
  }

  ReplannedLayers result() && {
    if (options_.visibility == nullptr) return {in_plain_order(), !rampart_->empty(), stands_apart_};
    return {in_clean_order(), !rampart_->empty(), stands_apart_};
  }

 private:
  void choose_what_is_walled() {
    const double apart_mm = columns_apart_mm(config_);
    around_ = without_columns_beside(scene_.storeys.around, scene_.storeys.part, apart_mm);
    stands_apart_ = columns(around_, apart_mm).size() > 1;
    if (options_.rampart == RampartExtent::all) return;
    std::optional<Slices> column;
    if (options_.rampart == RampartExtent::column) column = shortest_column(around_, apart_mm);
    if (column)
      around_ = std::move(*column);
    else
      config_.rampart = RampartShape::off;
  }

  void make_rampart() {
    try {
      rampart_.emplace(around_, use_, config_, options_.threads);
      if (!meets_skirts(scene_, *rampart_)) return;
      around_ = around_skirts(scene_);
      rampart_.emplace(around_, use_, config_, options_.threads);
    } catch (const Error& fault) {
      std::string what = fault.what();
      if (what.ends_with(room_advice)) what.resize(what.size() - room_advice.size());
      if (options_.knows_bed && reach_.empty())
        what =
            "the print itself lies beyond the bed: look at the printer (--printer), and at the offsets of its nozzles "
            "(--nozzle-offset, --offsets-in)";
      progress_.warn(fmt::format("{}: {}; it is re-planned without a rampart", print_.name, what));
      config_.rampart = RampartShape::off;
      rampart_.emplace(around_, use_, config_, options_.threads);
    }
  }

  /// What slicers do without colour protection, to compare.
  std::vector<Layer> in_plain_order() const {
    OrderState state{.extruder = recovered_.layers.front().runs.front().tool, .at = {}, .seams = {}};
    std::vector<Layer> layers = scene_.layers;
    for (Layer& layer : layers) {
      const std::vector<Stop>& stops = scene_.stops[std::size_t(layer.index)];
      std::vector<Layer> parts = parts_of(with_walls(std::move(layer), scene_, *rampart_, recovered_, config_), stops);
      layer = parts.front();
      layer.paths.clear();
      for (Layer& part : parts) {
        if (scene_.has_shield || !stops.empty()) state.extruder = part.paths.front().extruder;
        order(part, state, config_, rampart_->site(storey_of(layer.index)));
        std::ranges::move(part.paths, std::back_inserter(layer.paths));
      }
    }
    return layers;
  }

  std::vector<Layer> in_clean_order() {
    first_of_layer_ = first_extruders(extruders_, recovered_.layers.front().runs.front().tool);
    if (scene_.has_shield || recovered_.keeps_tools)
      for (std::size_t k = 0; k < first_of_layer_.size(); ++k)
        first_of_layer_[k] = recovered_.layers[k].runs.front().tool;
    for (int e = 0; e < int(config_.extruders.size()); ++e) leads_.hop.push_back(hop_time(config_, e));
    walled_ = walled_layers(scene_.layers, leads_.ooze);
    const int count = int(scene_.layers.size());
    planned_.resize(std::size_t(count));
    run({.count = count,
         .window = 3 * options_.threads + 4,
         .stages = {{0, [&](int k) { plan(k); }}},
         .consume =
             [&](int k) {
               take(k);
               progress_.advance("planning", double(k + 1) / count);
             }},
        options_.threads);
    return std::move(result_);
  }

  int storey_of(int layer) const { return int(scene_.storeys.of_layer[std::size_t(layer)]); }

  void plan(int k) {
    const PackedPolygons& outline = scene_.storeys.part.outlines[std::size_t(storey_of(k))];
    Layer layer = scene_.layers[std::size_t(k)];
    if (k < walled_) layer = with_walls(std::move(layer), scene_, *rampart_, recovered_, config_);
    PlanScene own = plan_scene(scene_.storeys.part, use_, config_, *rampart_, storey_of(k));
    own.reach = reach_;
    if (k >= walled_) own.site = {};
    if (!own.site.part.empty()) own.site.part = outline;
    if (scene_.has_shield) own.site = {use_.hot(storey_of(k), config_), outline};
    planned_[std::size_t(k)].emplace(std::move(layer), first_of_layer_[std::size_t(k)], scene_.stops[std::size_t(k)],
                                     config_, own, *options_.visibility);
  }

  void take(int k) {
    if (progress_.interrupted()) throw Error("interrupted");
    std::optional<StagedLayer>& own = planned_[std::size_t(k)];
    if (!own->arrive_from(below_))
      throw Error(
          fmt::format("{}: layer {}: tools do not change in the order that is planned; such files are not "
                      "re-planned yet",
                      print_.name, k + 1));
    Path last = own->last();
    Layer layer =
        with_loops_apart(std::move(*own).release(), recovered_.layers[std::size_t(k)], print_, machine_, leads_);
    own.reset();
    const Path* before = below_.points.empty() ? nullptr : &below_;
    const std::vector<Polygons> regions = regions_of(storey_of(k));
    layer = with_leads(std::move(layer), regions, before, leads_);
    if (config_.idle_nozzle != IdleNozzle::same_height && scene_.stops[std::size_t(k)].empty())
      layer = with_change_places(std::move(layer), regions, regions_of(storey_of(k) - 1), before);
    result_.push_back(std::move(layer));
    below_ = std::move(last);
  }

  /// None below the first storey.
  std::vector<Polygons> regions_of(int storey) const {
    if (storey < 0) return {};
    return unpacked(scene_.storeys.part.regions[std::size_t(storey)]);
  }

  const Scene& scene_;
  const RecoveredPrint& recovered_;
  const GcodePrint& print_;
  const AuditMachine& machine_;
  Config config_;
  const ReplanOptions& options_;
  const Progress& progress_;
  std::vector<std::vector<int>> extruders_;  // of each layer
  Use use_;
  std::vector<Polygons> reach_;  // of each extruder; empty: it is not known, or the print lies beyond it
  Slices around_;                // what is walled
  bool stands_apart_ = false;
  std::optional<PrintedRampart> rampart_;

  std::vector<int> first_of_layer_;  // extruders
  LeadOptions leads_;
  int walled_ = 0;  // layers
  std::vector<std::optional<StagedLayer>> planned_;
  std::vector<Layer> result_;
  Path below_;  // printed last, in the layer before
};

}  // namespace

ReplannedLayers planned_layers(const Scene& scene, const RecoveredPrint& recovered, const GcodePrint& print,
                               const AuditMachine& machine, const Config& config, const ReplanOptions& options,
                               const Progress& progress) {
  return Planning(scene, recovered, print, machine, config, options, progress).result();
}

}  // namespace cleancolor
