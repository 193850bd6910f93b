#include "toolpath/toolpaths.hpp"

#include <algorithm>

#include "base/edge_rows.hpp"
#include "toolpath/bridges.hpp"
#include "toolpath/fill.hpp"
#include "toolpath/perimeters.hpp"
#include "toolpath/roads.hpp"

namespace cleancolor {
namespace {

PerimeterOptions perimeter_options(const Config& config, int extruder) {
  return {.count = config.perimeters,
          .external_first = config.external_perimeters_first,
          .thin_walls = config.thin_walls,
          .gap_fill = config.gap_fill_enabled,
          .nozzle_diameter_mm = config.extruders[std::size_t(extruder)].nozzle_diameter_mm,
          .infill_overlap = config.infill_overlap,
          .small_perimeter_speed = config.small_perimeter_speed};
}

/// What covers or carries one extruder's region: the whole layer there, or only its own where interfaces get skins too.
Polygons cover(const Slices& slices, int layer, int extruder, const Config& config) {
  if (layer < 0 || layer >= int(slices.slabs.size())) return {};
  return config.interface_shells ? slices.regions[std::size_t(layer)][std::size_t(extruder)]
                                 : slices.outlines[std::size_t(layer)];
}

/// The part of a region that has nothing below within reach of a road.
Polygons overhang(const Slices& slices, int layer, const Polygons& region, double nozzle_mm, const Config& config) {
  if (layer == 0 || !config.overhangs) return {};
  const Polygons below = slices.outlines[std::size_t(layer) - 1];
  // Most layers lie wholly on the one below: that is cheap to see.
  if (difference(region, below).empty()) return {};
  return difference(region, offset(below, nozzle_mm / 2));
}

Coverage coverage(const Island& island, const Shell& shell, double nozzle_mm) {
  Coverage result;
  result.all_mm2 = area_mm2(polygons(island));
  const auto thinner = [&](const Path& path) {
    return path.depth == 0 && !path.closed && path.road().width_mm < nozzle_mm;
  };
  if (shell.paths.empty() && shell.fill.empty())
    result.lost_mm2 = result.all_mm2;
  else if (shell.fill.empty() && std::all_of(shell.paths.begin(), shell.paths.end(), thinner))
    result.thin_mm2 = result.all_mm2;
  return result;
}

/// Gives each path the island it starts in.
void name_islands(std::vector<Path>& paths, std::size_t first, const std::vector<Island>& islands) {
  if (islands.size() < 2) return;
  std::vector<EdgeRows> regions;
  for (const Island& island : islands) regions.emplace_back(polygons(island));
  for (std::size_t p = first; p < paths.size(); ++p)
    for (std::size_t i = 0; i < regions.size(); ++i)
      if (regions[i].contains(paths[p].start())) {
        paths[p].island = int(i);
        break;
      }
}

/// Appends the fill paths of one extruder.
class Filler {
 public:
  Filler(const Slices& slices, int layer, int extruder, const Config& config, std::vector<Path>& paths)
      : config_(config),
        slab_(slices.slabs[std::size_t(layer)]),
        roads_(roads(config, extruder, layer, slab_)),
        layer_(layer),
        paths_(paths) {
    if (layer > 0) below_ = &slices.outlines[std::size_t(layer) - 1];
  }

  void solid(const Polygons& area, FillPattern pattern, const Road& road) {
    add(area, {.pattern = pattern, .angle_rad = fill_angle_rad(config_, layer_), .spacing_mm = spacing_mm(road)}, road);
  }

  void sparse(const Polygons& area) {
    const Road& road = roads_.internal_infill;
    add(area,
        {.pattern = config_.fill_pattern,
         .density = config_.fill_density,
         .angle_rad = fill_angle_rad(config_, layer_),
         .z_mm = slab_.print_z_mm,
         .spacing_mm = spacing_mm(road),
         .max_link_mm = config_.infill_anchor_max.of(spacing_mm(road))},
        road);
  }

  /// Each gap gets lines that rest at both ends where there is such a direction.
  void bridge(const Polygons& area) {
    if (area.empty()) return;
    const Polygons below = below_ ? Polygons(*below_) : Polygons{};
    for (const Island& island : islands(area)) {
      const Polygons piece = polygons(island);
      const auto angle = below_ ? bridge_angle_rad(difference(piece, below), below) : std::nullopt;
      add(piece,
          {.angle_rad = angle.value_or(fill_angle_rad(config_, layer_)),
           .spacing_mm = spacing_mm(roads_.bridge_infill)},
          roads_.bridge_infill);
    }
  }

  const Roads& layer_roads() const { return roads_; }

 private:
  void add(const Polygons& area, const Fill& fill, const Road& road) {
    if (area.empty()) return;
    for (Path& path : filled(area, fill, road)) paths_.push_back(std::move(path));
  }

