#include "replan/refusals.hpp"

#include <fmt/format.h>

#include <cmath>

#include "model/text_scan.hpp"
#include "reader/known_commands.hpp"

namespace cleancolor {

namespace {

bool is_temperature(const GcodeLine& line) {
  return line.letter == 'M' && (line.number == 104 || line.number == 109 || line.number == 140 || line.number == 190);
}

}  // namespace

std::optional<std::string> fault_of_g(const GcodeLine& line, std::string_view raw) {
  switch (line.number) {
    case 0:
    case 1:
      return std::nullopt;
    case 2:
    case 3:
      if (line.has('I') || line.has('J')) return std::nullopt;
      return "an arc without its centre (I J) is not re-planned; switch off arc fitting in the slicer";
    case 10:
      if (line.has_value('P')) return std::nullopt;  // a temperature of RepRapFirmware's
      [[fallthrough]];
    case 11:
      return "the firmware draws filament back; switch off use_firmware_retraction in the slicer (Cura: "
             "machine_firmware_retract)";
    case 92:
      if (!line.has('X') && !line.has('Y') && !line.has('Z')) return std::nullopt;
      return "G92 moves the origin among the layers";
    default:
      return fmt::format("'{}' among the layers: it cannot be moved; take it out of the slicer's custom G-code",
                         shown(trimmed(raw)));
  }
}

std::optional<std::string> fault_of_command(const GcodeLine& line, std::string_view raw, bool knows_tool) {
  if (is_temperature(line)) {
    const bool bed = line.number == 140 || line.number == 190;
    if (bed || line.has_value('T') || knows_tool) return std::nullopt;
    return "a temperature without a tool (T) among the layers: it would reach another one";
  }
  const bool stops =
      line.number == 600 || line.number == 601 || line.number == 25 || (line.letter == 'M' && line.number <= 1);
  if (is_harmless(line) && !stops) return std::nullopt;
  return fmt::format(
      "'{}' among the layers: it cannot be moved, nor left where it is; take it out of the slicer's custom G-code",
      shown(trimmed(raw)));
}

std::optional<std::string> fault_of_road(const GcodeMove& move, Vec3 from, int tool, const DialectWords& words) {
  if (std::abs(from.z - move.to_mm.z) > same_height_mm)
    return "a road that rises (vase mode, scarf seam) is not re-planned; switch it off in the slicer";
  if (move.tool != move.feeds || move.tool != tool) return "a road of another tool than the one in use";
  switch (move.role) {
    case Role::wipe_tower:
      if (words.tower_is_roads) return std::nullopt;
      return "a road of the wipe tower outside of it";
    case Role::custom:
      return "a road of custom G-code among the layers cannot be moved";
    case Role::unknown:
      return "the file does not say what this road is (;TYPE:)";
    default:
      return std::nullopt;
  }
}

}  // namespace cleancolor
