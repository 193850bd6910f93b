// tests/toolpath/regions.hpp
//
// Regions and roads of round numbers for the tests of toolpaths.
#pragma once

#include "toolpath/perimeters.hpp"
#include "toolpath/roads.hpp"
#include "toolpath/toolpaths.hpp"

namespace cleancolor {

/// 0.4 mm wide roads everywhere, 0.3 mm layers, plain options; one extruder with a 0.4 mm nozzle.
inline Config plain_config(int extruders = 1) {
  Config config;
  config.layer_height_mm = config.first_layer_height_mm = 0.3;
  config.extrusion_width = config.first_layer_extrusion_width = {0.4, false};
  config.perimeters = 2;
  config.fill_pattern = FillPattern::rectilinear;
  config.thin_walls = config.gap_fill_enabled = false;
  config.solid_infill_below_area_mm2 = 0;
  config.extruders.resize(std::size_t(extruders));
  return config;
}

inline Roads plain_roads() {
  return roads(plain_config(), 0, 1, {0.6, 0.3});
}

inline Island square_island(double side) {
  return {rectangle({0, 0}, {side, side}).front(), {}};
}

/// Squares with square holes, in the middle of each other: side lengths from the outside in.
inline Polygons nested_squares(const std::vector<double>& sides) {
  Polygons region;
  const double outer = sides.front();
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const double a = (outer - sides[i]) / 2;
    const Polygons square = rectangle({a, a}, {a + sides[i], a + sides[i]});
    region = i % 2 == 0 ? united(region, square) : difference(region, square);
  }
  return region;
}

inline double total_length_mm(const std::vector<Path>& paths) {
  double sum = 0;
  for (const Path& path : paths) sum += length_mm(path);
  return sum;
}

inline double total_volume_mm3(const std::vector<Path>& paths) {
  double sum = 0;
  for (const Path& path : paths) sum += volume_mm3(path);
  return sum;
}

/// Slices made by hand: the same regions in as many layers as given.
inline Slices slices_of(const std::vector<std::vector<Polygons>>& regions, double height_mm = 0.3) {
  Slices slices;
  for (std::size_t k = 0; k < regions.size(); ++k) {
    slices.slabs.push_back({height_mm * double(k + 1), height_mm});
    slices.regions.push_back(packed(regions[k]));
    Polygons all;
    for (const Polygons& region : regions[k]) all = united(all, region);
    slices.outlines.push_back(all);
  }
  return slices;
}

/// All areas of one layer, with all the layers it looks at.
inline LayerAreas areas_of(const Slices& slices, int layer, const Config& config) {
  std::vector<LayerShells> shells;
  for (int k = 0; k < int(slices.slabs.size()); ++k) shells.push_back(layer_shells(slices, k, config));
  return layer_areas(shells, layer, config);
}

}  // namespace cleancolor
