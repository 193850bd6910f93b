// model/ini.hpp
//
// The configuration of PrusaSlicer and Slic3r, as an .ini file or at the end of a G-code file, put over a Config.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.hpp"
#include "model/config.hpp"

namespace cleancolor {

struct IniEntry {
  std::string key;
  std::string value;  // trimmed, escapes as in the file
  int line = 0;       // from 1; 0 in the end of a large G-code file, where lines are not counted
};

struct IniResult {
  Config config;
  std::vector<std::string> ignored;  // "support_material = 1": not known here, and it would have changed the print
};

/// The configuration block of OrcaSlicer or BambuStudio, and that of SuperSlicer, in the names and values of
/// PrusaSlicer: printer, filament, widths, speeds, and what a print can be refused for. What is not among them
/// (patterns, supports, ...) is left out.
std::vector<IniEntry> from_orca(const std::vector<IniEntry>& entries);
std::vector<IniEntry> from_superslicer(const std::vector<IniEntry>& entries);

/// The entries of an .ini file in its order.
///
/// Throws Error("file:line: ...") for a line without "=" and for a section, as in a bundle of several profiles.
std::vector<IniEntry> read_ini(std::string_view text, const std::string& file);

/// The entries of the configuration at the end of a G-code file: "; key = value" comments after the last command.
///
/// Throws Error where there is none.
std::vector<IniEntry> read_gcode_config(std::string_view text, const std::string& file);

/// The config with the entries put over it; later entries of one key hold.
///
/// The file's nozzle_diameter adds extruders where it has more than the config, which never loses any. Lists that are
/// too long are cut, those that are too short repeat their first value, as in PrusaSlicer. Names and values of older
/// versions are understood. What is printed in another way here is replaced by the nearest and warned of; what is not
/// known and not neutral is listed as ignored.
///
/// Nozzle offsets: a non-zero extruder_offset becomes nozzle_offset with offsets_in = slicer (sailfish adds them
/// itself: firmware, with a warning). Zeroes say only that the
/// firmware does it, so nozzle_offset of the config stays. Our own nozzle_offset wins over both.
///
/// Throws Error("file:line: ...") for values that cannot be read or are out of range.
IniResult with_ini(Config config, const std::vector<IniEntry>& entries, const std::string& file,
                   const Progress& progress = {});

/// Reads a file, G-code or .ini as its content says, and puts it over the config.
IniResult with_ini_file(Config config, const std::filesystem::path& file, const Progress& progress = {});

}  // namespace cleancolor
