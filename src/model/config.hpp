// model/config.hpp
//
// Config: every option of printer, materials and print as plain typed fields.
//
// Field = PrusaSlicer's option name + unit. Names, ranges, units and help of all options stand once, in
// model/option_table.cpp; defaults stand here. What PrusaSlicer keeps as a list with one value per extruder is a field
// of Extruder. Angles are degrees here because this struct is the border (files, command line); they become radians
// where they are used.
#pragma once

#include <string>
#include <vector>

#include "base/vec.hpp"

namespace cleancolor {

enum class Flavour { marlin2, klipper, reprapfirmware, sailfish };
enum class OffsetsIn { slicer, firmware };
enum class IdleNozzle { same_height, lifted, parked, docked };
enum class SeamPosition { nearest, aligned, rear, random, hidden };
enum class FillPattern { rectilinear, grid, gyroid, concentric };
enum class BrimType { no_brim, outer_only };
enum class RampartShape { automatic, conforming, vertical, off };
enum class RampartWalls { doubled, split };
enum class RampartOrder { before_run, layer_start };
enum class Planner { clean, paper, plain };
enum class Effort { fast, normal, best };
enum class PrintOrder { exposure, few_changes, paper };
enum class RefillMode { fixed, model, off };

/// A length in mm, or a share of another length: "0.45" or "105%".
struct LengthOrShare {
  double value = 0;  // mm, or 1.05 for 105%
  bool is_share = false;

  double of(double whole) const { return is_share ? value * whole : value; }
};

/// One nozzle and the filament in it.
struct Extruder {
  // printer
  double nozzle_diameter_mm = 0.4;
  Vec2 nozzle_offset_mm;                         // where this nozzle is, seen from nozzle 0
  std::vector<Vec2> extruder_printable_area_mm;  // where this nozzle reaches; empty: the whole bed
  std::string extruder_colour;                   // "#RRGGBB" or empty
  double retract_length_mm = 0.5;
  double retract_speed_mm_s = 25;
  double deretract_speed_mm_s = 0;  // 0: as retract_speed
  double retract_restart_extra_mm = 0;
  double retract_before_travel_mm = 1;
  bool retract_layer_change = true;
  double retract_lift_mm = 0;  // z-hop
  double retract_length_toolchange_mm = 1;
  double retract_restart_extra_toolchange_mm = 0;

  // material
  std::string filament_type = "PLA";
  std::string filament_colour;  // "#RRGGBB" or empty
  double filament_diameter_mm = 1.75;
  double filament_density_g_cm3 = 1.24;
  double filament_cost_per_kg = 0;
  double extrusion_multiplier = 1;
  double filament_max_volumetric_speed_mm3_s = 0;  // 0: no limit
  double filament_translucency_mm = 0;             // of depth that leave 1/e of the light; 0: opaque
  int temperature_c = 210;
  int first_layer_temperature_c = 215;
  int bed_temperature_c = 60;
  int first_layer_bed_temperature_c = 60;
  bool cooling = true;
  bool fan_always_on = true;
  int min_fan_speed_percent = 35;
  int max_fan_speed_percent = 100;
  int bridge_fan_speed_percent = 100;
  int disable_fan_first_layers = 1;
  double fan_below_layer_time_s = 60;
  double slowdown_below_layer_time_s = 5;
  double min_print_speed_mm_s = 10;
  std::string start_filament_gcode;
  std::string end_filament_gcode;
};

struct Config {
  // printer
  std::string printer_model = "generic";
  Flavour gcode_flavor = Flavour::marlin2;
  OffsetsIn offsets_in = OffsetsIn::firmware;
  IdleNozzle idle_nozzle = IdleNozzle::same_height;
  bool audit_only = false;  // a profile that is not complete enough to print with
  std::vector<Vec2> bed_shape_mm = {{0, 0}, {200, 0}, {200, 200}, {0, 200}};
  double max_print_height_mm = 200;
  bool use_relative_e_distances = false;
  bool remaining_times = true;  // M73
  std::string thumbnails = "";  // "16x16,220x124"
  std::string start_gcode = "G28 ; home all axes\nG1 Z5 F5000 ; lift nozzle";
  std::string end_gcode = "M104 S0 ; turn off temperature\nG28 X0 ; home X axis\nM84 ; disable motors";
  std::string before_layer_gcode;
  std::string layer_gcode;
  std::string toolchange_gcode;
  Vec3 machine_max_feedrate_mm_s = {500, 500, 12};
  double machine_max_feedrate_e_mm_s = 120;
  Vec3 machine_max_acceleration_mm_s2 = {9000, 9000, 500};
  double machine_max_acceleration_e_mm_s2 = 10000;
  double machine_max_acceleration_extruding_mm_s2 = 1500;
  double machine_max_acceleration_retracting_mm_s2 = 1500;
  double machine_max_acceleration_travel_mm_s2 = 1500;
  Vec3 machine_max_jerk_mm_s = {10, 10, 0.2};
  double machine_max_jerk_e_mm_s = 2.5;
  bool heater_off_after_last_use = true;

