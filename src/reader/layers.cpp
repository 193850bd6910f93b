#include "reader/layers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cleancolor {
namespace {

constexpr double same_height_mm = 0.02;
constexpr std::uint32_t none = ~std::uint32_t{0};

struct Way {
  Vec3 from_mm;
  double length_mm = 0;
};

/// Of move i, along X and Y; 0 where its start is not known.
Way way(const GcodePrint& print, std::size_t i) {
  const GcodeMove& move = print.moves[i];
  if (i == 0 || !move.known_start) return {move.to_mm, 0};
  const Vec3 from = print.moves[i - 1].to_mm;
  return {from, distance(Vec2{from.x, from.y}, Vec2{move.to_mm.x, move.to_mm.y})};
}

bool lays_plastic(const GcodeMove& move, const Way& w) {
  return move.filament_mm > 0 && w.length_mm > 0;
}

bool rises(const GcodeMove& move, const Way& w) {
  return std::abs(move.to_mm.z - w.from_mm.z) > 1e-4;
}

/// The usual step between heights: bands of this height hold moves that rise while they print.
double usual_step(const std::vector<double>& heights) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < heights.size(); ++i)
    if (const double step = heights[i] - heights[i - 1]; step > same_height_mm) steps.push_back(step);
  if (steps.empty()) return 0.2;
  std::ranges::nth_element(steps, steps.begin() + std::ptrdiff_t(steps.size() / 2));
  return std::clamp(steps[steps.size() / 2], 0.05, 1.0);
}

/// Ascending heights at which plastic is laid, those closer than same_height_mm joined.
std::vector<double> heights_of(const GcodePrint& print) {
  std::vector<double> flat;
  std::vector<double> rising;
  double last = std::nan("");
  for (std::size_t i = 0; i < print.moves.size(); ++i) {
    const Way w = way(print, i);
    if (!lays_plastic(print.moves[i], w)) continue;
    const double z = print.moves[i].to_mm.z;
    if (rises(print.moves[i], w)) {
      rising.push_back(z);
    } else if (z != last) {
      flat.push_back(last = z);
    }
  }
  std::ranges::sort(flat);
  std::vector<double> heights;
  for (const double z : flat)
    if (heights.empty() || z - heights.back() > same_height_mm) heights.push_back(z);
  if (rising.empty()) return heights;
  // A rising move belongs to a height just above it where there is one, else to a band of its own.
  const double step = usual_step(heights);
  std::ranges::sort(rising);
  std::vector<double> bands;
  for (const double z : rising) {
    const auto above = std::ranges::lower_bound(heights, z - same_height_mm);
    if (above != heights.end() && *above - z < step) continue;
    if (bands.empty() || z > bands.back() + same_height_mm) bands.push_back(z + step / 2);
  }
  heights.insert(heights.end(), bands.begin(), bands.end());
  std::ranges::sort(heights);
  return heights;
}

std::uint32_t layer_at(const std::vector<double>& heights, double z) {
  const auto above = std::ranges::lower_bound(heights, z - same_height_mm);
  const auto index = above == heights.end() ? heights.size() - 1 : std::size_t(above - heights.begin());
  // Of two heights the nearer one: z may stand a little above the lower.
  if (index > 0 && z - heights[index - 1] < heights[index] - z && z - heights[index - 1] <= same_height_mm)
    return std::uint32_t(index - 1);
  return std::uint32_t(index);
}

/// Moves that lay nothing: up to the plastic laid next, or still with that laid last.
void assign_travel(GcodePrint& print, const std::vector<double>& heights) {
  std::uint32_t next = none;
  std::vector<std::uint32_t> ahead(print.moves.size(), none);  // layer of the plastic laid next
  for (std::size_t i = print.moves.size(); i-- > 0;) {
    if (print.moves[i].layer != none) next = print.moves[i].layer;
    ahead[i] = next;
  }
  std::uint32_t last = none;
  bool arrived = false;  // at the height of the plastic laid next
  for (std::size_t i = 0; i < print.moves.size(); ++i) {
    GcodeMove& move = print.moves[i];
    if (move.layer != none) {
      last = move.layer;
      arrived = false;
      continue;
    }
    const std::uint32_t to = ahead[i];
    if (to == none || to == last) {
      move.layer = last;
    } else {
      arrived = arrived || last == none || to < last || move.to_mm.z >= heights[to] - same_height_mm;
      move.layer = arrived ? to : last;
    }
  }
}

}  // namespace

void assign_layers(GcodePrint& print, const std::vector<double>& filament_area_mm2) {
  const std::vector<double> heights = heights_of(print);
  std::vector<float> told(heights.size(), 0), part_told(heights.size(), 0);
  std::vector<bool> has_part(heights.size(), false);
  for (std::size_t i = 0; i < print.moves.size(); ++i) {
    GcodeMove& move = print.moves[i];
    move.layer = none;
    if (!lays_plastic(move, way(print, i))) continue;
    move.layer = layer_at(heights, move.to_mm.z);
    told[move.layer] = std::max(told[move.layer], move.height_mm);
    if (!is_auxiliary(move.role)) {
      has_part[move.layer] = true;
      if (part_told[move.layer] == 0) part_told[move.layer] = move.height_mm;
    }
  }
  assign_travel(print, heights);

  print.layers.clear();
  double below = 0;  // a support between two layers of the part does not make them thinner
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const double step = heights[k] - below;
    const float said = part_told[k] > 0 ? part_told[k] : told[k];
    print.layers.push_back({heights[k], said > 0 ? double(said) : step > 0 ? step : 0.2});
    if (has_part[k]) below = heights[k];
  }
  for (std::size_t i = 0; i < print.moves.size(); ++i) {
    GcodeMove& move = print.moves[i];
    const Way w = way(print, i);
    if (!lays_plastic(move, w)) continue;
    if (move.height_mm <= 0) move.height_mm = float(print.layers[move.layer].height_mm);
    if (move.width_mm > 0) continue;
    const double h = std::max(double(move.height_mm), 0.01);
    const double area = move.filament_mm * filament_area_mm2[move.feeds] / w.length_mm;
    move.width_mm = float(std::clamp(area / h + h * (1 - std::numbers::pi / 4), 0.05, 5.0));
  }
}

}  // namespace cleancolor
