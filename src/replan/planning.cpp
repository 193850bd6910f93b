#include "replan/planning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "model/ini.hpp"
#include "model/reach.hpp"
#include "model/text_scan.hpp"
#include "plan/planner.hpp"
#include "printed/printed_layer.hpp"
#include "printed/regions.hpp"
#include "printed/zones.hpp"
#include "protection.hpp"
#include "replan/change_places.hpp"
#include "replan/closed_runs.hpp"
#include "replan/columns.hpp"
#include "replan/cura.hpp"
#include "replan/file_parts.hpp"
#include "replan/kept_shield.hpp"
#include "replan/leads.hpp"
#include "replan/staged_layer.hpp"
#include "replan/walled_layers.hpp"
#include "toolpath/roads.hpp"

namespace cleancolor {
namespace {

constexpr double detail_mm = 0.02;  // of recovered regions
constexpr double same_width_mm = 0.02;
constexpr double same_speed = 0.02;        // share
constexpr double crack_mm = 0.05;          // between two colours is no air
constexpr std::size_t depth_samples = 16;  // places of a loop that are asked how deep it lies

struct RefusedOption {
  std::string_view key;
  std::string_view reason;
};
constexpr RefusedOption refused_options[] = {
    {"spiral_vase", "vase mode is one road from bottom to top; there is nothing to put in order"},
    {"complete_objects", "objects that are printed one after the other are not re-planned"},
    {"single_extruder_multi_material", "filament changes in one nozzle, so that no idle nozzle can ooze"},
    {"use_firmware_retraction", "the firmware draws filament back; switch it off in the slicer"},
    {"use_volumetric_e", "E in mm3 is not re-planned yet; switch it off in the slicer"},
    {"infill_first", "infill before perimeters is not re-planned yet; switch it off in the slicer"},
    {"ironing", "ironing is not re-planned yet; switch it off in the slicer"},
    {"wall_sequence",
     "outer walls between inner ones are not re-planned; print them from the inside out or the outside in"},
};

/// 0 along the border of its zone, 1 the next loop inside, ...
int depth_of(const Path& path, const Zone* zone) {
  if (!std::ranges::all_of(path.stretches, [](const Stretch& s) { return is_wall(s.road.role); })) return fill_depth;
  const auto is_outer = [](const Stretch& s) { return s.road.role == Role::external_perimeter; };
  if (std::ranges::any_of(path.stretches, is_outer)) return 0;
  if (zone == nullptr) return 1;
  std::vector<double> depths;
  const std::size_t step = std::max<std::size_t>(1, path.points.size() / depth_samples);
  for (std::size_t i = 0; i < path.points.size(); i += step)
    depths.push_back(border_distance_mm(zone->region, path.points[i]));
  std::ranges::nth_element(depths, depths.begin() + std::ptrdiff_t(depths.size() / 2));
  const double spacing = road_spacing_mm(path.road().width_mm, path.road().height_mm);
  const double inside = depths[depths.size() / 2] - path.road().width_mm / 2;
  const bool overhangs =
      std::ranges::all_of(path.stretches, [](const Stretch& s) { return s.road.role == Role::overhang_perimeter; });
  return std::clamp(int(std::lround(inside / std::max(spacing, 0.05))), overhangs ? 0 : 1, fill_depth - 1);
}

/// Everything that stages of a print are planned from.
struct Scene {
  Slices slices;                         // of the part
  Slices around;                         // the same with skirt and brim: what a rampart stands around
  std::vector<Layer> layers;             // their paths as in the file
  std::vector<std::vector<Stop>> stops;  // of each layer
  bool has_shield = false;
};

/// Two points, so that it can be planned; where it goes on from.
Path path_of_stop(FilePoint at, int tool, int source, double height_mm, const AuditMachine& machine) {
  constexpr double width_mm = 0.4;
  Path path;
  path.extruder = tool;
  path.source = source;
  path.island = -1;
  path.points = {place_mm(at, tool, machine), place_mm({at.x_um + 1, at.y_um}, tool, machine)};
  path.stretches.push_back({0, {Role::custom, width_mm, height_mm, width_mm * height_mm, 10}});
  return path;
}

void recover_layer(std::size_t k, const RecoveredPrint& recovered, const GcodePrint& print, const AuditMachine& machine,
                   bool keeps_seams, Scene& scene) {
  const RecoveredLayer& layer = recovered.layers[k];
  std::vector<LaidRoad> roads;
  Polygons auxiliary;
  std::vector<LaidRoad> extra;
  for (const RecoveredRun& run : layer.runs) {
    FilePoint from = run.from;
    for (const RunRoad& road : run.roads) {
      const GcodeMove& move = print.moves[road.move];
      const LaidRoad laid{place_mm(from, run.tool, machine), place_mm(road.to, run.tool, machine), road_width_mm(move),
                          run.tool, move.role};
      (is_auxiliary(move.role) ? extra : roads).push_back(laid);
      from = road.to;
    }
  }
  std::vector<Polygons> regions;
  Polygons outline;
  for (int n = 0; n < int(machine.nozzles.size()); ++n) {
    regions.push_back(simplified(region(roads, n, detail_mm), detail_mm / 2));
    append(outline, regions.back());
  }
  outline = simplified(closed(united(outline), crack_mm), detail_mm / 2);
  scene.slices.regions[k] = packed(regions);
  scene.slices.outlines[k] = outline;
  scene.around.regions[k] = scene.slices.regions[k];
  scene.around.outlines[k] = extra.empty() ? outline : united(outline, filled(plastic(extra, detail_mm)));

  const std::vector<Zone> zones = zones_of(regions);
  Layer& planned = scene.layers[k];
  planned.index = int(k);
  planned.print_z_mm = layer.z_mm;
  planned.height_mm = layer.height_mm;
  for (std::size_t i = 0; i < layer.runs.size(); ++i) {
    const RecoveredRun& run = layer.runs[i];
    if (run.fixed) {
      planned.paths.push_back(path_of_stop(run.from, run.tool, int(i), layer.height_mm, machine));
      const FixedLines& fixed = *run.fixed;
      const int after = fixed.tool_after;
      Path leaving = path_of_stop(fixed.to, fixed.lays ? after : run.tool, -1, layer.height_mm, machine);
      leaving.extruder = after;
      // A change alone leaves the carriage where it is.
      if (!fixed.lays)
        for (Vec2& p : leaving.points) p = p - nozzle_offset_mm(machine, run.tool) + nozzle_offset_mm(machine, after);
      leaving.points.pop_back();
      scene.stops[k].push_back({int(i), fixed.lays, std::move(leaving)});
      continue;
    }
    Path path = path_of(layer.runs[i], int(i), layer.height_mm, print, machine);
    if (path.road().role == Role::wipe_tower) {  // it stays where it is in the order
      Path leaving = path;
      leaving.points = {path.points.back()};
      leaving.stretches.resize(1);
      scene.stops[k].push_back({int(i), true, std::move(leaving)});
    }
    if (keeps_seams) path.closed = false;
    path.island = zone_of(path, zones);
    path.depth = depth_of(path, path.island >= 0 ? &zones[std::size_t(path.island)] : nullptr);
    // Part plastic that lies in no zone waits for nothing, and nothing for it.
    if (path.island < 0 && !is_auxiliary(path.road().role)) path.island = int(zones.size() + i);
    planned.paths.push_back(std::move(path));
  }
}

Scene scene_of(const RecoveredPrint& recovered, const GcodePrint& print, const AuditMachine& machine, bool keeps_seams,
               int threads) {
  Scene scene;
  const std::size_t count = recovered.layers.size();
  for (Slices* slices : {&scene.slices, &scene.around}) {
    slices->regions.resize(count);
    slices->outlines.resize(count);
    for (const RecoveredLayer& layer : recovered.layers)
      slices->slabs.push_back({.print_z_mm = layer.z_mm, .height_mm = std::clamp(layer.height_mm, 0.01, 5.)});
  }
  scene.layers.resize(count);
  scene.stops.resize(count);
  parallel_for(int(count), threads,
               [&](int k) { recover_layer(std::size_t(k), recovered, print, machine, keeps_seams, scene); });
  const auto shield = shield_runs(recovered, print);
  scene.has_shield = !shield.empty();
  for (std::size_t k = 0; k < shield.size(); ++k)
    for (const std::size_t i : shield[k]) scene.layers[k].paths[i] = as_wall(std::move(scene.layers[k].paths[i]));
  return scene;
}

void require_part(const Scene& scene, const GcodePrint& print) {
  for (std::size_t k = 0; k < scene.layers.size(); ++k)
    if (scene.slices.outlines[k].empty())
      throw Error(
          fmt::format("{}: layer {} has nothing of the part; such files are not re-planned yet", print.name, k + 1));
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

Layer with_walls(Layer layer, const PrintedRampart& rampart, const RecoveredPrint& recovered, const Config& config) {
  std::vector<Path> paths = rampart.paths(layer.index);
  if (recovered.keeps_tools) by_tools_of(recovered.layers[std::size_t(layer.index)], paths);
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
std::vector<Layer> in_plain_order(Scene& scene, const PrintedRampart& rampart, const RecoveredPrint& recovered,
                                  const Config& config) {
  OrderState state{.extruder = recovered.layers.front().runs.front().tool, .at = {}, .seams = {}};
  for (Layer& layer : scene.layers) {
    const std::vector<Stop>& stops = scene.stops[std::size_t(layer.index)];
    std::vector<Layer> parts = parts_of(with_walls(std::move(layer), rampart, recovered, config), stops);
    layer = parts.front();
    layer.paths.clear();
    for (Layer& part : parts) {
      if (scene.has_shield || !stops.empty()) state.extruder = part.paths.front().extruder;
      order(part, state, config, rampart.site(layer.index));
      std::ranges::move(part.paths, std::back_inserter(layer.paths));
    }
  }
  return std::move(scene.layers);
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

Vec2 place_mm(FilePoint at, int tool, const AuditMachine& machine) {
  return plastic_mm(machine, {double(at.x_um) / 1000, double(at.y_um) / 1000}, tool);
}

Path path_of(const RecoveredRun& run, int source, double height_mm, const GcodePrint& print,
             const AuditMachine& machine) {
  Path path;
  path.extruder = run.tool;
  path.source = source;
  path.island = -1;
  path.points.push_back(place_mm(run.from, run.tool, machine));
  const double filament_mm2 = filament_area_mm2(machine, run.tool);
  for (const RunRoad& r : run.roads) {
    const GcodeMove& move = print.moves[r.move];
    const Vec2 to = place_mm(r.to, run.tool, machine);
    const double mm = distance(path.points.back(), to);
    const Road road{.role = move.role,
                    .width_mm = road_width_mm(move),
                    .height_mm = move.height_mm > 0 ? double(move.height_mm) : height_mm,
                    .area_mm2 = mm > 0 ? double(r.filament_e5) * 1e-5 * filament_mm2 / mm : 0,
                    .speed_mm_s = std::max(1., r.feed_mm_min / 60)};
    const auto is_same = [&](const Road& other) {
      return other.role == road.role && std::abs(other.width_mm - road.width_mm) <= same_width_mm &&
             std::abs(other.speed_mm_s - road.speed_mm_s) <= same_speed * road.speed_mm_s;
    };
    if (path.stretches.empty() || !is_same(path.stretches.back().road))
      path.stretches.push_back({std::uint32_t(path.points.size() - 1), road});
    path.points.push_back(to);
  }
  const double gap = distance(path.points.front(), path.points.back());
  const bool walls = std::ranges::all_of(path.stretches, [](const Stretch& s) { return is_wall(s.road.role); });
  const bool is_loop = comes_back(gap, length_mm(path), path.road().width_mm);
  if (!walls || !is_loop || path.points.size() < 4) return path;
  path.closed = true;
  if (gap == 0) path.points.pop_back();
  return path;
}

ReplannedLayers planned_layers(const RecoveredPrint& recovered, const GcodePrint& print, const AuditMachine& machine,
                               Config config, const ReplanOptions& options, const Progress& progress) {
  progress.advance("regions", 0);
  Scene scene = scene_of(recovered, print, machine, options.keeps_seams, options.threads);
  require_part(scene, print);
  if (!options.plans) {
    for (std::size_t k = 0; k < scene.layers.size(); ++k)
      for (std::size_t i = 0; i < scene.layers[k].paths.size(); ++i) {
        Path& path = scene.layers[k].paths[i];
        path.closed = false;  // begun where the file begins it
        for (const FilePoint p : recovered.layers[k].runs[i].way)
          path.travel.push_back(place_mm(p, path.extruder, machine));
      }
    return {std::move(scene.layers)};
  }
  const Use use(scene.slices);
  if (use.extruders.size() < 2)
    throw Error(fmt::format("{}: one nozzle prints it all; there is nothing to keep apart", print.name));
  const double apart_mm = columns_apart_mm(config);
  scene.around = without_columns_beside(scene.around, scene.slices, apart_mm);
  const bool stands_apart = columns(scene.around, apart_mm).size() > 1;
  std::optional<Slices> column;
  if (options.rampart == RampartExtent::column) column = shortest_column(scene.around, apart_mm);
  if (column) scene.around = std::move(*column);
  if (options.rampart != RampartExtent::all && !column) config.rampart = RampartShape::off;
  std::optional<PrintedRampart> rampart;
  try {
    rampart.emplace(scene.around, use, config, options.threads);
  } catch (const Error& fault) {
    progress.warn(fmt::format("{}: {}; it is re-planned without a rampart", print.name, fault.what()));
    config.rampart = RampartShape::off;
    rampart.emplace(scene.around, use, config, options.threads);
  }
  std::vector<double> height_mm;
  for (const Slab& slab : scene.slices.slabs) height_mm.push_back(slab.height_mm);
  if (config.planner == Planner::plain) return {in_plain_order(scene, *rampart, recovered, config), !rampart->empty()};
  const SurfaceVisibility visibility(scene.slices.outlines, height_mm, {.threads = options.threads}, progress);
  const int first = recovered.layers.front().runs.front().tool;
  std::vector<int> first_of_layer = first_extruders(printing_by_layer(scene.slices), first);
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
    Layer layer = std::move(scene.layers[std::size_t(k)]);
    if (k < walled) layer = with_walls(std::move(layer), *rampart, recovered, config);
    PlanScene around = plan_scene(scene.slices, use, config, *rampart, k);
    if (k >= walled) around.site = {};
    if (!around.site.part.empty()) around.site.part = scene.slices.outlines[std::size_t(k)];
    if (scene.has_shield) around.site = {use.hot(k, config), scene.slices.outlines[std::size_t(k)]};
    planned[std::size_t(k)].emplace(std::move(layer), first_of_layer[std::size_t(k)], scene.stops[std::size_t(k)],
                                    config, around, visibility);
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
    const std::vector<Polygons> regions = unpacked(scene.slices.regions[std::size_t(k)]);
    const Path* before = below.points.empty() ? nullptr : &below;
    layer = with_leads(std::move(layer), regions, before, leads);
    if (config.idle_nozzle != IdleNozzle::same_height && scene.stops[std::size_t(k)].empty())
      layer = with_change_places(std::move(layer), regions,
                                 k > 0 ? unpacked(scene.slices.regions[std::size_t(k) - 1]) : std::vector<Polygons>{},
                                 before);
    result.push_back(std::move(layer));
    below = std::move(last);
    own.reset();
    progress.advance("planning", double(k + 1) / count);
  };
  run({.count = count, .window = 3 * options.threads + 4, .stages = {{0, plan}}, .consume = take}, options.threads);
  return {std::move(result), !rampart->empty(), stands_apart};
}

}  // namespace cleancolor
