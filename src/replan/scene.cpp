#include "replan/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "printed/printed_layer.hpp"
#include "printed/regions.hpp"
#include "printed/zones.hpp"
#include "replan/closed_runs.hpp"
#include "replan/file_parts.hpp"
#include "replan/kept_shield.hpp"
#include "toolpath/roads.hpp"

namespace cleancolor {
namespace {

constexpr double detail_mm = 0.02;  // of recovered regions
constexpr std::size_t most_layers = 20'000;
constexpr double same_width_mm = 0.02;
constexpr double same_speed = 0.02;            // share
constexpr double brim_gap_mm = 1;              // up to the part, or its next loop
constexpr std::size_t most_skirt_loops = 100;  // in a layer, that are looked at one by one
constexpr double crack_mm = 0.05;              // between two colours is no air
constexpr std::size_t depth_samples = 16;      // places of a loop that are asked how deep it lies

/// 0 along the border of its zone, 1 the next loop inside, ...
int depth_of(const Path& path, const Zone* zone) {
  if (!std::ranges::all_of(path.stretches, [](const Stretch& s) { return is_wall(s.road.role); })) return fill_depth;
  const auto is_outer = [](const Stretch& s) { return s.road.role == Role::external_perimeter; };
  if (std::ranges::any_of(path.stretches, is_outer)) return 0;
  if (zone == nullptr) return 1;
  std::vector<Vec2> places;
  const std::size_t step = std::max<std::size_t>(1, path.points.size() / depth_samples);
  for (std::size_t i = 0; i < path.points.size(); i += step) places.push_back(path.points[i]);
  const double spacing = road_spacing_mm(path.road().width_mm, path.road().height_mm);
  const double inside = median_depth_mm(places, zone->region) - path.road().width_mm / 2;
  const bool overhangs =
      std::ranges::all_of(path.stretches, [](const Stretch& s) { return s.road.role == Role::overhang_perimeter; });
  return std::clamp(int(std::lround(inside / std::max(spacing, 0.05))), overhangs ? 0 : 1, fill_depth - 1);
}

/// Where the road's plastic goes on to, and ends: places of an arc, as the reader has it.
std::vector<Vec2> places_mm(const RunRoad& road, int tool, const GcodePrint& print, const AuditMachine& machine) {
  std::vector<Vec2> places;
  for (std::uint32_t i = road.move; i + 1 < road.move + road.moves; ++i) {
    const Vec3 to = print.moves[i].to_mm;
    places.push_back(plastic_mm(machine, {to.x, to.y}, tool));
  }
  places.push_back(place_mm(road.to, tool, machine));
  return places;
}

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

/// Bridges are told to be as high as their round strands, and ironing as what it adds.
bool tells_height(const GcodeMove& move) {
  return !is_auxiliary(move.role) && move.role != Role::bridge_infill && move.role != Role::overhang_perimeter &&
         move.role != Role::ironing;
}

/// What there is of the part in each layer, of all but skirts, and of skirts.
struct LayerSlices {
  Slices part, around;
  std::vector<PackedPolygons> skirts;
};

using RunRoads = std::vector<LaidRoad>;

/// Joins what touches the region, as loops of a brim, to it; where there are many loops, all. Returns: the others,
/// skirts.
RunRoads join_brim(const std::vector<RunRoads>& loops, Polygons& region) {
  std::vector<Polygons> laid;
  for (const RunRoads& loop : loops) laid.push_back(plastic(loop, detail_mm));
  if (loops.size() > most_skirt_loops) {
    for (const Polygons& loop : laid) append(region, filled(loop));
    region = united(region);
    return {};
  }
  std::vector<char> is_joined(loops.size(), 0);
  for (bool found = true; found;) {
    found = false;
    const Polygons near = offset(region, brim_gap_mm, Corners::round);
    for (std::size_t i = 0; i < loops.size(); ++i) {
      if (is_joined[i] != 0 || intersection(near, laid[i]).empty()) continue;
      is_joined[i] = 1;
      found = true;
      region = united(region, filled(laid[i]));
    }
  }
  RunRoads skirts;
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (is_joined[i] == 0) skirts.insert(skirts.end(), loops[i].begin(), loops[i].end());
  return skirts;
}

/// Returns: what the nozzles' roads of the part enclose.
std::vector<Polygons> slice_layer(std::size_t k, const RecoveredLayer& layer, const GcodePrint& print,
                                  const AuditMachine& machine, LayerSlices& slices) {
  RunRoads roads, extra;
  std::vector<RunRoads> loops;  // of skirt and brim
  double height_mm = 0;
  for (const RecoveredRun& run : layer.runs) {
    FilePoint from = run.from;
    loops.emplace_back();
    for (const RunRoad& road : run.roads) {
      const GcodeMove& move = print.moves[road.move];
      Vec2 at = place_mm(from, run.tool, machine);
      for (const Vec2 to : places_mm(road, run.tool, print, machine)) {
        RunRoads& all = move.role == Role::skirt_brim ? loops.back() : is_auxiliary(move.role) ? extra : roads;
        all.push_back({at, to, road_width_mm(move), run.tool, move.role});
        at = to;
      }
      if (tells_height(move)) height_mm = std::max(height_mm, std::round(move.height_mm * 1e4) / 1e4);
      from = road.to;
    }
    if (loops.back().empty()) loops.pop_back();
  }
  std::vector<Polygons> regions;
  Polygons outline;
  for (int n = 0; n < int(machine.nozzles.size()); ++n) {
    regions.push_back(simplified(region(roads, n, detail_mm), detail_mm / 2));
    append(outline, regions.back());
  }
  outline = simplified(closed(united(outline), crack_mm), detail_mm / 2);
  slices.part.regions[k] = packed(regions);
  slices.part.outlines[k] = outline;
  slices.part.slabs[k] = {.print_z_mm = layer.z_mm,
                          .height_mm = std::clamp(height_mm > 0 ? height_mm : layer.height_mm, 0.01, 5.)};
  Polygons around = extra.empty() ? outline : united(outline, filled(plastic(extra, detail_mm)));
  if (!loops.empty()) slices.skirts[k] = plastic(join_brim(loops, around), detail_mm);
  slices.around.outlines[k] = around;
  return regions;
}

void recover_layer(std::size_t k, const RecoveredPrint& recovered, const GcodePrint& print, const AuditMachine& machine,
                   bool keeps_seams, LayerSlices& slices, Scene& scene) {
  const RecoveredLayer& layer = recovered.layers[k];
  const std::vector<Zone> zones = zones_of(slice_layer(k, layer, print, machine, slices));
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

void require_part(const Scene& scene, const GcodePrint& print) {
  if (std::ranges::all_of(scene.storeys.part.outlines, &PackedPolygons::empty))
    throw Error(fmt::format("{}: it has nothing of a part; there is nothing to plan", print.name));
}

}  // namespace

Scene scene_of(const RecoveredPrint& recovered, const GcodePrint& print, const AuditMachine& machine, bool keeps_seams,
               int threads) {
  Scene scene;
  const std::size_t count = recovered.layers.size();
  if (count > most_layers)
    throw Error(fmt::format("{}: more than {} layers; slice with thicker ones", print.name, most_layers));
  LayerSlices slices;
  slices.part.slabs.resize(count);
  slices.part.regions.resize(count);
  for (Slices* all : {&slices.part, &slices.around}) all->outlines.resize(count);
  slices.skirts.resize(count);
  scene.layers.resize(count);
  scene.stops.resize(count);
  parallel_for(int(count), threads,
               [&](int k) { recover_layer(std::size_t(k), recovered, print, machine, keeps_seams, slices, scene); });
  scene.storeys = storeys(std::move(slices.part), std::move(slices.around));
  scene.skirts = std::move(slices.skirts);
  const auto shield = shield_runs(recovered, print);
  scene.has_shield = !shield.empty();
  for (std::size_t k = 0; k < shield.size(); ++k)
    for (const std::size_t i : shield[k]) scene.layers[k].paths[i] = as_wall(std::move(scene.layers[k].paths[i]));
  if (scene.has_shield) {
    scene.storeys.around = around_skirts(scene);
    scene.skirts.assign(count, {});
  }
  require_part(scene, print);
  return scene;
}

Slices around_skirts(const Scene& scene) {
  Slices around = scene.storeys.around;
  for (std::size_t k = 0; k < scene.skirts.size(); ++k) {
    if (scene.skirts[k].empty()) continue;
    PackedPolygons& outline = around.outlines[scene.storeys.of_layer[k]];
    outline = united(outline, filled(scene.skirts[k]));
  }
  return around;
}

Vec2 place_mm(FilePoint at, int tool, const AuditMachine& machine) {
  return plastic_mm(machine, mm_of(at), tool);
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
    const std::vector<Vec2> places = places_mm(r, run.tool, print, machine);
    double mm = distance(path.points.back(), places.front());
    for (std::size_t i = 1; i < places.size(); ++i) mm += distance(places[i - 1], places[i]);
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
    path.points.insert(path.points.end(), places.begin(), places.end());
  }
  const bool walls = std::ranges::all_of(path.stretches, [](const Stretch& s) { return is_wall(s.road.role); });
  return walls ? closed_where_it_comes_back(std::move(path)) : path;
}

}  // namespace cleancolor