  // print: layers and shells
  double layer_height_mm = 0.3;
  double first_layer_height_mm = 0.35;
  int perimeters = 3;
  bool external_perimeters_first = false;
  bool thin_walls = true;
  bool gap_fill_enabled = true;
  bool overhangs = true;  // perimeters that hang over are printed as bridges
  int top_solid_layers = 3;
  int bottom_solid_layers = 3;
  bool interface_shells = false;
  double solid_infill_below_area_mm2 = 70;
  SeamPosition seam_position = SeamPosition::hidden;
  bool join_perimeters = true;
  LengthOrShare seam_gap_distance = {0.15, true};  // of the nozzle diameter
  double slice_closing_radius_mm = 0.049;
  double xy_size_compensation_mm = 0;
  double elefant_foot_compensation_mm = 0;

  // print: infill
  double fill_density = 0.2;  // share of solid, in [0, 1]
  FillPattern fill_pattern = FillPattern::gyroid;
  FillPattern top_fill_pattern = FillPattern::rectilinear;
  FillPattern bottom_fill_pattern = FillPattern::rectilinear;
  double fill_angle_deg = 45;
  LengthOrShare infill_overlap = {0.25, true};    // of the perimeter's width
  LengthOrShare infill_anchor_max = {50, false};  // longest link between two infill lines along the perimeter
  double bridge_flow_ratio = 1;
  bool thick_bridges = true;

  // print: widths, 0 = from the nozzle diameter
  LengthOrShare extrusion_width;
  LengthOrShare first_layer_extrusion_width = {2, true};
  LengthOrShare perimeter_extrusion_width;
  LengthOrShare external_perimeter_extrusion_width;
  LengthOrShare infill_extrusion_width;
  LengthOrShare solid_infill_extrusion_width;
  LengthOrShare top_infill_extrusion_width;

  // print: speeds
  double perimeter_speed_mm_s = 60;
  LengthOrShare external_perimeter_speed = {0.5, true};  // of perimeter_speed
  LengthOrShare small_perimeter_speed = {15, false};     // of the speed of the loop
  double infill_speed_mm_s = 80;
  LengthOrShare solid_infill_speed = {20, false};      // of infill_speed
  LengthOrShare top_solid_infill_speed = {15, false};  // of solid_infill_speed
  double gap_fill_speed_mm_s = 20;
  double bridge_speed_mm_s = 60;
  LengthOrShare first_layer_speed = {30, false};  // of the speed it replaces
  double travel_speed_mm_s = 130;
  double travel_speed_z_mm_s = 0;         // 0: as travel_speed
  double max_volumetric_speed_mm3_s = 0;  // 0: no limit
  double default_acceleration_mm_s2 = 0;  // 0: left to the firmware
  double first_layer_acceleration_mm_s2 = 0;
  double perimeter_acceleration_mm_s2 = 0;
  double infill_acceleration_mm_s2 = 0;
  double bridge_acceleration_mm_s2 = 0;

  // print: bed
  int skirts = 1;
  double skirt_distance_mm = 6;
  int skirt_height_layers = 1;
  double min_skirt_length_mm = 0;
  BrimType brim_type = BrimType::outer_only;  // printed where brim_width is positive
  double brim_width_mm = 0;
  double brim_separation_mm = 0;
  double prime_line_length_mm = 40;  // where no skirt primes the nozzles; 0: none

  // print: rampart
  RampartShape rampart = RampartShape::automatic;    // conforming where idle nozzles stay at print height, else off
  RampartWalls rampart_walls = RampartWalls::split;  // halves of one for two extruders, or one for each
  RampartOrder rampart_order = RampartOrder::before_run;
  double ooze_shield_dist_mm = 2;  // from the part to the first wall
  double rampart_gap_mm = 4;       // from wall to wall
  double rampart_speed_mm_s = 120;
  double rampart_max_overhang_deg = 45;
  double rampart_brim_width_mm = 2;

  // print: planner
  Planner planner = Planner::clean;
  Effort effort = Effort::normal;
  PrintOrder print_order = PrintOrder::exposure;
  bool wipe_passes = true;
  RefillMode refill_mode = RefillMode::off;
  double refill_volume_mm3 = 2;         // of each pass, where refill_mode is fixed
  double refill_speed_mm_s = 2;         // of the filament
  int refill_skipped_layers = 3;        // the first ones
  std::string view_direction = "none";  // or degrees, model/view.hpp
  double view_weight = 0.5;             // how much less the far side counts
  // In mm of way, beside the 1 of each mm itself: a mm over ...
  double weight_crossing = 1000;  // visible foreign plastic
  double weight_foreign = 100;    // foreign plastic in full sight, in addition
  double weight_own = 30;         // own plastic in full sight
  double weight_hidden = 0.5;     // plastic that cannot be seen
  double weight_seam = 300;       // a start or end in full sight
  double weight_smear = 20;       // foreign plastic in full sight, for each mm since the last touch
  double weight_hole = 100;       // an outer wall in full sight, for each mm of way to it
  // In mm3 of smear:
  double weight_hole_volume = 4;  // a mm3 missing in an outer wall
  double weight_time = 0.005;     // a second

  // print: output
  double resolution_mm = 0.02;          // contours are simplified by this much before any offset
  double gcode_resolution_mm = 0.0125;  // and print paths by this much

  std::vector<Extruder> extruders = std::vector<Extruder>(1);  // at least one
};

}  // namespace cleancolor
