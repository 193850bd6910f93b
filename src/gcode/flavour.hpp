// gcode/flavour.hpp
//
// Flavours: the words of each firmware, as data. Nothing else in this folder asks which firmware it writes for.
//
// Words are fmt templates: {tool}, {value}, {percent}, {minutes}; an empty word means the firmware has none.
//
// Sources: Marlin's, Klipper's and RepRapFirmware's G-code references; for sailfish (MakerBot Replicator, by way of
// gpx) gpx 2.6.8 and the Sailfish manual.
//
// Choices:
// - Marlin that knows the offsets itself (M218) drives the new nozzle at once to where the old one stood: straight
//   across the part. `T1 S1` changes the tool and stays; the next travel goes where it should, in one piece.
// - RepRapFirmware gets M106 without P: then it turns the fans that the tool in use is mapped to.
// - Sailfish keeps one absolute count per tool, on axes of their own (A and B), and is never told G92: gpx takes a G92
//   before the carriage was driven once in X, Y and Z for 0, 0, 0.
// - Where the user asks for accelerations, Marlin and RepRapFirmware are told that of travel once (M204 T). Klipper has
//   one for all moves: travel goes by that of the road before, and the estimate of time knows it.
// - Left out: the acceleration of retractions (M204 R) and jerk (M205, M566). They stay as the firmware has them; the
//   machine limits of the profile serve the estimate of time only.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "model/config.hpp"

namespace cleancolor {

struct FlavourWords {
  std::string_view tool_change;
  std::string_view tool_change_standing;  // where the firmware applies the nozzle offsets
  std::string_view set_nozzle;            // {tool} {value} in degrees C
  std::string_view wait_nozzle;           // after set_nozzle
  std::string_view set_bed;
  std::string_view wait_bed;
  std::string_view fan_on;  // {value} in 0..255
  std::string_view fan_off;
  std::string_view acceleration;                 // {value} in mm/s2, of printing moves,
  std::string_view travel_acceleration;          // and of travel; empty: the one above holds for travel, too
  std::string_view progress;                     // {percent} {minutes} to go
  std::string_view e_axes;                       // the letter of each tool's filament; one letter: of all
  bool e_per_tool = false;                       // every tool has a count of its own, never set back; always absolute
  std::array<std::string_view, 3> nozzle_codes;  // start code with one of these heats nozzles itself,
  std::array<std::string_view, 3> bed_codes;     // with one of these the bed
  std::array<std::string_view, 3> tool_codes;    // templates with a line that begins so change the tool themselves
};

const FlavourWords& words(Flavour flavour);

}  // namespace cleancolor
