#include "toolpath/bed.hpp"

#include <algorithm>
#include <array>

#include "base/edge_rows.hpp"
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

bool within(const Path& path, const Polygons& area) {
  return std::all_of(path.points.begin(), path.points.end(), [&](Vec2 p) { return contains(area, to_nm(p)); });
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
  for (const Polygons& region : slices.regions.front()) all.insert(all.end(), region.begin(), region.end());
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

/// Skirt loops from the inside out, dealt to the extruders in turn until each has printed min_skirt_length.
std::vector<Path> skirt(const Slices& slices, const Polygons& base, const std::vector<int>& used, int layer,
                        const Config& config) {
  std::vector<Path> paths;
  const double brim_mm = config.brim_type == BrimType::no_brim ? 0 : config.brim_separation_mm + config.brim_width_mm;
  const Polygons hull{convex_hull(base)};
  double from_part = brim_mm + config.skirt_distance_mm;
  const auto add_loop = [&](int extruder) {
    const Road road = roads(config, extruder, layer, slices.slabs[std::size_t(layer)]).skirt_brim;
    const double spacing = spacing_mm(road);
    const Polygons ring = offset(hull, from_part + spacing / 2, Corners::round);
    from_part += spacing;
    if (ring.empty()) return 0.0;
    paths.push_back(loop(ring.front(), road, extruder));
    return length_mm(paths.back());
  };
  const std::vector<int> printers = layer == 0 ? used : std::vector<int>{used.front()};
  for (const int extruder : printers) {
    double printed = 0;
    const int share = (config.skirts + int(printers.size()) - 1) / int(printers.size());
    for (int i = 0; i < share || printed < config.min_skirt_length_mm; ++i) {
      const double more = add_loop(extruder);
      if (more <= 0) break;
      printed += more;
    }
  }
  return paths;
}

/// One line for each extruder along the first edge of the bed (front, back, left, right) that the part leaves free.
std::vector<Path> prime_lines(const Slices& slices, const Polygons& base, const std::vector<int>& used,
                              const Config& config) {
  Polygons common = reach(config, used.front());
  for (const int extruder : used) common = intersection(common, reach(config, extruder));
  const Box<Vec2> bed = bounds_mm(common);
  const Polygons keep_out = offset(base, edge_distance_mm);
  for (const int edge : {0, 1, 2, 3}) {
    std::vector<Path> paths;
    bool fits = true;
    double inset = edge_distance_mm;
    for (const int extruder : used) {
      const Road road = roads(config, extruder, 0, slices.slabs.front()).prime;
      const double half = config.prime_line_length_mm / 2;
      const Vec2 c = bed.center();
      const std::array<Vec2, 2> ends = edge < 2 ? std::array<Vec2, 2>{Vec2{c.x - half, 0}, Vec2{c.x + half, 0}}
                                                : std::array<Vec2, 2>{Vec2{0, c.y - half}, Vec2{0, c.y + half}};
      Path path;
      path.extruder = extruder;
      path.island = -1;
      path.stretches = {{0, road}};
      for (Vec2 p : ends) {
        if (edge == 0) p.y = bed.min.y + inset;
        if (edge == 1) p.y = bed.max.y - inset;
        if (edge == 2) p.x = bed.min.x + inset;
        if (edge == 3) p.x = bed.max.x - inset;
        path.points.push_back(p);
      }
      inset += 2 * road.width_mm;
      fits = fits && within(path, common) && EdgeRows(keep_out).clipped(path.points).empty();
      paths.push_back(std::move(path));
    }
    if (fits) return paths;
  }
  return {};
}

/// Drops the paths that their nozzle cannot reach; how many.
int drop_unreachable(std::vector<Path>& paths, const Config& config) {
  return int(std::erase_if(paths, [&](const Path& path) { return !within(path, reach(config, path.extruder)); }));
}

}  // namespace

Polygons reach(const Config& config, int extruder) {
  const auto& own = config.extruders[std::size_t(extruder)].extruder_printable_area_mm;
  Ring ring;
  for (const Vec2 p : own.empty() ? config.bed_shape_mm : own) ring.push_back(to_nm(p));
  return united({ring});
}

std::vector<std::vector<Path>> bed_paths(const Slices& slices, const std::vector<int>& used, const Config& config,
                                         const Progress& progress) {
  const Polygons base = first_layer(slices);
  std::vector<std::vector<Path>> result(1);
  int dropped = 0;
  bool primed = config.skirts > 0;
  if (config.skirts > 0) {
    const int layers = std::clamp(config.skirt_height_layers, 1, int(slices.slabs.size()));
    result.resize(std::size_t(layers));
    for (int k = 0; k < layers; ++k) {
      result[std::size_t(k)] = skirt(slices, base, used, k, config);
      const int lost = drop_unreachable(result[std::size_t(k)], config);
      if (k == 0) primed = lost == 0;
      dropped += lost;
    }
  }
  if (!primed && config.prime_line_length_mm > 0) {
    std::vector<Path> lines = prime_lines(slices, base, used, config);
    if (lines.empty()) progress.warn("no edge of the bed is free for prime lines: the nozzles start unprimed");
    result[0].insert(result[0].begin(), lines.begin(), lines.end());
  }
  std::vector<Path> rim = brim(slices, base, config);
  dropped += drop_unreachable(rim, config);
  result[0].insert(result[0].end(), rim.begin(), rim.end());
  if (dropped > 0)
    progress.warn("the bed is too small for all of the skirt and brim: loops that a nozzle cannot reach are left out");
  return result;
}

}  // namespace cleancolor
