#include "toolpath/roads.hpp"

#include <cmath>
#include <numbers>

namespace cleancolor {
namespace {

// Roads that hang in the air shrink while they cool; between two of them PrusaSlicer leaves this much.
constexpr double bridge_gap_mm = 0.05;

double width_mm(const Config& config, int extruder, int layer_index, double height_mm, const LengthOrShare& own) {
  const double nozzle = config.extruders[std::size_t(extruder)].nozzle_diameter_mm;
  const LengthOrShare& first = config.first_layer_extrusion_width;
  if (layer_index == 0 && first.value > 0) return first.of(height_mm);
  if (own.value > 0) return own.of(height_mm);
  if (config.extrusion_width.value > 0) return config.extrusion_width.of(height_mm);
  return 1.125 * nozzle;
}

/// A bridge: a string as thick as the nozzle, or flat as the layer where thick_bridges is off.
Road bridge(const Config& config, Role role, double nozzle_mm, const Road& flat) {
  Road road = flat;
  road.role = role;
  if (config.thick_bridges) {
    road.width_mm = road.height_mm = nozzle_mm * std::sqrt(config.bridge_flow_ratio);
    road.area_mm2 = std::numbers::pi / 4 * road.width_mm * road.width_mm;
  } else {
    road.area_mm2 *= config.bridge_flow_ratio;
  }
  return road;
}

}  // namespace

double road_spacing_mm(double width_mm, double height_mm) {
  return width_mm - height_mm * (1 - std::numbers::pi / 4);
}

double road_area_mm2(double width_mm, double height_mm) {
  return height_mm * road_spacing_mm(width_mm, height_mm);
}

double spacing_mm(const Road& road) {
  const bool hangs = road.width_mm == road.height_mm;
  return hangs ? road.width_mm + bridge_gap_mm : road_spacing_mm(road.width_mm, road.height_mm);
}

Road with_width(Road road, double width_mm) {
  // Below this width the formula for the cross-section has no flat part left; a thinner line is a smaller disc.
  road.width_mm = width_mm;
  road.area_mm2 =
      width_mm > road.height_mm ? road_area_mm2(width_mm, road.height_mm) : std::numbers::pi / 4 * width_mm * width_mm;
  return road;
}

Roads roads(const Config& config, int extruder, int layer_index, const Slab& slab) {
  const double nozzle = config.extruders[std::size_t(extruder)].nozzle_diameter_mm;
  const auto road = [&](Role role, const LengthOrShare& width, double speed_mm_s) {
    const double w = width_mm(config, extruder, layer_index, slab.height_mm, width);
    if (layer_index == 0) speed_mm_s = config.first_layer_speed.of(speed_mm_s);
    return Road{role, w, slab.height_mm, road_area_mm2(w, slab.height_mm), speed_mm_s};
  };
  const double solid_speed = config.solid_infill_speed.of(config.infill_speed_mm_s);
  Roads r;
  r.external_perimeter = road(Role::external_perimeter, config.external_perimeter_extrusion_width,
                              config.external_perimeter_speed.of(config.perimeter_speed_mm_s));
  r.perimeter = road(Role::perimeter, config.perimeter_extrusion_width, config.perimeter_speed_mm_s);
  r.internal_infill = road(Role::internal_infill, config.infill_extrusion_width, config.infill_speed_mm_s);
  r.solid_infill = road(Role::solid_infill, config.solid_infill_extrusion_width, solid_speed);
  r.top_solid_infill =
      road(Role::top_solid_infill, config.top_infill_extrusion_width, config.top_solid_infill_speed.of(solid_speed));
  r.gap_fill = road(Role::gap_fill, config.perimeter_extrusion_width, config.gap_fill_speed_mm_s);
  r.skirt_brim = road(Role::skirt_brim, config.perimeter_extrusion_width, config.perimeter_speed_mm_s);
  r.prime = road(Role::prime, config.perimeter_extrusion_width, config.perimeter_speed_mm_s);
  const Road hanging = road(Role::bridge_infill, config.solid_infill_extrusion_width, config.bridge_speed_mm_s);
  r.bridge_infill = bridge(config, Role::bridge_infill, nozzle, hanging);
  r.overhang_perimeter = bridge(config, Role::overhang_perimeter, nozzle, r.perimeter);
  r.overhang_perimeter.speed_mm_s = hanging.speed_mm_s;
  return r;
}

}  // namespace cleancolor