  const Config& config_;
  const Slab& slab_;
  const Roads roads_;
  int layer_;
  const PackedPolygons* below_ = nullptr;
  std::vector<Path>& paths_;
};

}  // namespace

int skin_reach(const Config& config) {
  return std::max({config.top_solid_layers, config.bottom_solid_layers, 1}) - 1;
}

LayerShells layer_shells(const Slices& slices, int layer, const Config& config) {
  const auto k = std::size_t(layer);
  LayerShells shells(slices.regions[k].size());
  for (std::size_t e = 0; e < shells.size(); ++e) {
    const Polygons region = slices.regions[k][e];
    if (region.empty()) continue;
    ExtruderShell& shell = shells[e];
    const Roads extruder_roads = roads(config, int(e), layer, slices.slabs[k]);
    const PerimeterOptions options = perimeter_options(config, int(e));
    const Polygons hanging = overhang(slices, layer, region, options.nozzle_diameter_mm, config);
    shell.islands = islands(region);
    for (std::size_t i = 0; i < shell.islands.size(); ++i) {
      Shell made = perimeters(shell.islands[i], hanging, extruder_roads, options);
      shell.coverage += coverage(shell.islands[i], made, options.nozzle_diameter_mm);
      for (Path& path : made.paths) {
        path.island = int(i);
        shell.paths.push_back(std::move(path));
      }
      shell.fill.insert(shell.fill.end(), made.fill.begin(), made.fill.end());
    }
    if (shell.fill.empty()) continue;
    const int extruder = int(e);
    shell.faces =
        faces(region, shell.fill, cover(slices, layer + 1, extruder, config),
              cover(slices, layer - 1, extruder, config), layer == 0, extruder_roads.external_perimeter.width_mm);
  }
  return shells;
}

LayerAreas layer_areas(const std::vector<LayerShells>& shells, int layer, const Config& config) {
  const int reach = skin_reach(config);
  const int first = std::max(0, layer - reach), last = std::min(int(shells.size()) - 1, layer + reach);
  LayerAreas areas(shells[std::size_t(layer)].size());
  for (std::size_t e = 0; e < areas.size(); ++e) {
    const ExtruderShell& own = shells[std::size_t(layer)][e];
    if (own.fill.empty()) continue;
    std::vector<const Faces*> all_faces;
    for (int k = first; k <= last; ++k) all_faces.push_back(&shells[std::size_t(k)][e].faces);
    const double height = layer == 0 ? config.first_layer_height_mm : config.layer_height_mm;
    const Roads r = roads(config, int(e), layer, {height, height});
    areas[e] = fill_areas(own.fill, layer, first, all_faces,
                          {.top_layers = config.top_solid_layers,
                           .bottom_layers = config.bottom_solid_layers,
                           .solid_below_area_mm2 = config.solid_infill_below_area_mm2,
                           .solid_spacing_mm = spacing_mm(r.solid_infill),
                           .all_solid = config.fill_density >= 1});
  }
  return areas;
}

std::vector<Path> layer_paths(const Slices& slices, LayerShells& shells, const LayerAreas* below,
                              const LayerAreas& areas, int layer, const Config& config) {
  Polygons sparse_below;
  if (below)
    for (const FillAreas& a : *below) sparse_below.insert(sparse_below.end(), a.sparse.begin(), a.sparse.end());

  std::vector<Path> paths;
  for (std::size_t e = 0; e < shells.size(); ++e) {
    std::vector<Path> own = std::move(shells[e].paths);
    const std::size_t shell_count = own.size();
    const FillAreas& area = areas[e];
    Filler fill(slices, layer, int(e), config, own);
    const Roads& r = fill.layer_roads();
    fill.bridge(area.bridge);
    fill.solid(area.bottom, config.bottom_fill_pattern, r.solid_infill);
    fill.solid(area.top, config.top_fill_pattern, r.top_solid_infill);
    // Solid over sparse infill hangs between its lines; a narrow strip has its neighbours to hold on to. Opening makes
    // cut corners sharp again: the result is kept within the area.
    const Polygons wide = opened(intersection(area.solid, sparse_below), 3 * r.bridge_infill.width_mm);
    const Polygons hanging = wide.empty() ? wide : intersection(wide, area.solid);
    fill.solid(hanging, FillPattern::rectilinear, r.bridge_infill);
    fill.solid(difference(area.solid, hanging), FillPattern::rectilinear, r.solid_infill);
    if (config.fill_density > 0) fill.sparse(area.sparse);
    name_islands(own, shell_count, shells[e].islands);
    for (Path& path : own) {
      path.extruder = int(e);
      paths.push_back(std::move(path));
    }
  }
  return paths;
}

}  // namespace cleancolor
