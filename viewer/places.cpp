#include "viewer/places.hpp"

#include <array>
#include <cmath>

#include "audit/timeline.hpp"
#include "base/parallel.hpp"
#include "viewer/array_file.hpp"

namespace cleancolor {
namespace {

constexpr std::uint32_t moves_per_box = 16384;

/// Of each move in the middle of the road that it lays.
std::vector<std::uint8_t> visibility(const GcodePrint& print, const AuditMachine& machine, const AuditResult& result,
                                     int threads) {
  const std::size_t count = print.moves.size();
  std::vector<std::uint8_t> visible(count);
  const auto blocks = int((count + moves_per_box - 1) / moves_per_box);
  parallel_for(blocks, thread_count(threads), [&](int block) {
    const std::uint32_t first = std::uint32_t(block) * moves_per_box;
    const auto last = std::uint32_t(std::min(count, std::size_t(first) + moves_per_box));
    for (const Drive& d : drives(print, machine, *result.time, first, last)) {
      if (!d.lays) continue;
      const Vec2 offset = nozzle_offset_mm(machine, d.feeds);
      const Vec2 a = d.from_mm + offset, b = d.to_mm + offset, middle = lerp(a, b, 0.5);
      const double v = result.visibility->at({middle.x, middle.y, print.layers[d.layer].z_mm}, a, b);
      visible[d.move] = std::uint8_t(std::lround(v * 255));
    }
  });
  return visible;
}

void add_point(std::vector<float>& points, Vec2 at_mm, double z_mm) {
  points.insert(points.end(), {float(at_mm.x), float(at_mm.y), float(z_mm)});
}

}  // namespace

PlaceArrays place_arrays(const GcodePrint& print, const AuditMachine& machine, const AuditResult& result, int threads) {
  const ScenarioResult& scenario = result.scenarios.front();
  PlaceArrays arrays;
  arrays.visibility = visibility(print, machine, result, threads);
  for (const Figures& figures : scenario.layers) {
    arrays.layer_smear.push_back(float(figures.smear_volume()));
    arrays.layer_hole.push_back(float(figures.hole_volume));
    arrays.layer_zippers.push_back(float(figures.zippers));
  }
  for (const Place& p : scenario.places) {
    add_point(arrays.place_from, p.at_mm, print.layers[p.layer].z_mm);
    add_point(arrays.place_to, p.end_mm, print.layers[p.layer].z_mm);
    arrays.place_mm3.push_back(p.mm3);
    arrays.place_visibility.push_back(p.visibility);
    arrays.place_layer.push_back(p.layer);
    arrays.place_move.push_back(p.move);
    arrays.place_kind.push_back(std::uint8_t(p.kind));
    arrays.place_nozzle.push_back(p.nozzle);
    arrays.place_over.push_back(p.over);
  }
  arrays.worst = defects(scenario);
  return arrays;
}

std::string places_file(const PlaceArrays& p, const Figures& total, const Scenario& scenario,
                        const AuditMachine& machine) {
  nlohmann::ordered_json header = {{"worst", nlohmann::ordered_json::array()},
                                   {"worst_mm3", nlohmann::ordered_json::array()},
                                   {"figures", nlohmann::ordered_json::object()},
                                   {"ooze", nlohmann::ordered_json::array()}};
  for (const Defect& defect : p.worst) {
    header["worst"].push_back(defect.place);
    header["worst_mm3"].push_back(std::round(double(defect.mm3) * 1e4) / 1e4);
  }
  for (const FigureInfo& figure : figure_table()) header["figures"][std::string(figure.name)] = figure.of(total);
  for (std::size_t n = 0; n < machine.nozzles.size(); ++n) {
    const OozeParameters& ooze = scenario.ooze[std::min(n, scenario.ooze.size() - 1)];
    header["ooze"].push_back({{"volume_mm3", ooze.volume_mm3}, {"time_s", ooze.time_s}});
  }
  return array_file(
      std::array{named_array("visibility", p.visibility), named_array("layer_smear", p.layer_smear),
                 named_array("layer_hole", p.layer_hole), named_array("layer_zippers", p.layer_zippers),
                 named_array("place_from", p.place_from, 3), named_array("place_to", p.place_to, 3),
                 named_array("place_mm3", p.place_mm3), named_array("place_visibility", p.place_visibility),
                 named_array("place_layer", p.place_layer), named_array("place_move", p.place_move),
                 named_array("place_kind", p.place_kind), named_array("place_nozzle", p.place_nozzle),
                 named_array("place_over", p.place_over)},
      std::move(header));
}

}  // namespace cleancolor
