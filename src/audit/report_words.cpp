#include "audit/report_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/printable.hpp"

namespace cleancolor {
namespace {

constexpr double least_mm3 = 0.001;

AffectedLayers affected(const ScenarioResult& scenario, double (*volume_mm3)(const Figures&)) {
  AffectedLayers found;
  double most_mm3 = 0;
  for (std::uint32_t i = 0; i < scenario.layers.size(); ++i) {
    const double mm3 = volume_mm3(scenario.layers[i]);
    if (mm3 < least_mm3) continue;
    ++found.count;
    if (mm3 <= most_mm3) continue;
    most_mm3 = mm3;
    found.worst = i;
  }
  return found;
}

std::string where_text(const GcodePrint& print, const AffectedLayers& layers) {
  std::string text = fmt::format(" in {} of {} layers", layers.count, print.layers.size());
  if (layers.worst)
    text += fmt::format(", most in layer {} (z {:.2f} mm)", *layers.worst + 1, print.layers[*layers.worst].z_mm);
  return text;
}

bool has_several_colours(const AuditResult& result) {
  return std::ranges::count_if(result.nozzles, [](const NozzleUse& use) { return use.part_mm3 > 0; }) > 1;
}

}  // namespace

std::string figure_text(double value, std::string_view unit) {
  if (unit == "mm3") return fmt::format("{:.2f}", value + 0.0);
  const bool whole = unit == "mm" || std::abs(value - std::round(value)) < 1e-9;
  return whole ? fmt::format("{:.0f}", value + 0.0) : fmt::format("{:.1f}", value);
}

std::string metres_text(double mm) {
  return fmt::format("{:.2f} m", mm / 1000);
}

std::string place_text(const Place& place) {
  return place.kind == Place::Kind::hole ? fmt::format("hole in T{}", place.nozzle)
                                         : fmt::format("smear of T{} over T{}", place.nozzle, place.over);
}

AffectedLayers smeared_layers(const ScenarioResult& scenario) {
  return affected(scenario, [](const Figures& f) { return f.smear_volume(); });
}

AffectedLayers holed_layers(const ScenarioResult& scenario) {
  return affected(scenario, [](const Figures& f) { return f.hole_volume; });
}

std::vector<std::uint32_t> worst_layers(const ScenarioResult& scenario, std::size_t count) {
  const auto mm3 = [&](std::uint32_t i) { return scenario.layers[i].smear_volume() + scenario.layers[i].hole_volume; };
  std::vector<std::uint32_t> layers(scenario.layers.size());
  std::iota(layers.begin(), layers.end(), 0u);
  std::erase_if(layers, [&](std::uint32_t i) { return mm3(i) < least_mm3; });
  std::ranges::stable_sort(layers, [&](std::uint32_t a, std::uint32_t b) { return mm3(a) > mm3(b); });
  layers.resize(std::min(count, layers.size()));
  return layers;
}

std::string verdict(const GcodePrint& print, const AuditResult& result, std::size_t scenario) {
  const ScenarioResult& s = result.scenarios[scenario];
  const AffectedLayers smears = smeared_layers(s), holes = holed_layers(s);
  std::string text = !has_several_colours(result) ? "one colour: nothing to smear"
                     : smears.count == 0          ? "no smears"
                                         : fmt::format("smears: {} mm3", figure_text(s.total.smear_volume(), "mm3"));
  if (smears.count > 0) text += where_text(print, smears);
  text += holes.count == 0 ? "; no holes" : fmt::format("; holes: {} mm3", figure_text(s.total.hole_volume, "mm3"));
  if (holes.count > 0) text += where_text(print, holes);
  return text;
}

std::string_view idle_nozzle_text(IdleNozzle idle) {
  switch (idle) {
    case IdleNozzle::same_height:
      return "at the same height";
    case IdleNozzle::lifted:
      return "lifted";
    case IdleNozzle::parked:
      return "parked beside the bed";
    case IdleNozzle::docked:
      return "docked";
  }
  return "";
}

std::string_view offsets_in_text(OffsetsIn offsets_in) {
  return offsets_in == OffsetsIn::slicer ? "the slicer" : "the firmware";
}

std::string producer_text(const GcodePrint& print) {
  return print.facts.producer.empty() ? "unknown" : printable(print.facts.producer);
}

}  // namespace cleancolor
