// model/settings.hpp
//
// Settings: what a person chose -> the Config to print with.
//
//   defaults < printer < materials < print < loaded file < single options
//
// Where no material or print profile is named, the printer's own choice is taken; but not beside a loaded file, which
// knows its own. Where neither a printer nor a file is named, it is the printer "generic", which has one nozzle.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.hpp"
#include "model/config.hpp"

namespace cleancolor {

struct Profile;

struct Settings {
  std::string printer = {};                 // name or file; "": see above
  std::vector<std::string> materials = {};  // one per extruder; the last also holds for all that follow
  std::string print = {};
  std::filesystem::path load = {};    // PrusaSlicer's or Slic3r's configuration, or G-code that contains one
  std::vector<std::string> set = {};  // "layer_height=0.2"
};

/// The short form of what keeps the colours apart: "none", "rampart" or "full", as in `cleancolor slice --protect`.
struct ProtectionLevel {
  bool turns = true;                  // the parts may be turned: azimuth
  std::vector<std::string> set = {};  // options that it stands for; what is set by name counts more
};

/// Nothing where there is no such level.
std::optional<ProtectionLevel> protection_level(std::string_view word);

/// How parts are turned, as in `cleancolor slice --azimuth`: "auto" (empty), "off" (0), or by so many degrees. Throws
/// Error for anything else; name: what the message begins with.
std::optional<double> azimuth_deg(std::string_view word, std::string_view name = "azimuth");

/// Throws Error where a profile, file or option cannot be used, or where the options do not go together. Warns of what
/// a loaded file contains and we ignore.
Config config_of(const Settings& settings, const Progress& progress = {});

/// The same for a printer whose profile has been read, in place of settings.printer.
Config config_of(const Profile& printer, const Settings& settings, const Progress& progress = {});

}  // namespace cleancolor
