// model/options.hpp
//
// Options: the one table of all options, and everything that follows from it: reading and writing their text, checking
// ranges, the configuration block of a G-code file, the reference in docs/options.md.
//
// The text of a value is PrusaSlicer's: 0 and 1 for no and yes, "105%" for a share, "0x0,33x0" for points, "\n" for a
// new line. Options of one extruder are lists with one value per extruder: numbers separated by ",", texts by ";" and
// quoted where they must be. A single value holds for all extruders. So PrusaSlicer reads our configuration block and
// we its.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "model/config.hpp"

namespace cleancolor {

/// The kind of profile that holds the option.
enum class OptionGroup { printer, material, print };

enum class OptionKind { flag, integer, number, percent, length_or_share, text, choice, point, polygon };

/// One component of a Vec3 field: machine_max_jerk_x is {&Config::machine_max_jerk_mm_s, &Vec3::x}.
struct MachineAxis {
  Vec3 Config::* vector;
  double Vec3::* axis;
};

/// Where the value lies.
using OptionField =
    std::variant<bool Config::*, int Config::*, double Config::*, std::string Config::*, LengthOrShare Config::*,
                 std::vector<Vec2> Config::*, Flavour Config::*, OffsetsIn Config::*, IdleNozzle Config::*,
                 SeamPosition Config::*, FillPattern Config::*, BrimType Config::*, RampartShape Config::*,
                 RampartWalls Config::*, RampartOrder Config::*, Planner Config::*, Effort Config::*,
                 PrintOrder Config::*, RefillMode Config::*, MachineAxis, bool Extruder::*, int Extruder::*,
                 double Extruder::*, std::string Extruder::*, Vec2 Extruder::*, std::vector<Vec2> Extruder::*>;

struct Option {
  std::string_view name;
  OptionGroup group;
  std::string_view section;  // heading in the reference
  OptionField field;
  std::string_view unit;  // "mm", "%", "" where there is none
  double min;             // of numbers, in the unit; shares lie in [0, 1000%]
  double max;
  std::string_view help;  // one line

  OptionKind kind() const;
  bool per_extruder() const;
  std::span<const std::string_view> choices() const;  // names of the values in their order; empty unless kind is choice
};

/// One value. A choice is its index in Option::choices(), a percentage its share of 1.
using OptionValue = std::variant<bool, int, double, LengthOrShare, std::string, Vec2, std::vector<Vec2>>;

/// All options, by group and section, in the order of the reference.
std::span<const Option> options();

/// nullptr where there is none of this name.
const Option* find_option(std::string_view name);

/// "; did you mean 'perimeters'?" where a name is close to the given one, else "".
std::string did_you_mean(std::string_view name);

/// The value in its field. Requires: extruder < config.extruders.size(); of a global option it does not matter.
OptionValue option_value(const Config& config, const Option& option, std::size_t extruder = 0);

/// Checks the range and stores. Throws Error(where + name + reason).  Requires: the alternative suits option.kind().
void store_option(Config& config, const Option& option, std::size_t extruder, OptionValue value,
                  std::string_view where = "");

/// One value from its text. Throws Error(where + name + reason).
OptionValue parse_option(const Option& option, std::string_view text, std::string_view where = "");

/// The elements of a list as in an .ini file, unquoted; the whole text where the option is not a list.
std::vector<std::string> split_list(const Option& option, std::string_view text, std::string_view where = "");

/// Sets an option from its text, as in an .ini file and --set. More nozzle diameters than extruders add extruders.
///
/// Throws Error(where + ...) for an unknown name, a value that cannot be read or is out of range, and for lists that
/// have neither one value nor one per extruder. `where` says where the text stands: "base.ini:12: ".
void set_option(Config& config, std::string_view name, std::string_view text, std::string_view where = "");

/// Text of one value, unquoted: "0.3", "105%", "marlin2".
std::string value_text(const Option& option, const OptionValue& value);

/// Text of the option as it stands in an .ini file: lists joined, texts escaped.  Requires: the name exists.
std::string option_text(const Config& config, std::string_view name);

/// All options as (key, text), for the end of a G-code file; nozzle_offset is followed by PrusaSlicer's
/// extruder_offset: the same where the slicer subtracts the offsets, else zeroes.
std::vector<std::pair<std::string, std::string>> config_block(const Config& config);

/// Makes the config have `count` extruders; new ones are copies of the last.  Requires: count > 0.
void set_extruder_count(Config& config, std::size_t count);

inline constexpr std::size_t max_extruders = 16;

std::string_view group_name(OptionGroup group);

/// The reference of all options, as it stands in docs/options.md.
std::string options_markdown();

}  // namespace cleancolor
