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

struct RefusedOption {
  std::string_view key;
  std::string_view reason;
};
constexpr RefusedOption refused_options[] = {
    {"spiral_vase", "vase mode is one road from bottom to top; there is nothing to put in order"},
    {"single_extruder_multi_material", "filament changes in one nozzle, so that no idle nozzle can ooze"},
    {"use_firmware_retraction", "the firmware draws filament back; switch it off in the slicer"},
    {"use_volumetric_e", "E in mm3 is not re-planned yet; switch it off in the slicer"},
    {"infill_first", "infill before perimeters is not re-planned yet; switch it off in the slicer"},
    {"wall_sequence",
     "outer walls between inner ones are not re-planned; print them from the inside out or the outside in"},
};

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
  const double least_mm = path.road().width_mm / 2 + beside_skirt_mm;
  for (std::size_t i = 0; i < path.segments(); ++i) {
    const Vec2 a = path.points[i], b = path.points[(i + 1) % path.points.size()];
    const int steps = 1 + int(distance(a, b) / path.road().width_mm);
    for (int s = 0; s <= steps; ++s)
      if (border_distance_mm(skirt, lerp(a, b, double(s) / steps)) < least_mm) return true;
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

/// What slicers do without colour protection, to compare.
std::vector<Layer> in_plain_order(const Scene& scene, const PrintedRampart& rampart, const RecoveredPrint& recovered,
                                  const Config& config) {
  OrderState state{.extruder = recovered.layers.front().runs.front().tool, .at = {}, .seams = {}};
  std::vector<Layer> layers = scene.layers;
  for (Layer& layer : layers) {
    const std::vector<Stop>& stops = scene.stops[std::size_t(layer.index)];
    std::vector<Layer> parts = parts_of(with_walls(std::move(layer), scene, rampart, recovered, config), stops);
    layer = parts.front();
    layer.paths.clear();
    for (Layer& part : parts) {
      if (scene.has_shield || !stops.empty()) state.extruder = part.paths.front().extruder;
      order(part, state, config, rampart.site(int(scene.storeys.of_layer[std::size_t(layer.index)])));
      std::ranges::move(part.paths, std::back_inserter(layer.paths));
    }
  }
  return layers;
}

}  // namespace

namespace {

/// Whether the option keeps nozzles from being lifted in some of the print's layers; 0 says nothing.
bool lifts_in_some_layers(const IniEntry& entry, const GcodePrint& print) {
  if (entry.key == "retract_lift_top") return entry.value.find("All ") == std::string::npos;
  const bool above = entry.key == "retract_lift_above", below = entry.key == "retract_lift_below";
  if (!above && !below) return false;
  for (std::string_view rest = entry.value; !rest.empty();) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const double z_mm = number<double>(trimmed(rest.substr(0, comma))).value_or(0);
    if (z_mm > 0 && (above ? z_mm > print.layers.front().z_mm : z_mm < print.layers.back().z_mm)) return true;
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return false;
}

/// The printer's, and over it what the configuration block of the file says.
Config told_config(const GcodePrint& print, const Config* printer) {
  if (print.facts.config.empty() || print.facts.config_kind.empty())
    throw Error(
        fmt::format("{}: it has no configuration block at its end; it is not known how far filament is drawn "
                    "back. Export the G-code again with it",
                    print.name));
  std::vector<IniEntry> told = print.facts.config_kind == "orcaslicer"       ? from_orca(print.facts.config)
                               : print.facts.dialect == Dialect::superslicer ? from_superslicer(print.facts.config)
                                                                             : print.facts.config;
  for (const IniEntry& entry : told)
    for (const RefusedOption& option : refused_options)
      if (entry.key == option.key && is_set(entry.value))
        throw Error(fmt::format("{}: {} = {}: {}", print.name, entry.key, entry.value, option.reason));
  for (const IniEntry& entry : told)
    if (lifts_in_some_layers(entry, print))
      throw Error(fmt::format("{}: {} = {}: lifting in some layers only is not re-planned yet; switch it off",
                              print.name, entry.key, entry.value));
  std::erase_if(told, [](const IniEntry& entry) { return entry.key == "skirt_height"; });  // -1 of Slic3r: all layers
  return with_ini(printer != nullptr ? *printer : Config{}, told, print.name).config;
}

}  // namespace

Config planning_config(const GcodePrint& print, const AuditMachine& machine, const Config* printer) {
  Config config =
      print.facts.dialect == Dialect::cura ? cura_config(print, machine, printer) : told_config(print, printer);
  const std::size_t nozzles = machine.nozzles.size();
  while (config.extruders.size() < nozzles) config.extruders.push_back(config.extruders.back());
  config.extruders.resize(nozzles);
  for (std::size_t n = 0; n < nozzles; ++n) config.extruders[n].nozzle_offset_mm = machine.nozzles[n].offset_mm;
  config.offsets_in = machine.offsets_in;
  config.idle_nozzle = machine.idle_nozzle;
  config.planner = Planner::clean;
  config.seam_position = SeamPosition::hidden;
  config.join_perimeters = true;
  config.heater_off_after_last_use = false;   // the file's own temperatures hold
  config.rampart = RampartShape::conforming;  // walls that wipe and fill, be it after a tool was parked
  config.refill_mode = RefillMode::model;
  return config;
}

