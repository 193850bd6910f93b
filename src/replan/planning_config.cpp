#include "replan/planning_config.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "model/ini.hpp"
#include "model/text_scan.hpp"
#include "replan/cura.hpp"
#include "replan/file_parts.hpp"

namespace cleancolor {
namespace {

struct RefusedOption {
  std::string_view key;
  std::string_view reason;
};
constexpr RefusedOption refused_options[] = {
    {"spiral_vase", "vase mode is one road from bottom to top; there is nothing to put in order"},
    {"single_extruder_multi_material", "filament changes in one nozzle, so that no idle nozzle can ooze"},
    {"use_firmware_retraction", "the firmware draws filament back; switch it off in the slicer"},
    {"use_volumetric_e", "E in mm3 is not re-planned yet; switch it off in the slicer"},
    {"infill_first", "infill before perimeters is not re-planned yet; switch it off in the slicer"},
    {"wall_sequence",
     "outer walls between inner ones are not re-planned; print them from the inside out or the outside in"},
};

/// Whether the option keeps nozzles from being lifted in some of the print's layers; 0 says nothing.
bool lifts_in_some_layers(const IniEntry& entry, const GcodePrint& print) {
  if (entry.key == "retract_lift_top") return entry.value.find("All ") == std::string::npos;
  const bool above = entry.key == "retract_lift_above", below = entry.key == "retract_lift_below";
  if (!above && !below) return false;
  for (std::string_view rest = entry.value; !rest.empty();) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const double z_mm = number<double>(trimmed(rest.substr(0, comma))).value_or(0);
    if (z_mm > 0 && (above ? z_mm > print.layers.front().z_mm : z_mm < print.layers.back().z_mm)) return true;
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return false;
}

/// The printer's, and over it what the configuration block of the file says.
Config told_config(const GcodePrint& print, const Config* printer) {
  if (print.facts.config.empty() || print.facts.config_kind.empty())
    throw Error(
        fmt::format("{}: it has no configuration block at its end; it is not known how far filament is drawn "
                    "back. Export the G-code again with it",
                    print.name));
  std::vector<IniEntry> told = print.facts.config_kind == "orcaslicer"       ? from_orca(print.facts.config)
                               : print.facts.dialect == Dialect::superslicer ? from_superslicer(print.facts.config)
                                                                             : print.facts.config;
  for (const IniEntry& entry : told)
    for (const RefusedOption& option : refused_options)
      if (entry.key == option.key && is_set(entry.value))
        throw Error(fmt::format("{}: {} = {}: {}", print.name, entry.key, entry.value, option.reason));
  for (const IniEntry& entry : told)
    if (lifts_in_some_layers(entry, print))
      throw Error(fmt::format("{}: {} = {}: lifting in some layers only is not re-planned yet; switch it off",
                              print.name, entry.key, entry.value));
  std::erase_if(told, [](const IniEntry& entry) { return entry.key == "skirt_height"; });  // -1 of Slic3r: all layers
  return with_ini(printer != nullptr ? *printer : Config{}, told, print.name).config;
}

}  // namespace

Config planning_config(const GcodePrint& print, const AuditMachine& machine, const Config* printer) {
  Config config =
      print.facts.dialect == Dialect::cura ? cura_config(print, machine, printer) : told_config(print, printer);
  const std::size_t nozzles = machine.nozzles.size();
  while (config.extruders.size() < nozzles) config.extruders.push_back(config.extruders.back());
  config.extruders.resize(nozzles);
  for (std::size_t n = 0; n < nozzles; ++n) config.extruders[n].nozzle_offset_mm = machine.nozzles[n].offset_mm;
  config.offsets_in = machine.offsets_in;
  config.idle_nozzle = machine.idle_nozzle;
  config.planner = Planner::clean;
  config.seam_position = SeamPosition::hidden;
  config.join_perimeters = true;
  config.heater_off_after_last_use = false;   // the file's own temperatures hold
  config.rampart = RampartShape::conforming;  // walls that wipe and fill, be it after a tool was parked
  config.refill_mode = RefillMode::model;
  return config;
}

}  // namespace cleancolor
