#include "toolpath/bed.hpp"

#include <algorithm>
#include <numbers>

#include "base/edge_rows.hpp"
#include "model/reach.hpp"
#include "toolpath/roads.hpp"

namespace cleancolor {
namespace {

constexpr double edge_distance_mm = 3;  // of prime lines from the edge of the bed

Path loop(const Ring& ring, const Road& road, int extruder) {
  Path path;
  path.extruder = extruder;
  path.island = -1;
  path.closed = true;
  path.points = to_mm(ring);
  path.stretches = {{0, road}};
  return path;
}

/// Outlines only: no brim and no skirt inside holes.
Polygons outlines(const Polygons& region) {
  Polygons result;
  for (const Ring& ring : region)
    if (ClipperLib::Orientation(ring)) result.push_back(ring);
  return united(result);
}

Polygons first_layer(const Slices& slices) {
  Polygons all;
  for (const Polygons& region : unpacked(slices.regions.front())) all.insert(all.end(), region.begin(), region.end());
  return outlines(united(all));
}

/// Loops around the first layer from the outside in, so that the last one presses against the part.
std::vector<Path> brim(const Slices& slices, const Polygons& base, const Config& config) {
  std::vector<Path> paths;
  if (config.brim_type == BrimType::no_brim || config.brim_width_mm <= 0) return paths;
  int extruder = 0;
  while (slices.regions.front()[std::size_t(extruder)].empty()) ++extruder;
  const Road road = roads(config, extruder, 0, slices.slabs.front()).skirt_brim;
  const double spacing = spacing_mm(road);
  const int loops = std::max(1, int(std::lround(config.brim_width_mm / spacing)));
  for (int i = loops; i-- > 0;)
    for (const Ring& ring : outlines(offset(base, config.brim_separation_mm + spacing * (i + 0.5), Corners::round)))
      paths.push_back(loop(ring, road, extruder));
  return paths;
}

/// Filament that one path takes, mm.
double filament_mm(const Path& path, const Config& config) {
  const Extruder& e = config.extruders[std::size_t(path.extruder)];
  return volume_mm3(path) * e.extrusion_multiplier /
         (std::numbers::pi / 4 * e.filament_diameter_mm * e.filament_diameter_mm);
}

/// Skirt loops of one layer from the inside out. In the first layer every extruder prints its share of the loops, and
/// more until it has pushed min_skirt_length of filament; above, one extruder that prints there anyway does it all.
std::vector<Path> skirt(const Slices& slices, const Polygons& base, const std::vector<int>& used, int layer,
                        const Config& config) {
  std::vector<Path> paths;
  const double brim_mm = config.brim_type == BrimType::no_brim || config.brim_width_mm <= 0
                             ? 0
                             : config.brim_separation_mm + config.brim_width_mm;
  const Polygons hull{convex_hull(base)};
  double from_part = brim_mm + config.skirt_distance_mm;
  const auto add_loop = [&](int extruder) {
    const Road road = roads(config, extruder, layer, slices.slabs[std::size_t(layer)]).skirt_brim;
    const double spacing = spacing_mm(road);
    const Polygons ring = offset(hull, from_part + spacing / 2, Corners::round);
    from_part += spacing;
    if (ring.empty()) return false;
    paths.push_back(loop(ring.front(), road, extruder));
    return true;
  };
  const double least_filament_mm = layer == 0 ? config.min_skirt_length_mm : 0;
  const int share = (config.skirts + int(used.size()) - 1) / int(used.size());
  for (const int extruder : used) {
    double pushed = 0;
    for (int i = 0; i < share || pushed < least_filament_mm; ++i) {
      if (!add_loop(extruder)) break;
      // Loops beyond the bed are dropped later; there is no end to them.
      if (!within(paths.back(), reach(config, extruder))) break;
      pushed += filament_mm(paths.back(), config);
    }
  }
  return paths;
}

/// One line of the given length for each extruder along an edge of the bed (0 front, 1 back, 2 left, 3 right).
std::vector<Path> prime_lines_along(int edge, double length_mm, const std::vector<int>& extruders, const Box<Vec2>& bed,
                                    const Slices& slices, const Config& config) {
  std::vector<Path> paths;
  double inset = edge_distance_mm;
  for (const int extruder : extruders) {
    const Road road = roads(config, extruder, 0, slices.slabs.front()).prime;
    const Vec2 c = bed.center(), half = edge < 2 ? Vec2{length_mm / 2, 0} : Vec2{0, length_mm / 2};
    Path path;
    path.extruder = extruder;
    path.island = -1;
    path.stretches = {{0, road}};
    for (Vec2 p : {c - half, c + half}) {
      if (edge == 0) p.y = bed.min.y + inset;
      if (edge == 1) p.y = bed.max.y - inset;
      if (edge == 2) p.x = bed.min.x + inset;
      if (edge == 3) p.x = bed.max.x - inset;
      path.points.push_back(p);
    }
    inset += 2 * road.width_mm;
    paths.push_back(std::move(path));
  }
  return paths;
}

/// Prime lines along the first edge of the bed that is free, shorter ones where no edge has room for whole ones; none
/// where even these do not fit.
std::vector<Path> prime_lines(const Slices& slices, const Polygons& taken, const std::vector<int>& extruders,
                              const Config& config) {
  Polygons common = reach(config, extruders.front());
  for (const int extruder : extruders) common = intersection(common, reach(config, extruder));
  const Box<Vec2> bed = bounds_mm(common);
  const EdgeRows keep_out(offset(taken, edge_distance_mm));
  for (const double share : {1.0, 0.5, 0.25})
    for (const int edge : {0, 1, 2, 3}) {
      auto paths = prime_lines_along(edge, share * config.prime_line_length_mm, extruders, bed, slices, config);
      const auto fits = [&](const Path& path) { return within(path, common) && keep_out.clipped(path.points).empty(); };
      if (std::all_of(paths.begin(), paths.end(), fits)) return paths;
    }
  return {};
}

/// Drops the paths that their nozzle cannot reach; how many.
int drop_unreachable(std::vector<Path>& paths, const Config& config) {
  return int(std::erase_if(paths, [&](const Path& path) { return !within(path, reach(config, path.extruder)); }));
}

/// The part and everything around it: where no prime line may go.
Polygons taken(const Polygons& base, const std::vector<Path>& around) {
  Polygons all = base;
  for (const Path& path : around) {
    Ring ring;
    for (const Vec2 p : path.points) ring.push_back(to_nm(p));
    all = united(all, {ring});
  }
  return all;
}

/// The extruders that print in a layer.
std::vector<int> printing(const Slices& slices, int layer) {
  std::vector<int> result;
  const auto& regions = slices.regions[std::size_t(layer)];
  for (std::size_t e = 0; e < regions.size(); ++e)
    if (!regions[e].empty()) result.push_back(int(e));
  return result;
}

}  // namespace

std::vector<std::vector<Path>> bed_paths(const Slices& slices, const std::vector<int>& used, const Config& config,
                                         const Progress& progress) {
  const Polygons base = first_layer(slices);
  std::vector<std::vector<Path>> result(1);
  std::vector<Path> rim = brim(slices, base, config);
  int dropped = drop_unreachable(rim, config);
  if (config.skirts > 0)
    result.resize(std::size_t(std::clamp(config.skirt_height_layers, 1, int(slices.slabs.size()))));
  for (int k = 0; k < int(result.size()) && config.skirts > 0; ++k) {
    const std::vector<int> here = printing(slices, k);
    if (k > 0 && here.empty()) continue;
    result[std::size_t(k)] = skirt(slices, base, k == 0 ? used : std::vector<int>{here.front()}, k, config);
    dropped += drop_unreachable(result[std::size_t(k)], config);
  }

  std::vector<int> unprimed;
  for (const int extruder : used)
    if (std::none_of(result[0].begin(), result[0].end(), [&](const Path& p) { return p.extruder == extruder; }))
      unprimed.push_back(extruder);
  result[0].insert(result[0].end(), rim.begin(), rim.end());
  if (!unprimed.empty() && config.prime_line_length_mm > 0) {
    const std::vector<Path> lines = prime_lines(slices, taken(base, result[0]), unprimed, config);
    if (lines.empty()) progress.warn("no edge of the bed is free for prime lines: the nozzles start unprimed");
    result[0].insert(result[0].begin(), lines.begin(), lines.end());
  }
  if (dropped > 0)
    progress.warn("the bed is too small for all of the skirt and brim: loops that a nozzle cannot reach are left out");
  return result;
}

}  // namespace cleancolor
