// reader/read.hpp
//
// G-code of any slicer -> GcodePrint.
//
// Understood: G0 G1 G2 G3 (arcs become chords within 0.01 mm; I J or R; G17 only; G90.1 G91.1), G4, G10 and G11
// (firmware's own retraction, or RepRapFirmware's tools), G20 G21, G28 G29 G161 G162 M132 and other homing, probing
// and parking (the position is unknown after), G90 G91, G92 G92.1 (X Y Z E A B), M82 M83, M104 M109 M116 M133 M568,
// M200 (volumetric E), M201 M203 M204 M205 M566, M207 M208, M218, M220, T0 ..., M6 T, M108 T, M135 T, Klipper's
// SET_VELOCITY_LIMIT, ACTIVATE_EXTRUDER and SET_HEATER_TEMPERATURE. Many more are known to move nothing (fans,
// displays, beds, Bambu's M620 S1A around T1). Flow percentages (M221) are left out: what is told is what is pushed. E
// counts per tool where the tool words are M108 or M135 (Sailfish: axes A and B), else one for all; when it is
// relative: reader/filament.hpp.
//
// Without a word about it the file begins with T0, absolute positions and E, mm, all of them unknown.
#pragma once

#include <filesystem>
#include <string>

#include "base/progress.hpp"
#include "reader/print.hpp"

namespace cleancolor {

/// Reads a whole file.
///
/// Throws Error("file:line: ...") for binary G-code (.bgcode: with the hint how to export text) and other binary data,
/// zip archives, an empty file, a file without a move that lays plastic, numbers that are none, coordinates and lengths
/// of filament in one move beyond 10 m, a line longer than 1 MB outside a comment, a wrong checksum, tools beyond
/// max_tools, arcs in other planes, a file above 4 GB, and one cut off in the middle of a move's line; "interrupted"
/// where progress says so. Unknown commands are listed in the print, not fatal; where one of them names X, Y or Z, the
/// position is unknown after.  SystemError where it cannot be read.
/// Cost: at least 40 MB/s on one core; memory: the text and 64 bytes a move.
GcodePrint read_gcode_file(const std::filesystem::path& file, const Progress& progress = {});

/// The text of such a file.  Throws as read_gcode_file does, where it cannot be read.
std::string gcode_text(const std::filesystem::path& file);

/// The same for a text in memory; name: for messages.
GcodePrint read_gcode(std::string text, const std::string& name, const Progress& progress = {});

}  // namespace cleancolor
