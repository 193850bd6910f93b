// Layers drawn by hand, as slices() would give them.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "slice/slices.hpp"

namespace cleancolor::test {

/// The same regions, one for each extruder, in every layer.
inline Slices drawn_slices(const std::vector<Polygons>& regions, double height_mm, double layer_mm = 0.5) {
  Slices slices;
  slices.slabs = slabs(height_mm, layer_mm, layer_mm);
  Polygons all;
  for (const Polygons& region : regions) all.insert(all.end(), region.begin(), region.end());
  slices.regions.assign(slices.slabs.size(), packed(regions));
  slices.outlines.assign(slices.slabs.size(), united(all));
  return slices;
}

inline Polygons disc(Vec2 middle, double radius_mm, int corners = 360) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double a = 2 * std::numbers::pi * i / corners;
    ring.push_back(to_nm(middle + Vec2{radius_mm * std::cos(a), radius_mm * std::sin(a)}));
  }
  return {ring};
}

}  // namespace cleancolor::test