ReplannedLayers planned_layers(const Scene& scene, const RecoveredPrint& recovered, const GcodePrint& print,
                               const AuditMachine& machine, Config config, const ReplanOptions& options,
                               const Progress& progress) {
  if (!options.plans) {
    std::vector<Layer> layers = scene.layers;
    for (std::size_t k = 0; k < layers.size(); ++k)
      for (std::size_t i = 0; i < layers[k].paths.size(); ++i) {
        Path& path = layers[k].paths[i];
        path.closed = false;  // begun where the file begins it
        for (const FilePoint p : recovered.layers[k].runs[i].way)
          path.travel.push_back(place_mm(p, path.extruder, machine));
      }
    return {std::move(layers)};
  }
  const std::vector<std::vector<int>> extruders = extruders_by_layer(scene);
  const Use use = use_of(scene, extruders);
  if (use.extruders.size() < 2)
    throw Error(fmt::format("{}: one nozzle prints it all; there is nothing to keep apart", print.name));
  const double apart_mm = columns_apart_mm(config);
  Slices around = without_columns_beside(scene.storeys.around, scene.storeys.part, apart_mm);
  const bool stands_apart = columns(around, apart_mm).size() > 1;
  std::optional<Slices> column;
  if (options.rampart == RampartExtent::column) column = shortest_column(around, apart_mm);
  if (column) around = std::move(*column);
  if (options.rampart != RampartExtent::all && !column) config.rampart = RampartShape::off;
  std::optional<PrintedRampart> rampart;
  try {
    rampart.emplace(around, use, config, options.threads);
    if (meets_skirts(scene, *rampart)) {
      around = around_skirts(scene);
      rampart.emplace(around, use, config, options.threads);
    }
  } catch (const Error& fault) {
    std::string_view what = fault.what();
    if (what.ends_with(room_advice)) what.remove_suffix(room_advice.size());
    progress.warn(fmt::format("{}: {}; it is re-planned without a rampart", print.name, what));
    config.rampart = RampartShape::off;
    rampart.emplace(around, use, config, options.threads);
  }
  std::vector<double> height_mm;
  for (const Slab& slab : scene.storeys.part.slabs) height_mm.push_back(slab.height_mm);
  if (config.planner == Planner::plain) return {in_plain_order(scene, *rampart, recovered, config), !rampart->empty()};
  const SurfaceVisibility visibility(scene.storeys.part.outlines, height_mm, {.threads = options.threads}, progress);
  const int first = recovered.layers.front().runs.front().tool;
  std::vector<int> first_of_layer = first_extruders(extruders, first);
  if (scene.has_shield || recovered.keeps_tools)
    for (std::size_t k = 0; k < first_of_layer.size(); ++k) first_of_layer[k] = recovered.layers[k].runs.front().tool;

  const std::vector<Polygons> reach = reaches(scene, config);
  const int count = int(scene.layers.size());
  std::vector<std::optional<StagedLayer>> planned{std::size_t(count)};
  std::vector<Layer> result;
  Path below;
  LeadOptions leads;
  for (int e = 0; e < int(config.extruders.size()); ++e) leads.hop.push_back(hop_time(config, e));
  const int walled = walled_layers(scene.layers, leads.ooze);
  const auto plan = [&](int k) {
    const std::size_t storey = scene.storeys.of_layer[std::size_t(k)];
    const PackedPolygons& outline = scene.storeys.part.outlines[storey];
    Layer layer = scene.layers[std::size_t(k)];
    if (k < walled) layer = with_walls(std::move(layer), scene, *rampart, recovered, config);
    PlanScene own = plan_scene(scene.storeys.part, use, config, *rampart, int(storey));
    if (k >= walled) own.site = {};
    if (!own.site.part.empty()) own.site.part = outline;
    if (scene.has_shield) own.site = {use.hot(int(storey), config), outline};
    planned[std::size_t(k)].emplace(std::move(layer), first_of_layer[std::size_t(k)], scene.stops[std::size_t(k)],
                                    config, own, visibility);
  };
  const auto take = [&](int k) {
    if (progress.interrupted()) throw Error("interrupted");
    std::optional<StagedLayer>& own = planned[std::size_t(k)];
    if (!own->arrive_from(below))
      throw Error(
          fmt::format("{}: layer {}: tools do not change in the order that is planned; such files are not "
                      "re-planned yet",
                      print.name, k + 1));
    Path last = own->last();
    Layer layer = with_loops_apart(std::move(*own).release(), recovered.layers[std::size_t(k)], print, machine, leads);
    const std::size_t storey = scene.storeys.of_layer[std::size_t(k)];
    const auto regions_of = [&](std::size_t s) { return unpacked(scene.storeys.part.regions[s]); };
    const Path* before = below.points.empty() ? nullptr : &below;
    layer = with_leads(std::move(layer), regions_of(storey), before, leads);
    if (config.idle_nozzle != IdleNozzle::same_height && scene.stops[std::size_t(k)].empty())
      layer = with_change_places(std::move(layer), regions_of(storey),
                                 storey > 0 ? regions_of(storey - 1) : std::vector<Polygons>{}, before);
    result.push_back(std::move(layer));
    below = std::move(last);
    own.reset();
    progress.advance("planning", double(k + 1) / count);
  };
  run({.count = count, .window = 3 * options.threads + 4, .stages = {{0, plan}}, .consume = take}, options.threads);
  return {std::move(result), !rampart->empty(), stands_apart};
}

}  // namespace cleancolor
