#include "gcode/flavour.hpp"

namespace cleancolor {
namespace {

// In the order of enum Flavour.
constexpr std::array<FlavourWords, 4> all_words = {{
    {
        // marlin2
        .tool_change = "T{tool}",
        .tool_change_standing = "T{tool} S1",
        .set_nozzle = "M104 S{value} T{tool}",
        .wait_nozzle = "M109 S{value} T{tool}",
        .set_bed = "M140 S{value}",
        .wait_bed = "M190 S{value}",
        .fan_on = "M106 S{value}",
        .fan_off = "M107",
        .acceleration = "M204 P{value}",
        .travel_acceleration = "M204 T{value}",
        .progress = "M73 P{percent} R{minutes}",
        .e_axes = "E",
        .nozzle_codes = {"M104", "M109"},
        .bed_codes = {"M140", "M190"},
        .tool_codes = {"T{tool}"},
    },
    {
        // klipper
        .tool_change = "T{tool}",
        .tool_change_standing = "T{tool}",
        .set_nozzle = "M104 S{value} T{tool}",
        .wait_nozzle = "M109 S{value} T{tool}",
        .set_bed = "M140 S{value}",
        .wait_bed = "M190 S{value}",
        .fan_on = "M106 S{value}",
        .fan_off = "M107",
        .acceleration = "SET_VELOCITY_LIMIT ACCEL={value}",
        .travel_acceleration = "",
        .progress = "M73 P{percent} R{minutes}",
        .e_axes = "E",
        .nozzle_codes = {"M104", "M109", "SET_HEATER_TEMPERATURE HEATER=extruder"},
        .bed_codes = {"M140", "M190", "SET_HEATER_TEMPERATURE HEATER=heater_bed"},
        .tool_codes = {"T{tool}", "ACTIVATE_EXTRUDER"},
    },
    {
        // reprapfirmware
        .tool_change = "T{tool}",
        .tool_change_standing = "T{tool}",
        .set_nozzle = "G10 P{tool} S{value} R{value}",
        .wait_nozzle = "M116 P{tool}",
        .set_bed = "M140 S{value}",
        .wait_bed = "M190 S{value}",
        .fan_on = "M106 S{value}",
        .fan_off = "M107",
        .acceleration = "M204 P{value}",
        .travel_acceleration = "M204 T{value}",
        .progress = "M73 P{percent} R{minutes}",
        .e_axes = "E",
        .nozzle_codes = {"M104", "M109", "G10"},
        .bed_codes = {"M140", "M190"},
        .tool_codes = {"T{tool}"},
    },
    {
        // sailfish
        .tool_change = "M108 T{tool}",
        .tool_change_standing = "M108 T{tool}",
        .set_nozzle = "M104 S{value} T{tool}",
        .wait_nozzle = "M133 T{tool}",
        .set_bed = "M140 S{value} T0",
        .wait_bed = "M134 T0",
        .fan_on = "M126",
        .fan_off = "M127",
        .acceleration = "",
        .travel_acceleration = "",
        .progress = "M73 P{percent}",
        .e_axes = "AB",
        .e_per_tool = true,
        .nozzle_codes = {"M104", "M109", "M133"},
        .bed_codes = {"M140", "M190", "M134"},
        .tool_codes = {"T{tool}", "M108 T{tool}", "M135 T{tool}"},
    },
}};

}  // namespace

const FlavourWords& words(Flavour flavour) {
  return all_words[std::size_t(flavour)];
}

}  // namespace cleancolor
