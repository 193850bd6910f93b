#include "model/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "model/options.hpp"
#include "model/thumbnails.hpp"
#include "model/view.hpp"

namespace cleancolor {
namespace {

double outline_area_mm2(std::span<const Vec2> polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return std::abs(twice) / 2;
}

void validate_machine(const Config& config) {
  const std::size_t count = config.extruders.size();
  if (count == 0 || count > max_extruders) {
    throw Error(fmt::format("nozzle_diameter: {} extruders; there must be 1 to {}", count, max_extruders));
  }
  if (config.gcode_flavor == Flavour::sailfish && count > 2) {
    throw Error(fmt::format("gcode_flavor = sailfish drives at most 2 extruders, not {}", count));
  }
  if (config.gcode_flavor == Flavour::sailfish && config.offsets_in == OffsetsIn::slicer && count > 1) {
    throw Error(
        "offsets_in = slicer: with gcode_flavor = sailfish the firmware adds the offsets of the nozzles itself; "
        "leave it at firmware");
  }
  if (outline_area_mm2(config.bed_shape_mm) < 1) {
    throw Error(
        "bed_shape: the outline encloses no area; give at least three corners, such as 0x0,200x0,200x200,0x200");
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto& area = config.extruders[i].extruder_printable_area_mm;
    if (area.empty() || outline_area_mm2(area) >= 1) continue;
    throw Error(fmt::format("extruder_printable_area: the outline of extruder {} encloses no area", i + 1));
  }
}

void validate_offsets(const Config& config) {
  const auto& extruders = config.extruders;
  if (extruders[0].nozzle_offset_mm != Vec2{}) {
    throw Error("nozzle_offset: the first must be 0,0, for nozzle 0 is where the others are seen from");
  }
  const bool together = config.idle_nozzle == IdleNozzle::same_height || config.idle_nozzle == IdleNozzle::lifted;
  for (std::size_t i = 0; together && i < extruders.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (distance(extruders[i].nozzle_offset_mm, extruders[j].nozzle_offset_mm) > 0.01) continue;
      throw Error(
          fmt::format("nozzle_offset: extruders {} and {} are at one place; choose a --printer, or say where "
                      "the nozzles are with --set nozzle_offset=0x0,33x0",
                      j + 1, i + 1));
    }
  }
}

struct Width {
  std::string_view name;
  const LengthOrShare& width;
  double layer_height_mm;
};

void validate_layers(const Config& config) {
  for (std::size_t i = 0; i < config.extruders.size(); ++i) {
    const double nozzle_mm = config.extruders[i].nozzle_diameter_mm;
    const auto refuse_above = [&](std::string_view name, double height_mm) {
      if (height_mm <= nozzle_mm) return;
      throw Error(
          fmt::format("{} = {:g} is more than nozzle_diameter = {:g} of extruder {}; at most the diameter prints", name,
                      height_mm, nozzle_mm, i + 1));
    };
    refuse_above("layer_height", config.layer_height_mm);
    refuse_above("first_layer_height", config.first_layer_height_mm);
  }
}

void validate_widths(const Config& config) {
  // The first layer has widths of its own, or else those of the other layers.
  const bool first_differs = config.first_layer_extrusion_width.value > 0;
  const double height_mm =
      first_differs ? config.layer_height_mm : std::max(config.layer_height_mm, config.first_layer_height_mm);
  const Width widths[] = {
      {"extrusion_width", config.extrusion_width, height_mm},
      {"first_layer_extrusion_width", config.first_layer_extrusion_width, config.first_layer_height_mm},
      {"perimeter_extrusion_width", config.perimeter_extrusion_width, height_mm},
      {"external_perimeter_extrusion_width", config.external_perimeter_extrusion_width, height_mm},
      {"infill_extrusion_width", config.infill_extrusion_width, height_mm},
      {"solid_infill_extrusion_width", config.solid_infill_extrusion_width, height_mm},
      {"top_infill_extrusion_width", config.top_infill_extrusion_width, height_mm},
  };
  const double nozzle_mm =
      std::ranges::min_element(config.extruders, {}, &Extruder::nozzle_diameter_mm)->nozzle_diameter_mm;
  for (const Width& w : widths) {
    if (w.width.value == 0) continue;  // from the nozzle diameter
    const double width_mm = w.width.of(w.layer_height_mm);
    if (width_mm <= w.layer_height_mm) {
      throw Error(fmt::format("{} = {:g} mm is not above the layer height of {:g} mm; a line is wider than high",
                              w.name, width_mm, w.layer_height_mm));
    }
    if (width_mm > 4 * nozzle_mm) {
      throw Error(fmt::format("{} = {:g} mm is more than 4 times nozzle_diameter = {:g}", w.name, width_mm, nozzle_mm));
    }
  }
}

bool is_colour(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return false;
  return std::ranges::all_of(text.substr(1), [](unsigned char c) { return std::isxdigit(c) != 0; });
}

void validate_materials(const Config& config) {
  for (std::size_t i = 0; i < config.extruders.size(); ++i) {
    const Extruder& e = config.extruders[i];
    for (const std::string* colour : {&e.extruder_colour, &e.filament_colour}) {
      if (colour->empty() || is_colour(*colour)) continue;
      throw Error(fmt::format("{} of extruder {}: '{}' is not a colour such as #FF8000",
                              colour == &e.extruder_colour ? "extruder_colour" : "filament_colour", i + 1, *colour));
    }
    if (e.min_fan_speed_percent > e.max_fan_speed_percent) {
      throw Error(fmt::format("min_fan_speed = {} is above max_fan_speed = {} of extruder {}", e.min_fan_speed_percent,
                              e.max_fan_speed_percent, i + 1));
    }
  }
}

}  // namespace

void validate(const Config& config) {
  validate_machine(config);
  validate_offsets(config);
  validate_layers(config);
  validate_widths(config);
  validate_materials(config);
  thumbnail_sizes(config.thumbnails);  // refuses what is none
  view_direction_deg(config.view_direction);
}

}  // namespace cleancolor
