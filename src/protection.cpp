#include "protection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "base/error.hpp"
#include "model/reach.hpp"
#include "shield/walls.hpp"
#include "toolpath/roads.hpp"

namespace cleancolor {
namespace {

/// Layers in which an idle nozzle is hot: those below the end of the last but one extruder, or all.
int protected_layers(const Slices& slices, const Use& use, const Config& config) {
  if (!config.heater_off_after_last_use) return int(slices.slabs.size());
  std::vector<int> last;
  for (const int e : use.extruders) last.push_back(*use.last_layer[std::size_t(e)]);
  std::ranges::sort(last, std::greater());
  return last[1] + 1;
}

Road wall_road(const Config& config, int extruder, int layer, const Slab& slab) {
  Road road = roads(config, extruder, layer, slab).skirt_brim;
  road.role = Role::rampart;
  road.speed_mm_s = layer == 0 ? config.first_layer_speed.of(config.rampart_speed_mm_s) : config.rampart_speed_mm_s;
  return road;
}

Vec2 offset_mm(const Config& config, int extruder) {
  return config.extruders[std::size_t(extruder)].nozzle_offset_mm;
}

Polygons common_reach(const Config& config, const std::vector<int>& extruders) {
  Polygons common = reach(config, extruders.front());
  for (const int e : extruders) common = intersection(common, reach(config, e));
  return common;
}

/// From the first to the second of two nozzles.
Vec2 to_second_mm(const Config& config, const Use& use) {
  return offset_mm(config, use.extruders[1]) - offset_mm(config, use.extruders[0]);
}

/// Halves need two nozzles that hang beside each other; docked ones take each other's place.
bool is_split(const Config& config, const Use& use) {
  return config.rampart_walls == RampartWalls::split && use.extruders.size() == 2 &&
         to_second_mm(config, use) != Vec2{};
}

std::size_t wall_count(const Config& config, const Use& use) {
  return is_split(config, use) ? 1 : use.extruders.size();
}

/// How far the rampart reaches beyond the part; 0 where there is none. Its brim ends where the bed does.
double rampart_reach_mm(const Config& config, const Use& use) {
  if (rampart_shape(config, use) == RampartShape::off) return 0;
  double nozzle_mm = 0;
  for (const int e : use.extruders)
    nozzle_mm = std::max(nozzle_mm, config.extruders[std::size_t(e)].nozzle_diameter_mm);
  return config.ooze_shield_dist_mm + double(wall_count(config, use) - 1) * config.rampart_gap_mm + nozzle_mm;
}

}  // namespace

Use::Use(const Slices& slices) : last_layer(slices.regions.empty() ? 0 : slices.regions.front().size()) {
  for (std::size_t k = 0; k < slices.regions.size(); ++k)
    for (std::size_t e = 0; e < last_layer.size(); ++e)
      if (!slices.regions[k][e].empty()) last_layer[e] = int(k);
  for (std::size_t e = 0; e < last_layer.size(); ++e)
    if (last_layer[e]) extruders.push_back(int(e));
}

std::vector<int> Use::hot(int layer, const Config& config) const {
  std::vector<int> result;
  for (const int e : extruders)
    if (!config.heater_off_after_last_use || *last_layer[std::size_t(e)] >= layer) result.push_back(e);
  return result;
}

RampartShape rampart_shape(const Config& config, const Use& use) {
  if (use.extruders.size() < 2) return RampartShape::off;
  if (config.rampart != RampartShape::automatic) return config.rampart;
  return config.idle_nozzle == IdleNozzle::same_height ? RampartShape::conforming : RampartShape::off;
}

RampartOptions PrintedRampart::options(int threads) const {
  return {.conforming = rampart_shape(config_, use_) == RampartShape::conforming,
          .walls = int(wall_count(config_, use_)),
          .distance_mm = config_.ooze_shield_dist_mm,
          .gap_mm = config_.rampart_gap_mm,
          .line_width_mm = wall_road(config_, use_.extruders.front(), 1, slices_.slabs.back()).width_mm,
          .max_overhang_deg = config_.rampart_max_overhang_deg,
          .threads = threads};
}

PrintedRampart::PrintedRampart(const Slices& slices, const Use& use, const Config& config, int threads)
    : slices_(slices), use_(use), config_(config) {
  if (rampart_shape(config, use) == RampartShape::off) return;
  const auto layers = std::size_t(protected_layers(slices, use, config));
  std::vector<double> height_mm;
  for (std::size_t k = 0; k < layers; ++k) height_mm.push_back(slices.slabs[k].height_mm);
  rampart_ = rampart(std::span(slices.outlines).first(layers), height_mm, options(threads));
  split_ = is_split(config, use);
  require_reach();
}

PrintedRampart::PrintedRampart(const Slices& slices, const Use& use, const Config& config, int threads,
                               std::span<const int> some_layers)
    : slices_(slices), use_(use), config_(config) {
  if (rampart_shape(config, use) == RampartShape::off) return;
  RampartOptions alone = options(threads);
  alone.conforming = true;
  alone.stands = false;
  const int layers = protected_layers(slices, use, config);
  std::vector<PackedPolygons> outlines;
  std::vector<double> height_mm;
  std::vector<std::size_t> of_layer;
  for (const int k : some_layers) {
    if (k >= layers) continue;
    of_layer.push_back(std::size_t(k));
    outlines.push_back(slices.outlines[of_layer.back()]);
    height_mm.push_back(slices.slabs[of_layer.back()].height_mm);
  }
  Rampart found = rampart(outlines, height_mm, alone);
  rampart_.walls.resize(std::size_t(layers));
  for (std::size_t i = 0; i < of_layer.size(); ++i) rampart_.walls[of_layer[i]] = std::move(found.walls[i]);
  split_ = is_split(config, use);
}

void PrintedRampart::require_reach() const {
  const Polygons room = common_reach(config_, use_.extruders);
  for (const std::vector<PackedPolygons>& walls : rampart_.walls)
    for (const Polygons& wall : unpacked(walls)) {
      if (difference(wall, room).empty()) continue;
      const Box<Vec2> walls_mm = bounds_mm(wall), room_mm = bounds_mm(room);
      throw Error(fmt::format(
          "no room for the rampart, the wall that keeps the colours apart: it needs X {:.1f} to {:.1f}, Y {:.1f} to "
          "{:.1f} mm, all nozzles reach X {:.1f} to {:.1f}, Y {:.1f} to {:.1f} mm{}",
          walls_mm.min.x, walls_mm.max.x, walls_mm.min.y, walls_mm.max.y, room_mm.min.x, room_mm.max.x, room_mm.min.y,
          room_mm.max.y, room_advice));
    }
}

std::vector<Path> PrintedRampart::paths(int layer) const {
  if (layer >= int(rampart_.walls.size())) return {};
  const std::vector<Polygons> walls = unpacked(rampart_.walls[std::size_t(layer)]);
  const Slab& slab = slices_.slabs[std::size_t(layer)];
  const auto& regions = slices_.regions[std::size_t(layer)];
  // Whoever prints here anyway, else one whose nozzle is still hot.
  const auto prints = [&](int e) { return layer == 0 || !regions[std::size_t(e)].empty(); };
  const std::vector<int> hot = use_.hot(layer, config_);
  const auto any = std::ranges::find_if(use_.extruders, prints);
  const int stand_in = any != use_.extruders.end() ? *any : hot.front();
  std::vector<WallPrinter> printers;
  for (const int e : use_.extruders) {
    const int extruder = prints(e) ? e : stand_in;
    printers.push_back({extruder, wall_road(config_, extruder, layer, slab)});
  }
  std::vector<Path> paths;
  if (layer == 0) {
    std::vector<WallPrinter> brims = printers;
    for (WallPrinter& brim : brims) brim.road = roads(config_, brim.extruder, 0, slab).skirt_brim;
    double spacing = 0;
    for (const WallPrinter& brim : brims) spacing = std::max(spacing, spacing_mm(brim.road));
    const double width = config_.rampart_brim_width_mm;
    paths = split_ ? half_wall_brims(walls.front(), {brims[0], brims[1]}, width, spacing, to_second_mm(config_, use_))
                   : wall_brims(walls, brims, width, config_.rampart_gap_mm, spacing);
    const Polygons room = common_reach(config_, use_.extruders);
    std::erase_if(paths, [&](const Path& loop) { return !within(loop, room); });
  }
  std::vector<Path> own;
  if (split_) {
    own = half_wall_paths(walls.front(), {printers[0], printers[1]}, to_second_mm(config_, use_));
  } else {
    own = wall_paths(walls, printers);
  }
  std::ranges::move(own, std::back_inserter(paths));
  return paths;
}

RampartSite PrintedRampart::site(int layer) const {
  if (layer >= int(rampart_.walls.size())) return {};
  return {use_.hot(layer, config_), slices_.outlines[std::size_t(layer)]};
}

std::vector<std::vector<int>> printing_by_layer(const Slices& slices) {
  std::vector<std::vector<int>> result(slices.regions.size());
  for (std::size_t k = 0; k < slices.regions.size(); ++k)
    for (std::size_t e = 0; e < slices.regions[k].size(); ++e)
      if (!slices.regions[k][e].empty()) result[k].push_back(int(e));
  return result;
}

PlanScene plan_scene(const Slices& slices, const Use& use, const Config& config, const PrintedRampart& rampart,
                     int layer) {
  const auto k = std::size_t(layer);
  const Polygons above = k + 1 < slices.outlines.size() ? Polygons(slices.outlines[k + 1]) : Polygons{};
  const double width_mm = roads(config, use.extruders.front(), layer, slices.slabs[k]).external_perimeter.width_mm;
  return {.part = {unpacked(slices.regions[k]), slices.outlines[k], above, slices.slabs[k].print_z_mm, width_mm},
          .site = rampart.site(layer),
          .hanging = config.idle_nozzle == IdleNozzle::same_height ? use.hot(layer, config) : std::vector<int>{},
          .reach = {}};
}

Azimuths azimuths_of_print(const Slices& slices, const Use& use, const Config& config, std::optional<Vec2> center_mm,
                           int threads) {
  AzimuthOptions options;
  for (std::size_t e = 0; e < config.extruders.size(); ++e) {
    options.nozzle_offset_mm.push_back(config.extruders[e].nozzle_offset_mm);
    options.pace.push_back(pace(config, int(e)));
  }
  options.threads = threads;
  const Polygons room = common_reach(config, use.extruders);
  const Vec2 target = center_mm.value_or(bounds_mm(room).center());
  Polygons hulls;
  for (const PackedPolygons& outline : slices.outlines) hulls.push_back(convex_hull(outline));
  const std::vector<Vec2> hull = to_mm(convex_hull(hulls));
  const double margin_mm = rampart_reach_mm(config, use);
  options.fits = [=](int degrees) {
    std::vector<Vec2> points;
    Box<Vec2> box;
    for (const Vec2 p : hull) {
      points.push_back(turned(p, degrees * std::numbers::pi / 180));
      box.add(points.back());
    }
    Ring ring;
    for (const Vec2 p : points) ring.push_back(to_nm(p - box.center() + target));
    return difference(offset({ring}, margin_mm, Corners::round), room).empty();
  };
  return azimuths(slices, options);
}

}  // namespace cleancolor
