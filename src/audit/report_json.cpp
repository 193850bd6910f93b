#include <cmath>
#include <nlohmann/json.hpp>

#include "audit/machine_texts.hpp"
#include "audit/ooze_keys.hpp"
#include "audit/report.hpp"

namespace cleancolor {
namespace {

using Json = nlohmann::ordered_json;

/// Rounded to 0.001, so that the last digits of a sum do not matter; null where it is not finite.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::round(value * 1000) / 1000 + 0.0;
}

Json point(Vec2 p) {
  return Json::array({number(p.x), number(p.y)});
}

std::string kind_name(Place::Kind kind) {
  return kind == Place::Kind::hole ? "hole" : "smear";
}

Json machine_json(const AuditMachine& machine) {
  Json nozzles = Json::array();
  for (const AuditNozzle& n : machine.nozzles) {
    constexpr char digits[] = "0123456789ABCDEF";
    std::string colour = "#";
    for (int shift = 20; shift >= 0; shift -= 4) colour += digits[n.rgb >> shift & 15];
    nozzles.push_back({{"offset_mm", point(n.offset_mm)},
                       {"filament_diameter_mm", number(n.filament_diameter_mm)},
                       {"filament_density_g_cm3", number(n.filament_density_g_cm3)},
                       {"colour", colour}});
  }
  return {{"nozzles", nozzles},
          {"offsets_source", machine.offsets_source},
          {"offsets_in", machine.offsets_in == OffsetsIn::slicer ? "slicer" : "firmware"},
          {"offsets_in_source", machine.offsets_in_source},
          {"idle_nozzle", idle_nozzle_word(machine.idle_nozzle)}};
}

Json print_json(const GcodePrint& print, const AuditResult& result) {
  Json nozzles = Json::array();
  for (std::size_t i = 0; i < result.nozzles.size(); ++i) {
    const NozzleUse& use = result.nozzles[i];
    nozzles.push_back({{"nozzle", i},
                       {"part_filament_mm", number(use.part_filament_mm)},
                       {"part_mm3", number(use.part_mm3)},
                       {"part_g", number(use.part_g)},
                       {"auxiliary_filament_mm", number(use.auxiliary_filament_mm)},
                       {"auxiliary_mm3", number(use.auxiliary_mm3)},
                       {"auxiliary_g", number(use.auxiliary_g)}});
  }
  return {{"layers", result.layers},
          {"height_mm", number(print.layers.empty() ? 0 : print.layers.back().z_mm)},
          {"tool_changes", result.tool_changes},
          {"time_s", number(result.print_time_s)},
          {"travel_mm", number(result.travel_mm)},
          {"nozzles", nozzles}};
}

Json figures_json(const Figures& figures, bool main_only) {
  Json json = Json::object();
  for (const FigureInfo& f : figure_table())
    if (f.main || !main_only) json[std::string(f.name)] = number(f.of(figures));
  return json;
}

Json ooze_json(const Scenario& scenario) {
  Json nozzles = Json::array();
  for (const OozeParameters& ooze : scenario.ooze) {
    Json json = Json::object();
    for (const OozeKey& key : ooze_keys()) {
      const std::string name(key.field_name);
      if (key.unit.empty())
        json[name] = key.of(ooze) != 0;
      else
        json[name] = number(key.of(ooze));
    }
    nozzles.push_back(json);
  }
  return nozzles;
}

Json rules_json(const OozeRules& rules) {
  return {{"tireless", rules.tireless},
          {"printed_only", rules.printed_only},
          {"own_empties", rules.own_empties},
          {"touch_mm", number(rules.touch_mm)}};
}

Json layers_json(const GcodePrint& print, const ScenarioResult& result) {
  Json layers = Json::array();
  for (std::size_t i = 0; i < result.layers.size(); ++i) {
    Json layer = {{"layer", i + 1}, {"z_mm", number(print.layers[i].z_mm)}};
    layer.update(figures_json(result.layers[i], true));
    layers.push_back(layer);
  }
  return layers;
}

Json places_json(const GcodePrint& print, const ScenarioResult& result, std::size_t count) {
  Json places = Json::array();
  for (const Place& p : worst_places(result, count)) {
    places.push_back({{"kind", kind_name(p.kind)},
                      {"nozzle", p.nozzle},
                      {"over", p.over},
                      {"travel", p.travel},
                      {"layer", p.layer + 1},
                      {"z_mm", number(print.layers[p.layer].z_mm)},
                      {"at_mm", point(p.at_mm)},
                      {"mm3", number(double(p.mm3))},
                      {"visibility", number(double(p.visibility))},
                      {"length_mm", number(double(p.length_mm))}});
  }
  return places;
}

Json scenario_json(const AuditedFile& file, std::size_t s, std::size_t places) {
  const ScenarioResult& result = file.result->scenarios[s];
  const Scenario& scenario = (*file.scenarios)[s];
  Json pairs = Json::array();
  for (const PairFigures& pair : result.pairs)
    pairs.push_back({{"nozzle", pair.nozzle}, {"over", pair.over}, {"figures", figures_json(pair.figures, false)}});
  return {{"help", scenario.help},
          {"ooze", ooze_json(scenario)},
          {"rules", rules_json(scenario.rules)},
          {"figures", figures_json(result.total, false)},
          {"pairs", pairs},
          {"layers", layers_json(*file.print, result)},
          {"places", places_json(*file.print, result, places)}};
}

Json file_json(const AuditedFile& file, std::size_t places) {
  Json scenarios = Json::object();
  for (std::size_t s = 0; s < file.result->scenarios.size(); ++s)
    scenarios[file.result->scenarios[s].name] = scenario_json(file, s, places);
  Json unknown = Json::array();
  for (const UnknownCommand& u : file.print->unknown)
    unknown.push_back({{"name", u.name}, {"count", u.count}, {"first_line", u.first_line}});
  return {{"name", file.name},
          {"producer", file.print->facts.producer},
          {"machine", machine_json(*file.machine)},
          {"print", print_json(*file.print, *file.result)},
          {"scenarios", scenarios},
          {"unknown_commands", unknown},
          {"warnings", file.warnings}};
}

/// File names and comments need not be UTF-8; JSON must be.
std::string text_of(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string audit_file_json(const AuditedFile& file, const ReportOptions& options) {
  return text_of(file_json(file, options.places));
}

std::string audit_json(std::span<const AuditedFile> files, const ReportOptions& options) {
  Json all = Json::array();
  for (const AuditedFile& file : files) all.push_back(file_json(file, options.places));
  return text_of({{"schema", 1}, {"files", all}});
}

}  // namespace cleancolor
