// What the relatives of PrusaSlicer call its options: OrcaSlicer, BambuStudio, SuperSlicer.

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "model/ini.hpp"
#include "model/options.hpp"
#include "model/text_scan.hpp"

namespace cleancolor {
namespace {

struct OrcaName {
  std::string_view orca;
  std::string_view ours;
};

// Of the printer, and of materials that say it anew: "filament_retraction_length".
constexpr std::array<OrcaName, 9> of_extruders = {{
    {"retraction_length", "retract_length"},
    {"retraction_speed", "retract_speed"},
    {"deretraction_speed", "deretract_speed"},
    {"retraction_minimum_travel", "retract_before_travel"},
    {"retract_when_changing_layer", "retract_layer_change"},
    {"z_hop", "retract_lift"},
    {"retract_length_toolchange", "retract_length_toolchange"},
    {"retract_restart_extra", "retract_restart_extra"},
    {"retract_restart_extra_toolchange", "retract_restart_extra_toolchange"},
}};

constexpr std::array<OrcaName, 59> names = {{
    {"nozzle_diameter", "nozzle_diameter"},
    {"extruder_offset", "extruder_offset"},
    {"printable_area", "bed_shape"},
    {"printable_height", "max_print_height"},
    {"gcode_flavor", "gcode_flavor"},
    {"use_relative_e_distances", "use_relative_e_distances"},
    {"use_firmware_retraction", "use_firmware_retraction"},
    {"single_extruder_multi_material", "single_extruder_multi_material"},
    {"machine_max_speed_x", "machine_max_feedrate_x"},
    {"machine_max_speed_y", "machine_max_feedrate_y"},
    {"machine_max_speed_z", "machine_max_feedrate_z"},
    {"machine_max_speed_e", "machine_max_feedrate_e"},
    {"machine_max_acceleration_x", "machine_max_acceleration_x"},
    {"machine_max_acceleration_y", "machine_max_acceleration_y"},
    {"machine_max_acceleration_z", "machine_max_acceleration_z"},
    {"machine_max_acceleration_e", "machine_max_acceleration_e"},
    {"machine_max_acceleration_extruding", "machine_max_acceleration_extruding"},
    {"machine_max_acceleration_retracting", "machine_max_acceleration_retracting"},
    {"machine_max_acceleration_travel", "machine_max_acceleration_travel"},
    {"machine_max_jerk_x", "machine_max_jerk_x"},
    {"machine_max_jerk_y", "machine_max_jerk_y"},
    {"machine_max_jerk_z", "machine_max_jerk_z"},
    {"machine_max_jerk_e", "machine_max_jerk_e"},
    {"filament_diameter", "filament_diameter"},
    {"filament_density", "filament_density"},
    {"filament_flow_ratio", "extrusion_multiplier"},
    {"filament_max_volumetric_speed", "filament_max_volumetric_speed"},
    {"nozzle_temperature", "temperature"},
    {"nozzle_temperature_initial_layer", "first_layer_temperature"},
    {"layer_height", "layer_height"},
    {"initial_layer_print_height", "first_layer_height"},
    {"is_infill_first", "infill_first"},
    {"spiral_mode", "spiral_vase"},
    {"seam_gap", "seam_gap_distance"},
    {"slice_closing_radius", "slice_closing_radius"},
    {"line_width", "extrusion_width"},
    {"initial_layer_line_width", "first_layer_extrusion_width"},
    {"outer_wall_line_width", "external_perimeter_extrusion_width"},
    {"inner_wall_line_width", "perimeter_extrusion_width"},
    {"sparse_infill_line_width", "infill_extrusion_width"},
    {"internal_solid_infill_line_width", "solid_infill_extrusion_width"},
    {"top_surface_line_width", "top_infill_extrusion_width"},
    {"outer_wall_speed", "external_perimeter_speed"},
    {"inner_wall_speed", "perimeter_speed"},
    {"sparse_infill_speed", "infill_speed"},
    {"internal_solid_infill_speed", "solid_infill_speed"},
    {"top_surface_speed", "top_solid_infill_speed"},
    {"gap_infill_speed", "gap_fill_speed"},
    {"bridge_speed", "bridge_speed"},
    {"initial_layer_speed", "first_layer_speed"},
    {"travel_speed", "travel_speed"},
    {"travel_speed_z", "travel_speed_z"},
    {"default_acceleration", "default_acceleration"},
    {"retract_lift_above", "retract_lift_above"},
    {"retract_lift_below", "retract_lift_below"},
    {"retract_lift_enforce", "retract_lift_top"},
    {"wipe", "wipe"},
    {"ooze_prevention", "ooze_prevention"},
    {"skirt_height", "skirt_height"},
}};

// What one of their options says by its value.
struct OrcaValue {
  std::string_view orca, value;
  std::string_view ours, text;
};
constexpr std::array<OrcaValue, 5> values = {{
    {"wall_sequence", "outer wall/inner wall", "external_perimeters_first", "1"},
    {"wall_sequence", "inner-outer-inner wall", "wall_sequence", "inner-outer-inner wall"},
    {"wall_infill_order", "outer wall/inner wall/infill", "external_perimeters_first", "1"},
    {"wall_infill_order", "infill/inner wall/outer wall", "infill_first", "1"},
    {"wall_infill_order", "infill/outer wall/inner wall", "infill_first", "1"},
}};

// SuperSlicer's own.
constexpr std::array<OrcaName, 2> of_prints = {{
    {"print_retract_length", "retract_length"},
    {"print_retract_lift", "retract_lift"},
}};
constexpr std::array<std::string_view, 3> kept = {"complete_objects", "external_perimeters_first", "use_volumetric_e"};

bool is_of_nozzle(std::string_view key) {
  return key.ends_with("extrusion_width") || key == "first_layer_height";
}

/// Widths in percent are such of the nozzle there, and of the layer height here.
std::string width_mm(std::string_view value, double nozzle_mm) {
  const auto percent = number<double>(value.substr(0, value.find('%')));
  return value.ends_with('%') && percent ? fmt::format("{:g}", *percent / 100 * nozzle_mm) : std::string(value);
}

double nozzle_mm(const std::vector<IniEntry>& entries) {
  double mm = 0;
  for (const IniEntry& entry : entries)
    if (entry.key == "nozzle_diameter")
      mm = number<double>(std::string_view(entry.value).substr(0, entry.value.find(','))).value_or(0);
  return mm;
}

template <class Names>
std::string_view ours_of(const Names& all, std::string_view orca) {
  const auto found = std::ranges::find(all, orca, &OrcaName::orca);
  return found == all.end() ? std::string_view{} : found->ours;
}

}  // namespace

std::vector<IniEntry> from_orca(const std::vector<IniEntry>& entries) {
  constexpr std::string_view of_material = "filament_";
  std::vector<IniEntry> result;
  const double nozzle = nozzle_mm(entries);
  const auto put = [&](std::string_view key, std::string_view value, const IniEntry& from) {
    result.push_back({std::string(key), is_of_nozzle(key) ? width_mm(value, nozzle) : std::string(value), from.line});
  };
  for (const IniEntry& entry : entries) {
    const std::string_view key = entry.key, value = entry.value;
    const auto said =
        std::ranges::find_if(values, [&](const OrcaValue& v) { return v.orca == key && v.value == value; });
    if (said != values.end()) {
      put(said->ours, said->text, entry);
    } else if (const std::string_view ours = ours_of(names, key); !ours.empty()) {
      put(ours, value, entry);
    } else if (const std::string_view of_extruder = ours_of(of_extruders, key); !of_extruder.empty()) {
      put(of_extruder, value, entry);
    } else if (key.starts_with(of_material)) {
      const std::string_view own = ours_of(of_extruders, key.substr(of_material.size()));
      if (!own.empty()) put(std::string(of_material) + std::string(own), value, entry);
    }
  }
  return result;
}

std::vector<IniEntry> from_superslicer(const std::vector<IniEntry>& entries) {
  constexpr std::string_view of_material = "filament_";
  const double nozzle = nozzle_mm(entries);
  std::vector<IniEntry> result;
  for (const IniEntry& entry : entries) {
    const std::string_view key = entry.key;
    const std::string_view bare = key.starts_with(of_material) ? key.substr(of_material.size()) : key;
    const bool known = std::ranges::find(names, key, &OrcaName::ours) != names.end() ||
                       std::ranges::find(of_extruders, bare, &OrcaName::ours) != of_extruders.end() ||
                       std::ranges::find(kept, key) != kept.end();
    const Option* option = find_option(key);
    const bool is_share = entry.value.ends_with('%') && option != nullptr && option->kind() == OptionKind::number;
    if (known && is_of_nozzle(key)) {
      result.push_back({entry.key, width_mm(entry.value, nozzle), entry.line});
    } else if (known && !is_share) {  // a share of what is not known here: ours stays
      result.push_back(entry);
    }
  }
  for (const IniEntry& entry : entries)
    if (const std::string_view ours = ours_of(of_prints, entry.key); !ours.empty() && !entry.value.starts_with('-'))
      result.push_back({std::string(ours), entry.value, entry.line});
  return result;
}

}  // namespace cleancolor
