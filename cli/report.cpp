#include "cli/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/duration_text.hpp"

namespace cleancolor {

std::string summary_table(const Summary& summary, const SliceRequest& request) {
  std::string table = fmt::format("{}\n", request.output.string());
  table += fmt::format("{:<14}{}\n", "layers", summary.layers);
  table += fmt::format("{:<14}{}\n", "tool changes", summary.tool_changes);
  table += fmt::format("{:<14}{}\n\n", "time", duration_text(summary.time_s));

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
  json["layers"] = summary.layers;
  json["tool_changes"] = summary.tool_changes;
  json["time_s"] = summary.time_s;
  json["extruders"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < summary.extruders.size(); ++i) {
    const ExtruderUse& use = summary.extruders[i];
    json["extruders"].push_back(
        {{"extruder", i + 1}, {"filament_mm", use.filament_mm}, {"filament_g", use.filament_g}, {"cost", use.cost}});
  }
  json["warnings"] = warnings;
  // File names need not be UTF-8; JSON must be.
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace cleancolor
