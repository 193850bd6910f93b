// model/profile.hpp
//
// Profiles: printers, materials and print settings as TOML files whose keys are option names.
//
//   description = "MakerBot Replicator Dual"   # one line for the list
//   inherits = "generic-dual-marlin"           # a built-in profile, or a file beside this one
//   default_material = "abs"                   # of a printer: what is taken where none is named
//   default_print = "paper"
//   nozzle_diameter = [0.4, 0.4]               # the number of values is the number of extruders
//   nozzle_offset = [[0, 0], [33, 0]]          # one value per extruder, or one for all
//
// A printer profile holds the options of the group printer, and so on. Yes and no are true and false; shares are texts
// such as "50%"; points are [x, y]. Built-in profiles are the files of profiles/, part of the program itself.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/options.hpp"

namespace cleancolor {

struct ProfileSetting {
  const Option* option;
  std::vector<OptionValue> values;  // one, or one per extruder
  std::string where;                // "my.toml:12: "
};

struct Profile {
  OptionGroup group = OptionGroup::printer;
  std::string name;
  std::string description;
  std::string default_material;  // "" where the profile names none
  std::string default_print;
  std::vector<ProfileSetting> settings;  // those inherited first; every option at most once
};

struct BuiltInProfile {
  OptionGroup group;
  std::string_view name;
  std::string_view toml;
};

/// By group, then by name. Names differ also between groups.
std::span<const BuiltInProfile> builtin_profiles();

bool is_built_in(OptionGroup group, std::string_view name);

/// A built-in profile by its name, or a file by its path, which ends in ".toml" or contains a "/".
///
/// Throws Error for an unknown name (and lists the known ones), and as read_profile does.
Profile find_profile(OptionGroup group, const std::string& name_or_file);

/// The kind of the profile that find_profile would find: of a built-in one by its name, of a file by its first option,
/// or else by what it inherits. Nothing where there is no built-in profile of this name, or a file has no option.
std::optional<OptionGroup> profile_group(const std::string& name_or_file);

/// What a profile may inherit: a text that comes from elsewhere must not have files of this machine read.
enum class Inherits { all, built_in };

/// Reads the text of a profile. file: its path, for messages and to find what it inherits.
///
/// Throws Error("file:line: ...") where the TOML is malformed, a key is unknown or of another group, a value has the
/// wrong type or is out of range, inheritance goes round in a circle, or is of a file where only built-in profiles may
/// be inherited.
Profile read_profile(OptionGroup group, std::string_view toml, const std::string& file, Inherits from = Inherits::all);

/// The config with the profile's settings. A printer's nozzle_diameter makes the number of extruders; a material is put
/// into one extruder and leaves the others alone.
///
/// Throws Error where a list has neither one value nor one per extruder.  Requires: extruder < number of extruders.
Config with_profile(Config config, const Profile& profile, std::size_t extruder = 0);

/// All options of the group as a TOML profile, each with its help; of a material those of the first extruder.
/// read_profile and with_profile give the same values again.
std::string profile_toml(const Config& config, OptionGroup group);

}  // namespace cleancolor
