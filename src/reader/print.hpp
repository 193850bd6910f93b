// reader/print.hpp
//
// GcodePrint: what a G-code file of any slicer makes a printer do, and the text that it came from.
//
// Every move and event knows the line that caused it. What the reader does not understand stays in the text, verbatim
// and in its place: whoever writes the file back copies the lines between the moves that are changed.
//
// Positions are those that the file speaks of: absolute, in mm, of the tool in use, whether the slicer or the firmware
// makes up for the nozzle offsets (audit/machine.hpp settles that).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.hpp"
#include "model/config.hpp"
#include "model/ini.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

enum class Dialect : std::uint8_t {
  cleancolor,
  prusaslicer,
  superslicer,
  slic3r,
  orcaslicer,
  bambustudio,
  cura,
  simplify3d,
  kisslicer,
  ideamaker,
  unknown,
};

inline constexpr int max_tools = 16;

/// One straight move, or one chord of an arc. Carriage, filament or both.
struct GcodeMove {
  Vec3 to_mm;                    // where it ends
  double filament_mm = 0;        // > 0 pushed, < 0 drawn back, of the tool `feeds`; a length of filament
  float speed_mm_s = 0;          // as asked for: of the carriage, of the filament where only that moves; 0: not told
  float acceleration_mm_s2 = 0;  // as last told for moves of this kind; 0: never told
  float width_mm = 0;            // of the road; 0 where no plastic is laid
  float height_mm = 0;
  std::uint32_t offset = 0;   // of its line in the text, bytes
  std::uint32_t layer = 0;    // index into GcodePrint::layers
  std::uint8_t tool = 0;      // in use
  std::uint8_t feeds = 0;     // whose filament moves; differs from tool only in odd start codes
  Role role = Role::unknown;  // of the plastic laid; of a travel: what the file was printing
  bool known_start = true;    // false: where the move before ended is not known (homing), so it draws no line
  bool names_xy = false;      // its line tells X or Y, be it where the tool is already
  bool arc = false;           // a chord of G2 or G3; all chords of one arc have the same line
};

/// What happens between two moves.
struct GcodeEvent {
  enum class Kind : std::uint8_t {
    tool_change,  // tool is in use from here on; jumps: the firmware drives the new nozzle to where the old one was
    target_temperature,  // of the tool, value in degrees C; waits: until it is reached
    dwell,               // value in s
    max_speed,           // of the axis, value in mm/s
    max_acceleration,    // of the axis, value in mm/s2
    max_jerk,            // of the axis, value in mm/s
  };
  Kind kind = Kind::dwell;
  std::uint8_t tool = 0;
  std::uint8_t axis = 0;  // 0 X, 1 Y, 2 Z, 3 E
  bool jumps = false;
  bool waits = false;
  double value = 0;
  std::uint32_t before_move = 0;  // index of the move that follows it
  std::uint32_t offset = 0;
};

/// A height at which plastic is laid. All moves at one height are one layer, however often the nozzle comes back to it.
struct GcodeLayer {
  double z_mm = 0;       // of the nozzle while it prints
  double height_mm = 0;  // above the layer below it (or what the file says); the first: above the bed
};

/// A command that the reader does not know, so that people can judge whether it matters.
struct UnknownCommand {
  std::string name;  // "M900", "SET_FOO"
  std::size_t count = 0;
  std::size_t first_line = 0;  // from 1
};

/// What the file says of itself, outside the moves.
struct GcodeFacts {
  Dialect dialect = Dialect::unknown;
  std::string producer;          // "PrusaSlicer 2.5.0"; empty where the file does not say
  std::vector<IniEntry> config;  // the configuration block, in its order; empty where there is none
  std::string config_kind;       // "prusaslicer", "orcaslicer" ...: whose option names the block has
  bool marlin = false;           // a bare T moves the carriage where the firmware knows the offsets

  std::vector<Vec2> nozzle_offset_mm;  // as the file tells it, of each nozzle as seen from nozzle 0; empty: it does not
  std::optional<OffsetsIn> offsets_in;       // as the file tells it
  std::string offsets_from;                  // where the file tells it: "extruder_offset of the configuration block"
  std::vector<Vec2> firmware_offset_mm;      // as the file sets it in the firmware (M218); empty: it does not
  bool volumetric_e = false;                 // E counts mm3
  bool docks_tools = false;                  // while they idle: a Prusa XL, by its configuration
  bool per_minute_limits = false;            // M203 and M566 are in mm/min (RepRapFirmware)
  std::vector<double> filament_diameter_mm;  // by tool; empty where the file does not say
  std::vector<double> filament_density_g_cm3;
  std::vector<std::string> filament_colour;  // "#RRGGBB"
  double told_time_s = 0;                    // the slicer's own estimate; 0: none
};

/// Of an option of the configuration block, as it is told last; empty: not told.
std::string_view last_value(const GcodeFacts& facts, std::string_view key);

struct GcodePrint {
  std::string name;                         // of the file, for messages
  std::shared_ptr<const std::string> text;  // of the file, verbatim
  GcodeFacts facts;
  std::vector<GcodeMove> moves;
  std::vector<GcodeEvent> events;       // in their order
  std::vector<GcodeLayer> layers;       // ascending; at least one where plastic is laid
  int tools = 1;                        // highest tool in use + 1
  std::vector<UnknownCommand> unknown;  // by name
  std::vector<std::string> warnings;
};

/// Whether move i lays plastic along X or Y, from a place that is known.
bool lays_plastic(const GcodePrint& print, std::size_t i);

/// How far move i goes along X and Y.  Requires: i > 0.
double way_mm(const GcodePrint& print, std::size_t i);

/// The number of the line that begins at or contains this byte, from 1.  Cost: counts from the start of the text.
std::size_t line_number(std::string_view text, std::size_t offset);

/// The line itself, without its end.
std::string_view line_at(std::string_view text, std::size_t offset);

}  // namespace cleancolor
