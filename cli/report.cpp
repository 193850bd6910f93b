#include "cli/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/duration_text.hpp"
#include "summary_json.hpp"

namespace cleancolor {

namespace {

std::string turn_text(const std::optional<int>& degrees) {
  return degrees ? fmt::format("{} degrees", *degrees) : "none has room";
}

std::string protection_table(const Protection& p) {
  std::string text;
  if (p.azimuths && p.azimuths->best_deg)
    text += fmt::format(
        "{:<14}{:g} degrees: idle nozzles hover for {:.1f} s over visible plastic of another colour, "
        "not turned {:.1f} s\n",
        "azimuth", p.azimuth_deg, at_azimuth(p.azimuths->exposure_s, int(p.azimuth_deg)), p.azimuths->exposure_s[0]);
  else if (p.azimuth_deg != 0)
    text += fmt::format("{:<14}{:g} degrees, as asked for\n", "azimuth", p.azimuth_deg);
  if (p.rampart != RampartShape::off)
    text += fmt::format("{:<14}{}, {:.2f} g\n", "rampart",
                        p.rampart == RampartShape::vertical ? "vertical" : "conforming", p.rampart_g);
  return text;
}

}  // namespace

std::string summary_table(const Summary& summary, const SliceRequest& request) {
  std::string table = fmt::format("{}\n", request.output.string());
  table += fmt::format("{:<14}{}\n", "layers", summary.layers);
  table += fmt::format("{:<14}{}\n", "tool changes", summary.tool_changes);
  table += fmt::format("{:<14}{}\n", "time", duration_text(summary.time_s));
  table += protection_table(summary.protection) + "\n";

  const bool has_cost = std::ranges::any_of(summary.extruders, [](const ExtruderUse& e) { return e.cost > 0; });
  table += fmt::format("{:<10}{:<12}{:>12}{:>10}{}\n", "extruder", "material", "filament", "weight",
                       has_cost ? fmt::format("{:>10}", "cost") : "");
  for (std::size_t i = 0; i < summary.extruders.size(); ++i) {
    const ExtruderUse& use = summary.extruders[i];
    if (use.filament_mm == 0) continue;
    table += fmt::format("{:<10}{:<12}{:>10.3f} m{:>8.2f} g{}\n", i + 1, request.config.extruders.at(i).filament_type,
                         use.filament_mm / 1000, use.filament_g, has_cost ? fmt::format("{:>10.2f}", use.cost) : "");
  }
  return table;
}

std::string summary_json(const Summary& summary, const SliceRequest& request,
                         const std::vector<std::string>& warnings) {
  nlohmann::ordered_json json;
  json["output"] = request.output.string();
  json.update(summary_fields(summary));
  json["warnings"] = warnings;
  // File names need not be UTF-8; JSON must be.
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string azimuth_table(const Azimuths& azimuths) {
  std::string table = fmt::format("{:<22}{:>16}{:>20}{:>24}\n", "", "turned by", "exposure, s", "interference, mm3");
  const auto row = [&](std::string_view name, const std::optional<int>& degrees) {
    table += fmt::format("{:<22}{:>16}", name, turn_text(degrees));
    if (degrees)
      table += fmt::format("{:>20.1f}{:>24.1f}", at_azimuth(azimuths.exposure_s, *degrees),
                           at_azimuth(azimuths.interference_mm3, *degrees));
    table += '\n';
  };
  row("as it is", 0);
  if (azimuths.tried_deg) row("chosen, by trial", azimuths.tried_deg);
  row(azimuths.tried_deg ? "by exposure" : "chosen, by exposure", azimuths.best_deg);
  row("by interference", azimuths.least_interference_deg);
  table += fmt::format("\nplastic of the part: {:.1f} mm3\n", azimuths.part_mm3);
  if (std::ranges::max(azimuths.interference_mm3) == 0)
    table += "no idle nozzle meets another colour at any angle\n";
  else if (azimuths.tried_deg)
    table += "chosen is where the plans of some layers smear least; no turn where turning brings little\n";
  else if (azimuths.best_deg)
    table += "chosen is the smallest turn that is about as good as the best\n";
  return table;
}

std::string azimuth_json(const Azimuths& azimuths) {
  return azimuth_fields(azimuths).dump(2) + "\n";
}

}  // namespace cleancolor
