#include "summary_json.hpp"

#include <nlohmann/json.hpp>

namespace cleancolor {

nlohmann::ordered_json summary_fields(const Summary& summary) {
  nlohmann::ordered_json json;
  json["layers"] = summary.layers;
  json["tool_changes"] = summary.tool_changes;
  json["time_s"] = summary.time_s;
  json["extruders"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < summary.extruders.size(); ++i) {
    const ExtruderUse& use = summary.extruders[i];
    json["extruders"].push_back(
        {{"extruder", i + 1}, {"filament_mm", use.filament_mm}, {"filament_g", use.filament_g}, {"cost", use.cost}});
  }
  json["azimuth_deg"] = summary.protection.azimuth_deg;
  json["rampart_g"] = summary.protection.rampart_g;
  return json;
}

nlohmann::ordered_json azimuth_fields(const Azimuths& azimuths) {
  const auto degrees = [](const std::optional<int>& turn) {
    return turn ? nlohmann::ordered_json(*turn) : nlohmann::ordered_json();
  };
  nlohmann::ordered_json json;
  json["chosen_deg"] = degrees(azimuths.chosen_deg());
  json["best_deg"] = degrees(azimuths.best_deg);
  json["least_interference_deg"] = degrees(azimuths.least_interference_deg);
  json["part_mm3"] = azimuths.part_mm3;
  json["exposure_s"] = azimuths.exposure_s;
  json["interference_mm3"] = azimuths.interference_mm3;
  json["fits"] = nlohmann::ordered_json::array();
  for (const char fits : azimuths.fits) json["fits"].push_back(fits != 0);
  return json;
}

}  // namespace cleancolor
