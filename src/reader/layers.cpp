#include "reader/layers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cleancolor {
namespace {

constexpr double same_height_mm = 0.02;
constexpr double rounding_mm = 1e-9;
constexpr double usual_step_mm = 0.2;
constexpr double flat_share = 0.25;
constexpr std::uint32_t none = ~std::uint32_t{0};

double z_of(const GcodePrint& print, std::size_t i) {
  return print.moves[i].to_mm.z;
}

struct Heights {
  std::vector<double> flat;    // where plastic is laid at one height
  std::vector<double> rising;  // where it is laid on the way up
};

/// One run of moves [first, last) that lay plastic without a break. Vase mode rises all along, by steps so small that
/// many a chord is level: level plastic counts as flat only where it is a good part of its run.
void add_run(const GcodePrint& print, std::size_t first, std::size_t last, Heights& heights) {
  double length = 0;
  for (std::size_t i = first; i < last; ++i) length += way_mm(print, i);
  for (std::size_t i = first; i < last;) {
    const double z = z_of(print, i);
    const bool rises = z != z_of(print, i - 1);
    double level = 0;
    std::size_t end = i + (rises ? 1 : 0);
    for (; end < last && z_of(print, end) == z; ++end) level += way_mm(print, end);
    if (level > 0 && level >= flat_share * length) {
      if (heights.flat.empty() || heights.flat.back() != z) heights.flat.push_back(z);
    } else {
      heights.rising.push_back(z);
    }
    i = end;
  }
}

Heights heights_of(const GcodePrint& print) {
  Heights heights;
  for (std::size_t i = 0; i < print.moves.size();) {
    std::size_t end = i;
    while (end < print.moves.size() && lays_plastic(print, end)) ++end;
    if (end > i) add_run(print, i, end, heights);
    i = end + (end > i ? 0 : 1);
  }
  std::ranges::sort(heights.flat);
  std::ranges::sort(heights.rising);
  return heights;
}

/// Of sorted heights, the lowest of each group that is one.
std::vector<double> joined(const std::vector<double>& sorted) {
  std::vector<double> heights;
  for (const double z : sorted)
    if (heights.empty() || z - heights.back() > same_height_mm + rounding_mm) heights.push_back(z);
  return heights;
}

/// Height of the bands for moves that rise: the usual step between flat layers, else what the file tells.
double band_mm(const GcodePrint& print, const std::vector<double>& flat) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < flat.size(); ++i) steps.push_back(flat[i] - flat[i - 1]);
  if (!steps.empty()) {
    std::ranges::nth_element(steps, steps.begin() + std::ptrdiff_t(steps.size() / 2));
    return std::clamp(steps[steps.size() / 2], 0.05, 1.0);
  }
  const auto told = std::ranges::find_if(print.moves, [](const GcodeMove& m) { return m.height_mm > 0; });
  return told != print.moves.end() ? std::clamp(double(told->height_mm), 0.05, 1.0) : usual_step_mm;
}

/// Flat heights, and bands between them for what rises further below the next flat height than one layer.
std::vector<double> with_bands(const std::vector<double>& flat, const std::vector<double>& rising, double band) {
  std::vector<double> all = flat;
  for (const double z : rising) {
    const auto above = std::ranges::lower_bound(flat, z - same_height_mm);
    if (above != flat.end() && *above - z < band) continue;
    const double base = above == flat.begin() ? 0 : *(above - 1);
    const double top = base + band * std::ceil((z - base - same_height_mm) / band);
    if (all.size() == flat.size() || top > all.back()) all.push_back(top);
  }
  std::ranges::sort(all);
  return joined(all);
}

std::uint32_t layer_at(const std::vector<double>& heights, double z) {
  const auto above = std::ranges::lower_bound(heights, z - same_height_mm - rounding_mm);
  const std::ptrdiff_t index = std::min(above - heights.begin(), std::ptrdiff_t(heights.size()) - 1);
  return std::uint32_t(index);
}

/// Moves that lay nothing: up to the plastic laid next, or still with that laid last.
void assign_travel(GcodePrint& print) {
  std::uint32_t last = none;
  for (std::size_t i = 0; i < print.moves.size();) {
    std::size_t next = i;
    while (next < print.moves.size() && print.moves[next].layer == none) ++next;
    const std::uint32_t to = next < print.moves.size() ? print.moves[next].layer : last;
    bool arrived = last == none || to <= last;
    for (; i < next; ++i) {
      arrived = arrived || z_of(print, i) >= print.layers[to].z_mm - same_height_mm;
      print.moves[i].layer = arrived ? to : last;
    }
    for (; i < print.moves.size() && print.moves[i].layer != none; ++i) last = print.moves[i].layer;
  }
}

/// Bridges are told to be as high as their round strands, not as their layer.
bool tells_layer_height(const GcodeMove& move) {
  return move.height_mm > 0 && move.role != Role::bridge_infill && move.role != Role::overhang_perimeter;
}

/// Requires: layers of the moves that lay plastic.
std::vector<GcodeLayer> layers_of(const GcodePrint& print, const std::vector<double>& heights) {
  std::vector<double> told_of_part(heights.size(), 0), told(heights.size(), 0);
  std::vector<bool> has_part(heights.size(), false);
  for (const GcodeMove& move : print.moves) {
    if (move.layer == none) continue;
    const bool part = !is_auxiliary(move.role);
    if (part) has_part[move.layer] = true;
    double& first = part ? told_of_part[move.layer] : told[move.layer];
    if (first == 0 && tells_layer_height(move)) first = move.height_mm;
  }
  std::vector<GcodeLayer> layers;
  double below = 0;  // a support between two layers of the part does not make them thinner
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const double said = told_of_part[k] > 0 ? told_of_part[k] : told[k];
    const double step = heights[k] - below;
    layers.push_back({heights[k], said > 0 ? said : step > 0 ? step : usual_step_mm});
    if (has_part[k]) below = heights[k];
  }
  return layers;
}

/// Of a road with this cross-section: half circles at both sides; thinner than it is high, a round strand.
double width_mm(double area_mm2, double height_mm) {
  if (area_mm2 < std::numbers::pi / 4 * height_mm * height_mm) return 2 * std::sqrt(area_mm2 / std::numbers::pi);
  return area_mm2 / height_mm + height_mm * (1 - std::numbers::pi / 4);
}

}  // namespace

void assign_layers(GcodePrint& print, const std::vector<double>& filament_area_mm2) {
  const Heights found = heights_of(print);
  const std::vector<double> flat = joined(found.flat);
  const std::vector<double> heights =
      found.rising.empty() ? flat : with_bands(flat, found.rising, band_mm(print, flat));
  for (std::size_t i = 0; i < print.moves.size(); ++i)
    print.moves[i].layer = lays_plastic(print, i) ? layer_at(heights, z_of(print, i)) : none;
  print.layers = layers_of(print, heights);

  for (std::size_t i = 0; i < print.moves.size(); ++i) {
    GcodeMove& move = print.moves[i];
    if (move.layer == none) {
      move.width_mm = move.height_mm = 0;
      continue;
    }
    if (move.height_mm <= 0) move.height_mm = float(print.layers[move.layer].height_mm);
    if (move.width_mm > 0) continue;
    const double area = move.filament_mm * filament_area_mm2[move.feeds] / way_mm(print, i);
    move.width_mm = float(std::clamp(width_mm(area, move.height_mm), 0.01, 10.0));
  }
  assign_travel(print);
}

}  // namespace cleancolor
