#include "model/option_table.hpp"

namespace cleancolor {
namespace {

using C = Config;
using E = Extruder;

constexpr OptionGroup printer = OptionGroup::printer;
constexpr OptionGroup material = OptionGroup::material;
constexpr OptionGroup print = OptionGroup::print;

constexpr MachineAxis speed_x{&C::machine_max_feedrate_mm_s, &Vec3::x};
constexpr MachineAxis speed_y{&C::machine_max_feedrate_mm_s, &Vec3::y};
constexpr MachineAxis speed_z{&C::machine_max_feedrate_mm_s, &Vec3::z};
constexpr MachineAxis acceleration_x{&C::machine_max_acceleration_mm_s2, &Vec3::x};
constexpr MachineAxis acceleration_y{&C::machine_max_acceleration_mm_s2, &Vec3::y};
constexpr MachineAxis acceleration_z{&C::machine_max_acceleration_mm_s2, &Vec3::z};
constexpr MachineAxis jerk_x{&C::machine_max_jerk_mm_s, &Vec3::x};
constexpr MachineAxis jerk_y{&C::machine_max_jerk_mm_s, &Vec3::y};
constexpr MachineAxis jerk_z{&C::machine_max_jerk_mm_s, &Vec3::z};

// Names and meanings are PrusaSlicer's; those it does not know are nozzle_offset, offsets_in, idle_nozzle, audit_only,
// extruder_printable_area, heater_off_after_last_use, filament_translucency, prime_line_length and those of the rampart
// (ooze_shield_dist is Cura's) and the planner.
// clang-format off
constexpr Option table[] = {
  {"printer_model", printer, "Machine", &C::printer_model, "", 0, 0, "name of the machine; a label only"},
  {"bed_shape", printer, "Machine", &C::bed_shape_mm, "mm", -1000, 1000, "outline of where parts can stand, in coordinates of the model, counterclockwise; nozzles on one carriage are taken to reach all of it"},
  {"max_print_height", printer, "Machine", &C::max_print_height_mm, "mm", 1, 2000, "no part may be higher"},
  {"nozzle_diameter", printer, "Machine", &E::nozzle_diameter_mm, "mm", 0.05, 5, "opening of the nozzle; the number of values is the number of extruders"},
  {"nozzle_offset", printer, "Machine", &E::nozzle_offset_mm, "mm", -1000, 1000, "where the nozzle is, seen from nozzle 0, which is at 0,0"},
  {"offsets_in", printer, "Machine", &C::offsets_in, "", 0, 0, "who makes up for nozzle_offset: the slicer subtracts it from X and Y, or the firmware knows it"},
  {"idle_nozzle", printer, "Machine", &C::idle_nozzle, "", 0, 0, "where nozzles are that do not print: hovering at the same height, lifted, parked beside the bed, or docked in a rack"},
  {"extruder_printable_area", printer, "Machine", &E::extruder_printable_area_mm, "mm", -1000, 1000, "outline of what this nozzle reaches of the bed, in coordinates of the model; empty: all of bed_shape, so say it here where the carriage does not travel further than the bed by nozzle_offset"},
  {"extruder_colour", printer, "Machine", &E::extruder_colour, "", 0, 0, "#RRGGBB, for pictures; empty: the filament's"},
  {"audit_only", printer, "Machine", &C::audit_only, "", 0, 0, "the profile is good for auditing and re-planning G-code, but not complete enough to print with"},

  {"gcode_flavor", printer, "G-code", &C::gcode_flavor, "", 0, 0, "firmware that runs the file"},
  {"use_relative_e_distances", printer, "G-code", &C::use_relative_e_distances, "", 0, 0, "amounts of filament count from the last move (M83) instead of from the last G92 (M82)"},
  {"remaining_times", printer, "G-code", &C::remaining_times, "", 0, 0, "write progress and remaining time (M73)"},
  {"thumbnails", printer, "G-code", &C::thumbnails, "", 0, 0, "sizes in pixels of the pictures in the file, such as 16x16,220x124; empty: none"},
  {"heater_off_after_last_use", printer, "G-code", &C::heater_off_after_last_use, "", 0, 0, "switch off the heater of a nozzle that is not needed any more"},
  {"start_gcode", printer, "G-code", &C::start_gcode, "", 0, 0, "before everything else; where it sets temperatures, nothing else does"},
  {"end_gcode", printer, "G-code", &C::end_gcode, "", 0, 0, "after everything else"},
  {"before_layer_gcode", printer, "G-code", &C::before_layer_gcode, "", 0, 0, "before the move to the next layer"},
  {"layer_gcode", printer, "G-code", &C::layer_gcode, "", 0, 0, "after the move to the next layer"},
  {"toolchange_gcode", printer, "G-code", &C::toolchange_gcode, "", 0, 0, "at every change of extruder; where it does not select the tool itself, the command follows"},

  {"machine_max_feedrate_x", printer, "Machine limits", speed_x, "mm/s", 1, 10000, "highest speed along X; limits serve the estimate of time"},
  {"machine_max_feedrate_y", printer, "Machine limits", speed_y, "mm/s", 1, 10000, "highest speed along Y"},
  {"machine_max_feedrate_z", printer, "Machine limits", speed_z, "mm/s", 0.1, 10000, "highest speed along Z"},
  {"machine_max_feedrate_e", printer, "Machine limits", &C::machine_max_feedrate_e_mm_s, "mm/s", 0.1, 10000, "highest speed of the filament"},
  {"machine_max_acceleration_x", printer, "Machine limits", acceleration_x, "mm/s2", 1, 100000, "highest acceleration along X"},
  {"machine_max_acceleration_y", printer, "Machine limits", acceleration_y, "mm/s2", 1, 100000, "highest acceleration along Y"},
  {"machine_max_acceleration_z", printer, "Machine limits", acceleration_z, "mm/s2", 1, 100000, "highest acceleration along Z"},
  {"machine_max_acceleration_e", printer, "Machine limits", &C::machine_max_acceleration_e_mm_s2, "mm/s2", 1, 100000, "highest acceleration of the filament"},
  {"machine_max_acceleration_extruding", printer, "Machine limits", &C::machine_max_acceleration_extruding_mm_s2, "mm/s2", 0, 100000, "acceleration of printing moves; 0: that of the axes"},
  {"machine_max_acceleration_retracting", printer, "Machine limits", &C::machine_max_acceleration_retracting_mm_s2, "mm/s2", 0, 100000, "acceleration of retractions; 0: that of the axis"},
  {"machine_max_acceleration_travel", printer, "Machine limits", &C::machine_max_acceleration_travel_mm_s2, "mm/s2", 0, 100000, "acceleration of travel; 0: that of the axes"},
  {"machine_max_jerk_x", printer, "Machine limits", jerk_x, "mm/s", 0, 1000, "change of speed along X that needs no braking"},
  {"machine_max_jerk_y", printer, "Machine limits", jerk_y, "mm/s", 0, 1000, "change of speed along Y that needs no braking"},
  {"machine_max_jerk_z", printer, "Machine limits", jerk_z, "mm/s", 0, 1000, "change of speed along Z that needs no braking"},
  {"machine_max_jerk_e", printer, "Machine limits", &C::machine_max_jerk_e_mm_s, "mm/s", 0, 1000, "change of the filament's speed that needs no braking"},

  {"retract_length", printer, "Retraction", &E::retract_length_mm, "mm", 0, 200, "filament drawn back before travel"},
  {"retract_speed", printer, "Retraction", &E::retract_speed_mm_s, "mm/s", 0.1, 1000, "speed of drawing back"},
  {"deretract_speed", printer, "Retraction", &E::deretract_speed_mm_s, "mm/s", 0, 1000, "speed of pushing forward again; 0: retract_speed"},
  {"retract_restart_extra", printer, "Retraction", &E::retract_restart_extra_mm, "mm", -100, 100, "filament pushed in addition after travel"},
  {"retract_before_travel", printer, "Retraction", &E::retract_before_travel_mm, "mm", 0, 1000, "shorter travel needs no retraction"},
  {"retract_layer_change", printer, "Retraction", &E::retract_layer_change, "", 0, 0, "retract at every change of layer"},
  {"retract_lift", printer, "Retraction", &E::retract_lift_mm, "mm", 0, 100, "raise the nozzle while it is retracted"},
  {"retract_length_toolchange", printer, "Retraction", &E::retract_length_toolchange_mm, "mm", 0, 200, "filament drawn back before another extruder takes over"},
  {"retract_restart_extra_toolchange", printer, "Retraction", &E::retract_restart_extra_toolchange_mm, "mm", -100, 100, "filament pushed in addition when the extruder takes over again"},

  {"filament_type", material, "Filament", &E::filament_type, "", 0, 0, "name of the plastic; a label only"},
  {"filament_colour", material, "Filament", &E::filament_colour, "", 0, 0, "#RRGGBB, for pictures"},
  {"filament_diameter", material, "Filament", &E::filament_diameter_mm, "mm", 0.5, 10, "diameter of the filament"},
  {"filament_density", material, "Filament", &E::filament_density_g_cm3, "g/cm3", 0, 30, "for the weight in the summary"},
  {"filament_cost", material, "Filament", &E::filament_cost_per_kg, "money/kg", 0, 1e6, "for the cost in the summary"},
  {"extrusion_multiplier", material, "Filament", &E::extrusion_multiplier, "", 0.1, 3, "scales the amount of filament"},
  {"filament_max_volumetric_speed", material, "Filament", &E::filament_max_volumetric_speed_mm3_s, "mm3/s", 0, 1000, "most that this filament melts; 0: no limit"},
  {"filament_translucency", material, "Filament", &E::filament_translucency_mm, "mm", 0, 20, "depth below the surface that lets 1/e of the light through: the planner then minds other colours inside as well; 0: opaque"},

  {"temperature", material, "Temperatures", &E::temperature_c, "C", 0, 500, "nozzle, from the second layer on"},
  {"first_layer_temperature", material, "Temperatures", &E::first_layer_temperature_c, "C", 0, 500, "nozzle, on the first layer"},
  {"bed_temperature", material, "Temperatures", &E::bed_temperature_c, "C", 0, 300, "bed, from the second layer on; that of the first used extruder holds"},
  {"first_layer_bed_temperature", material, "Temperatures", &E::first_layer_bed_temperature_c, "C", 0, 300, "bed, on the first layer"},

  {"cooling", material, "Cooling", &E::cooling, "", 0, 0, "let layer time decide on fan speed and slow down short layers"},
  {"fan_always_on", material, "Cooling", &E::fan_always_on, "", 0, 0, "fan at least at min_fan_speed on every layer"},
  {"min_fan_speed", material, "Cooling", &E::min_fan_speed_percent, "% of full speed", 0, 100, "fan speed for layers that take long"},
  {"max_fan_speed", material, "Cooling", &E::max_fan_speed_percent, "% of full speed", 0, 100, "fan speed for layers of slowdown_below_layer_time"},
  {"bridge_fan_speed", material, "Cooling", &E::bridge_fan_speed_percent, "% of full speed", 0, 100, "fan speed for bridges"},
  {"disable_fan_first_layers", material, "Cooling", &E::disable_fan_first_layers, "layers", 0, 1000, "no fan on this many layers"},
  {"fan_below_layer_time", material, "Cooling", &E::fan_below_layer_time_s, "s", 0, 1000, "shorter layers are fanned"},
  {"slowdown_below_layer_time", material, "Cooling", &E::slowdown_below_layer_time_s, "s", 0, 1000, "shorter layers are printed more slowly"},
  {"min_print_speed", material, "Cooling", &E::min_print_speed_mm_s, "mm/s", 0.1, 1000, "but never more slowly than this"},

  {"start_filament_gcode", material, "G-code of the material", &E::start_filament_gcode, "", 0, 0, "after start_gcode for the first extruder, and after every change to this extruder"},
  {"end_filament_gcode", material, "G-code of the material", &E::end_filament_gcode, "", 0, 0, "before every change to another extruder and before end_gcode"},

  {"layer_height", print, "Layers and walls", &C::layer_height_mm, "mm", 0.01, 5, "height of a layer"},
  {"first_layer_height", print, "Layers and walls", &C::first_layer_height_mm, "mm", 0.01, 5, "height of the first layer"},
  {"perimeters", print, "Layers and walls", &C::perimeters, "", 0, 1000, "loops around every region"},
  {"external_perimeters_first", print, "Layers and walls", &C::external_perimeters_first, "", 0, 0, "print loops from the outside to the inside"},
  {"thin_walls", print, "Layers and walls", &C::thin_walls, "", 0, 0, "print walls that are too thin for two loops as one line of variable width"},
  {"gap_fill_enabled", print, "Layers and walls", &C::gap_fill_enabled, "", 0, 0, "fill gaps between loops with lines of variable width"},
  {"overhangs", print, "Layers and walls", &C::overhangs, "", 0, 0, "print loops as bridges where they hang over"},
  {"top_solid_layers", print, "Layers and walls", &C::top_solid_layers, "layers", 0, 1000, "solid layers below every top surface"},
  {"bottom_solid_layers", print, "Layers and walls", &C::bottom_solid_layers, "layers", 0, 1000, "solid layers above every bottom surface"},
  {"interface_shells", print, "Layers and walls", &C::interface_shells, "", 0, 0, "solid layers also where another extruder's plastic covers the surface"},
  {"solid_infill_below_area", print, "Layers and walls", &C::solid_infill_below_area_mm2, "mm2", 0, 1e6, "smaller regions are solid"},
  {"seam_position", print, "Layers and walls", &C::seam_position, "", 0, 0, "where loops begin; hidden: where they can be seen least (plain planner: aligned)"},
  {"join_perimeters", print, "Layers and walls", &C::join_perimeters, "", 0, 0, "outer loops begin and end inside the part: the loop within goes over into them without a stop, and where there is none a short stroke leads in and out (planner clean, inner loops first; instead of seam_gap_distance)"},
  {"seam_gap_distance", print, "Layers and walls", &C::seam_gap_distance, "mm or % of nozzle_diameter", 0, 10, "gap left between the ends of a loop"},
  {"slice_closing_radius", print, "Layers and walls", &C::slice_closing_radius_mm, "mm", 0, 5, "cracks up to twice this wide are closed"},
  {"xy_size_compensation", print, "Layers and walls", &C::xy_size_compensation_mm, "mm", -10, 10, "outlines grow by this much"},
  {"elefant_foot_compensation", print, "Layers and walls", &C::elefant_foot_compensation_mm, "mm", 0, 10, "outlines of the first layer shrink by this much"},

  {"fill_density", print, "Infill", &C::fill_density, "%", 0, 100, "share of the inside that is filled"},
  {"fill_pattern", print, "Infill", &C::fill_pattern, "", 0, 0, "pattern of sparse infill"},
  {"top_fill_pattern", print, "Infill", &C::top_fill_pattern, "", 0, 0, "pattern of top surfaces"},
  {"bottom_fill_pattern", print, "Infill", &C::bottom_fill_pattern, "", 0, 0, "pattern of bottom surfaces"},
  {"fill_angle", print, "Infill", &C::fill_angle_deg, "degrees", 0, 360, "direction of infill, counterclockwise from X"},
  {"infill_overlap", print, "Infill", &C::infill_overlap, "mm or % of perimeter_extrusion_width", 0, 10, "how far infill reaches into the innermost loop"},
  {"infill_anchor_max", print, "Infill", &C::infill_anchor_max, "mm or % of infill_extrusion_width", 0, 10000, "longest link along the loops between two lines of infill"},
  {"bridge_flow_ratio", print, "Infill", &C::bridge_flow_ratio, "", 0.1, 3, "scales the amount of plastic of bridges"},
  {"thick_bridges", print, "Infill", &C::thick_bridges, "", 0, 0, "bridges are round threads of the nozzle's diameter instead of flat lines"},

  {"extrusion_width", print, "Widths", &C::extrusion_width, "mm or % of layer_height", 0, 20, "width of lines not named below; 0: from the nozzle diameter"},
  {"first_layer_extrusion_width", print, "Widths", &C::first_layer_extrusion_width, "mm or % of first_layer_height", 0, 20, "width of all lines of the first layer; 0: as on other layers"},
  {"perimeter_extrusion_width", print, "Widths", &C::perimeter_extrusion_width, "mm or % of layer_height", 0, 20, "width of inner loops; 0: extrusion_width"},
  {"external_perimeter_extrusion_width", print, "Widths", &C::external_perimeter_extrusion_width, "mm or % of layer_height", 0, 20, "width of outer loops; 0: extrusion_width"},
  {"infill_extrusion_width", print, "Widths", &C::infill_extrusion_width, "mm or % of layer_height", 0, 20, "width of sparse infill; 0: extrusion_width"},
  {"solid_infill_extrusion_width", print, "Widths", &C::solid_infill_extrusion_width, "mm or % of layer_height", 0, 20, "width of solid infill; 0: extrusion_width"},
  {"top_infill_extrusion_width", print, "Widths", &C::top_infill_extrusion_width, "mm or % of layer_height", 0, 20, "width of top surfaces; 0: extrusion_width"},

  {"perimeter_speed", print, "Speeds", &C::perimeter_speed_mm_s, "mm/s", 0.1, 2000, "inner loops"},
  {"external_perimeter_speed", print, "Speeds", &C::external_perimeter_speed, "mm/s or % of perimeter_speed", 0.1, 2000, "outer loops"},
  {"small_perimeter_speed", print, "Speeds", &C::small_perimeter_speed, "mm/s or % of the speed of the loop", 0.1, 2000, "loops of radius 6.5 mm or less, such as holes"},
  {"infill_speed", print, "Speeds", &C::infill_speed_mm_s, "mm/s", 0.1, 2000, "sparse infill"},
  {"solid_infill_speed", print, "Speeds", &C::solid_infill_speed, "mm/s or % of infill_speed", 0.1, 2000, "solid infill"},
  {"top_solid_infill_speed", print, "Speeds", &C::top_solid_infill_speed, "mm/s or % of solid_infill_speed", 0.1, 2000, "top surfaces"},
  {"gap_fill_speed", print, "Speeds", &C::gap_fill_speed_mm_s, "mm/s", 0.1, 2000, "gap fill"},
  {"bridge_speed", print, "Speeds", &C::bridge_speed_mm_s, "mm/s", 0.1, 2000, "bridges and loops that hang over"},
  {"first_layer_speed", print, "Speeds", &C::first_layer_speed, "mm/s or % of the speed it replaces", 0.1, 2000, "everything on the first layer, also what would be slower"},
  {"travel_speed", print, "Speeds", &C::travel_speed_mm_s, "mm/s", 1, 2000, "moves that do not print"},
  {"travel_speed_z", print, "Speeds", &C::travel_speed_z_mm_s, "mm/s", 0, 2000, "moves along Z; 0: travel_speed"},
  {"max_volumetric_speed", print, "Speeds", &C::max_volumetric_speed_mm3_s, "mm3/s", 0, 1000, "most plastic per second; 0: no limit"},

  {"default_acceleration", print, "Accelerations", &C::default_acceleration_mm_s2, "mm/s2", 0, 100000, "what is not named below; 0: left to the firmware, and so are the others"},
  {"first_layer_acceleration", print, "Accelerations", &C::first_layer_acceleration_mm_s2, "mm/s2", 0, 100000, "the first layer; 0: as on other layers"},
  {"perimeter_acceleration", print, "Accelerations", &C::perimeter_acceleration_mm_s2, "mm/s2", 0, 100000, "loops; 0: default_acceleration"},
  {"infill_acceleration", print, "Accelerations", &C::infill_acceleration_mm_s2, "mm/s2", 0, 100000, "infill; 0: default_acceleration"},
  {"bridge_acceleration", print, "Accelerations", &C::bridge_acceleration_mm_s2, "mm/s2", 0, 100000, "bridges; 0: default_acceleration"},

  {"skirts", print, "Skirt, brim and priming", &C::skirts, "loops", 0, 1000, "loops around everything on the first layers; they prime the nozzles"},
  {"skirt_distance", print, "Skirt, brim and priming", &C::skirt_distance_mm, "mm", 0, 1000, "from the object or its brim"},
  {"skirt_height", print, "Skirt, brim and priming", &C::skirt_height_layers, "layers", 0, 10000, "height of the skirt"},
  {"min_skirt_length", print, "Skirt, brim and priming", &C::min_skirt_length_mm, "mm of filament", 0, 10000, "more loops until every extruder has pushed this much"},
  {"brim_type", print, "Skirt, brim and priming", &C::brim_type, "", 0, 0, "where there is a brim"},
  {"brim_width", print, "Skirt, brim and priming", &C::brim_width_mm, "mm", 0, 1000, "width of the brim; 0: none"},
  {"brim_separation", print, "Skirt, brim and priming", &C::brim_separation_mm, "mm", 0, 100, "gap between brim and object"},
  {"prime_line_length", print, "Skirt, brim and priming", &C::prime_line_length_mm, "mm", 0, 1000, "line that primes a nozzle before its first use where no skirt does; 0: none"},

  {"rampart", print, "Rampart", &C::rampart, "", 0, 0, "walls around prints in several colours that wipe and fill nozzles: conforming follows the part, vertical goes straight up; auto: conforming where idle nozzles stay at the same height, else off"},
  {"rampart_walls", print, "Rampart", &C::rampart_walls, "", 0, 0, "split: two extruders share one wall, each prints the half on the far side of its nozzle; more than two, and double: one wall for each"},
  {"rampart_order", print, "Rampart", &C::rampart_order, "", 0, 0, "when a wall is printed: just before its own colour's run, or all walls where a layer starts"},
  {"ooze_shield_dist", print, "Rampart", &C::ooze_shield_dist_mm, "mm", 0.5, 50, "from the object to the first wall"},
  {"rampart_gap", print, "Rampart", &C::rampart_gap_mm, "mm", 0.5, 50, "from wall to wall"},
  {"rampart_speed", print, "Rampart", &C::rampart_speed_mm_s, "mm/s", 1, 1000, "of the walls"},
  {"rampart_max_overhang", print, "Rampart", &C::rampart_max_overhang_deg, "degrees", 0, 80, "how far conforming walls lean over, from the vertical; at most half a line a layer"},
  {"rampart_brim_width", print, "Rampart", &C::rampart_brim_width_mm, "mm", 0, 100, "of the walls in the first layer, so that they stand; 0: none"},

  {"planner", print, "Planner", &C::planner, "", 0, 0, "clean: ways that keep nozzles off other colours and starts that cannot be seen; paper: the costs of Clean color to the letter, to compare with and its print_order; plain: the nearest path next, straight"},
  {"effort", print, "Planner", &C::effort, "", 0, 0, "how long cleaner orders are searched for"},
  {"print_order", print, "Planner", &C::print_order, "", 0, 0, "exposure: the order in which idle nozzles are predicted to smear least; few_changes: all that one extruder can print, nearest first; paper: zone by zone, longer ones first, as in Clean color"},
  {"wipe_passes", print, "Planner", &C::wipe_passes, "", 0, 0, "before a nozzle is predicted to smear another colour it is taken across a wall of the rampart, where that is worth the time (planner clean)"},
  {"refill_mode", print, "Planner", &C::refill_mode, "", 0, 0, "plastic pushed beside a wall of the rampart; model: what is forecast to be missing, before an outer wall would lack it; fixed: refill_volume on every way along a wall; off: none"},
  {"refill_volume", print, "Planner", &C::refill_volume_mm3, "mm3", 0, 100, "of each pass where refill_mode is fixed"},
  {"refill_speed", print, "Planner", &C::refill_speed_mm_s, "mm/s of filament", 0.1, 50, "at which a refill pushes; the carriage is as fast as that asks, at most 120 mm/s"},
  {"refill_skipped_layers", print, "Planner", &C::refill_skipped_layers, "layers", 0, 1000, "at the bed, without refills"},
  {"view_direction", print, "Planner", &C::view_direction, "", 0, 0, "from where the print is looked at: degrees counterclockwise from X, of the models as they are in their files, such as 270 for the front; none: from all around"},
  {"view_weight", print, "Planner", &C::view_weight, "", 0, 1, "how much less what faces away from view_direction counts; 1: not at all"},
  {"weight_crossing", print, "Planner weights", &C::weight_crossing, "mm of way a mm", 0, 1e6, "hanging over visible plastic of another colour"},
  {"weight_foreign", print, "Planner weights", &C::weight_foreign, "mm of way a mm", 0, 1e6, "in addition, x visibility"},
  {"weight_own", print, "Planner weights", &C::weight_own, "mm of way a mm", 0, 1e6, "hanging over plastic of the own colour, x visibility"},
  {"weight_hidden", print, "Planner weights", &C::weight_hidden, "mm of way a mm", 0, 1e6, "hanging over plastic that cannot be seen"},
  {"weight_seam", print, "Planner weights", &C::weight_seam, "mm of way", 0, 1e6, "a start or end of extrusion, x visibility"},
  {"weight_smear", print, "Planner weights", &C::weight_smear, "mm of way a mm", 0, 1e6, "touching another colour, x visibility, for each mm of way since the last touch"},
  {"weight_hole", print, "Planner weights", &C::weight_hole, "mm of way a mm", 0, 1e6, "beginning an outer wall, x visibility, for each mm of way to it"},
  {"weight_hole_volume", print, "Planner weights", &C::weight_hole_volume, "mm3 of smear a mm3", 0, 1000, "plastic missing in an outer wall, in the search for an order"},
  {"weight_time", print, "Planner weights", &C::weight_time, "mm3 of smear a s", 1e-4, 10, "print time, in the search for an order"},

  {"resolution", print, "Output", &C::resolution_mm, "mm", 0, 1, "outlines are simplified by this much before anything else"},
  {"gcode_resolution", print, "Output", &C::gcode_resolution_mm, "mm", 0, 1, "print paths are simplified by this much"},
};
// clang-format on

}  // namespace

std::span<const Option> option_table() {
  return table;
}

}  // namespace cleancolor
