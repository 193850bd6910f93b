#include "model/reach.hpp"

#include <algorithm>
#include <span>

namespace cleancolor {
namespace {

Polygons region(std::span<const Vec2> points_mm) {
  Ring ring;
  for (const Vec2 p : points_mm) ring.push_back(to_nm(p));
  if (area_mm2(ring) < 0) std::ranges::reverse(ring);
  return united(Polygons{ring});
}

}  // namespace

Polygons bed_region(const Config& config) {
  return region(config.bed_shape_mm);
}

Polygons reach(const Config& config, int extruder) {
  const auto& own = config.extruders[std::size_t(extruder)].extruder_printable_area_mm;
  return own.empty() ? bed_region(config) : intersection(bed_region(config), region(own));
}

}  // namespace cleancolor
