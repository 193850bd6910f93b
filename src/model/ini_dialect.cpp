#include "model/ini_dialect.hpp"

#include <algorithm>
#include <iterator>

namespace cleancolor {
namespace {

struct Alias {
  std::string_view old_name;
  std::string_view name;
};

constexpr Alias aliases[] = {
    {"bottom_infill_pattern", "bottom_fill_pattern"},
    {"bridge_flow", "bridge_flow_ratio"},
    {"fill_gaps", "gap_fill_enabled"},
    {"gap_fill", "gap_fill_enabled"},
    {"seal_position", "seam_position"},
    {"top_infill_pattern", "top_fill_pattern"},
    {"z_lift", "retract_lift"},
};

struct Nearest {
  std::string_view option;
  std::string_view value;
  Replacement replacement;
};

constexpr Nearest nearest[] = {
    {"gcode_flavor", "reprap", {"marlin2", true}},
    {"gcode_flavor", "reprapfirmware", {"reprapfirmware", false}},
    {"gcode_flavor", "marlin", {"marlin2", false}},
    {"gcode_flavor", "repetier", {"marlin2", true}},
    {"gcode_flavor", "teacup", {"marlin2", true}},
    {"gcode_flavor", "makerware", {"sailfish", true}},
    {"gcode_flavor", "smoothie", {"marlin2", true}},
    {"gcode_flavor", "mach3", {"marlin2", true}},
    {"gcode_flavor", "machinekit", {"marlin2", true}},
    {"gcode_flavor", "no-extrusion", {"marlin2", true}},
    {"seam_position", "hidden/nearest", {"nearest", false}},
    {"brim_type", "inner_only", {"no_brim", true}},
    {"brim_type", "outer_and_inner", {"outer_only", true}},
};

// Patterns that differ from rectilinear only in the order or direction of their lines need no warning.
constexpr Nearest nearest_pattern[] = {
    {"", "monotonic", {"rectilinear", false}},
    {"", "monotoniclines", {"rectilinear", false}},
    {"", "alignedrectilinear", {"rectilinear", true}},
    {"", "zigzag", {"rectilinear", false}},
    {"", "line", {"rectilinear", false}},
    {"", "stars", {"grid", true}},
    {"", "triangles", {"grid", true}},
    {"", "cubic", {"grid", true}},
    {"", "adaptivecubic", {"grid", true}},
    {"", "supportcubic", {"grid", true}},
    {"", "lightning", {"grid", true}},
    {"", "honeycomb", {"grid", true}},
    {"", "3dhoneycomb", {"gyroid", true}},
    {"", "concentricgapfill", {"concentric", false}},
    {"", "hilbertcurve", {"rectilinear", true}},
    {"", "archimedeanchords", {"concentric", true}},
    {"", "octagramspiral", {"concentric", true}},
};

// Labels, other programs' business, and what only other features read.
constexpr std::string_view never_matter[] = {
    "bed_custom_model",
    "bed_custom_texture",
    "binary_gcode",
    "clip_multipart_objects",
    "color_change_gcode",
    "colorprint_heights",
    "default_filament_profile",
    "default_print_profile",
    "dont_support_bridges",
    "duplicate_distance",
    "end_gcode_manual",
    "extruders_count",
    "filament_load_time",
    "filament_notes",
    "filament_spool_weight",
    "filament_unload_time",
    "filament_vendor",
    "first_layer_size",
    "from_sd",
    "gcode_comments",
    "gcode_substitutions",
    "host_type",
    "idle_temperature_manual",
    "infill_anchor",
    "max_layer_height",
    "min_layer_height",
    "nozzle_high_flow",
    "notes",
    "octoprint_apikey",
    "octoprint_host",
    "output_filename_format",
    "overridable",
    "pause_print_gcode",
    "physical_printer_settings_id",
    "print_host",
    "printer_notes",
    "printer_technology",
    "printer_variant",
    "printer_vendor",
    "printhost_apikey",
    "printhost_cafile",
    "profile_vendor",
    "profile_version",
    "serial_port",
    "serial_speed",
    "shortcuts",
    "silent_mode",
    "slicing_mode",
    "template_custom_gcode",
    "thumbnails_format",
    "thumbnails_with_bed",
    "threads",
    "variable_layer_height",
    // limits and conveniences that our prints keep anyway
    "max_print_speed",
    "machine_min_extruding_rate",
    "machine_min_travel_rate",
    // an outline that is simplified more finely than by nothing at all
    "resolution",
};

constexpr std::string_view never_matter_endings[] = {"_settings_id", "_settings_modified"};
constexpr std::string_view never_matter_beginnings[] = {"compatible_p", "inherits",           "min_bead_",
                                                        "min_feature_", "wall_distribution_", "wall_transition_"};

// Keys that begin so are read only where the switch is on.
struct Switch {
  std::string_view beginning;
  std::string_view key;
};

constexpr Switch switches[] = {
    {"avoid_crossing_perimeters_", "avoid_crossing_perimeters"},
    {"cooling_tube_", "single_extruder_multi_material"},
    {"dynamic_overhang", "enable_dynamic_overhang_speeds"},
    {"overhang_speed_", "enable_dynamic_overhang_speeds"},
    {"extra_loading_move", "single_extruder_multi_material"},
    {"extruder_clearance_", "complete_objects"},
    {"filament_cooling_", "single_extruder_multi_material"},
    {"filament_loading_", "single_extruder_multi_material"},
    {"filament_minimal_purge", "wipe_tower"},
    {"filament_multitool_ramming_", "filament_multitool_ramming"},
    {"filament_purge_multiplier", "wipe_tower"},
    {"filament_ramming_", "single_extruder_multi_material"},
    {"filament_stamping_", "single_extruder_multi_material"},
    {"filament_toolchange_", "single_extruder_multi_material"},
    {"filament_unloading_", "single_extruder_multi_material"},
    {"first_layer_acceleration_over_raft", "raft_layers"},
    {"first_layer_speed_over_raft", "raft_layers"},
    {"fuzzy_skin_", "fuzzy_skin"},
    {"high_current_", "single_extruder_multi_material"},
    {"idle_temperature", "ooze_prevention"},
    {"interlocking_", "interlocking_beam"},
    {"ironing_", "ironing"},
    {"multimaterial_purging", "wipe_tower"},
    {"parking_pos_", "single_extruder_multi_material"},
    {"raft_", "raft_layers"},
    {"retract_before_wipe", "wipe"},
    {"single_extruder_multi_material_", "single_extruder_multi_material"},
    {"standby_temperature_", "ooze_prevention"},
    {"support_material_", "support_material"},
    {"support_tree_", "support_material"},
    {"travel_slope", "travel_ramping_lift"},
    {"travel_max_lift", "travel_ramping_lift"},
    {"travel_lift_before_", "travel_ramping_lift"},
    {"wipe_tower_", "wipe_tower"},
    {"wiping_volumes_", "wipe_tower"},
};

// Values by which they say what is done here in any case. Zero, nothing and "disabled" need no entry.
struct Neutral {
  std::string_view key;
  std::string_view value;
};

constexpr Neutral neutral[] = {
    {"arc_fitting", "disabled"},
    {"autoemit_temperature_commands", "1"},
    {"ensure_vertical_shell_thickness", "partial"},
    {"extrusion_axis", "E"},
    {"infill_every_layers", "1"},
    {"infill_extruder", "1"},
    {"machine_limits_usage", "time_estimate_only"},
    {"machine_limits_usage", "ignore"},
    {"perimeter_extruder", "1"},
    {"perimeter_generator", "classic"},
    {"prefer_clockwise_movements", "0"},
    {"solid_infill_extruder", "1"},
    {"support_material_extruder", "1"},
    {"top_one_perimeter_type", "none"},
};

bool is_off(std::string_view value) {
  constexpr std::string_view off[] = {"", "0", "0%", "0.0", "0x0", "nil", "none", "disabled", "\"\""};
  while (!value.empty()) {
    const std::size_t end = std::min(value.find_first_of(",;"), value.size());
    if (std::ranges::find(off, value.substr(0, end)) == std::end(off)) return false;
    value.remove_prefix(std::min(end + 1, value.size()));
  }
  return true;
}

template <class Range>
bool contains(const Range& range, std::string_view text) {
  return std::ranges::find(range, text) != std::end(range);
}

}  // namespace

std::string_view current_name(std::string_view key) {
  const auto found = std::ranges::find(aliases, key, &Alias::old_name);
  return found == std::end(aliases) ? key : found->name;
}

Replacement nearest_value(std::string_view option, std::string_view value) {
  const auto same_value = [&](const Nearest& n) {
    return n.value == value && (n.option.empty() || n.option == option);
  };
  if (option.ends_with("fill_pattern")) {
    const auto found = std::ranges::find_if(nearest_pattern, same_value);
    return found == std::end(nearest_pattern) ? Replacement{} : found->replacement;
  }
  const auto found = std::ranges::find_if(nearest, same_value);
  return found == std::end(nearest) ? Replacement{} : found->replacement;
}

bool matters(std::string_view key, std::string_view value,
             const std::function<std::string_view(std::string_view)>& value_of) {
  if (is_off(value) || contains(never_matter, key)) return false;
  const auto ends = [key](std::string_view ending) { return key.ends_with(ending); };
  const auto begins = [key](std::string_view beginning) { return key.starts_with(beginning); };
  if (std::ranges::any_of(never_matter_endings, ends) || std::ranges::any_of(never_matter_beginnings, begins)) {
    return false;
  }
  const auto is_neutral = [&](const Neutral& n) { return n.key == key && n.value == value; };
  if (std::ranges::any_of(neutral, is_neutral)) return false;
  return std::ranges::none_of(switches, [&](const Switch& s) {
    return key != s.key && key.starts_with(s.beginning) && is_off(value_of(s.key));
  });
}

}  // namespace cleancolor
