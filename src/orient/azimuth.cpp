#include "orient/azimuth.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/parallel.hpp"
#include "orient/exposure.hpp"
#include "orient/interference.hpp"

namespace cleancolor {
namespace {

constexpr int angle_count = 360;
constexpr double same_exposure = 0.25;  // of the least: smears follow it no closer
constexpr double worth_a_turn = 0.4;    // likewise: below it the part stays as it is
constexpr double worth_a_trial = 0.5;   // likewise
constexpr int valley_deg = 8;           // of two valleys nearer than this one counts
constexpr std::size_t most_valleys = 3;
constexpr double negligible_exposure = 0.01;  // of the largest
constexpr double same_interference = 1e-3;    // share of the part

/// 0, 1, -1, 2, -2, ... 180: the smallest turn first.
std::vector<int> turns() {
  std::vector<int> all{0};
  for (int a = 1; a < angle_count / 2; ++a) all.insert(all.end(), {a, -a});
  all.push_back(angle_count / 2);
  return all;
}

/// The smallest turn that fits and is as good as the best that fits, give or take.
std::optional<int> least(const std::vector<double>& curve, const std::vector<char>& fits, double share,
                         double tolerance) {
  std::optional<int> best;
  for (const int turn : turns())
    if (fits[azimuth_slot(turn)] && (!best || at_azimuth(curve, turn) < at_azimuth(curve, *best))) best = turn;
  if (!best) return best;
  const double bound = at_azimuth(curve, *best) * (1 + share) + tolerance;
  const auto good = [&](int turn) { return fits[azimuth_slot(turn)] && at_azimuth(curve, turn) <= bound; };
  const std::vector<int> all = turns();
  return *std::ranges::find_if(all, good);
}

/// Whether no angle nearer than valley_deg has less, and none before it as little.
bool is_valley(const std::vector<double>& curve, const std::vector<char>& fits, int deg) {
  for (int d = 1; d < valley_deg; ++d) {
    if (fits[azimuth_slot(deg - d)] && at_azimuth(curve, deg - d) <= at_azimuth(curve, deg)) return false;
    if (fits[azimuth_slot(deg + d)] && at_azimuth(curve, deg + d) < at_azimuth(curve, deg)) return false;
  }
  return true;
}

std::vector<int> candidates(const std::vector<double>& curve, const std::vector<char>& fits, double negligible) {
  std::vector<int> result;
  for (const int turn : turns())
    if (fits[azimuth_slot(turn)] && is_valley(curve, fits, turn)) result.push_back(turn);
  std::ranges::stable_sort(result, {}, [&](int turn) { return at_azimuth(curve, turn); });
  const auto is_deep = [&](int turn) {
    return at_azimuth(curve, turn) <= at_azimuth(curve, result.front()) * (1 + worth_a_trial) + negligible;
  };
  result.erase(std::ranges::find_if_not(result, is_deep), result.end());
  if (result.size() > most_valleys) result.resize(most_valleys);
  const bool hopeless = at_azimuth(curve, 0) > at_azimuth(curve, result.empty() ? 0 : result.front()) * 3 + negligible;
  if (fits[0] && !hopeless && std::ranges::find(result, 0) == result.end()) result.push_back(0);
  return result;
}

/// Ordered pairs of extruders that print something.
std::vector<std::pair<int, int>> pairs(const Slices& slices) {
  std::vector<int> used;
  for (std::size_t e = 0; !slices.regions.empty() && e < slices.regions.front().size(); ++e)
    if (std::ranges::any_of(slices.regions, [&](const auto& layer) { return !layer[e].empty(); }))
      used.push_back(int(e));
  std::vector<std::pair<int, int>> all;
  for (const int i : used)
    for (const int j : used)
      if (i != j) all.emplace_back(i, j);
  return all;
}

}  // namespace

Pace pace(const Config& config, int extruder) {
  const double nozzle = config.extruders[std::size_t(extruder)].nozzle_diameter_mm;
  const auto width = [&](const LengthOrShare& own) {
    for (const LengthOrShare& w : {own, config.extrusion_width})
      if (w.value > 0) return w.of(config.layer_height_mm);
    return 1.125 * nozzle;
  };
  const double wall = width(config.perimeter_extrusion_width), fill = width(config.infill_extrusion_width);
  return {.shell_mm = config.perimeters * wall,
          .shell_s_mm2 = 1 / (wall * config.perimeter_speed_mm_s),
          .inner_s_mm2 = config.fill_density / (fill * config.infill_speed_mm_s)};
}

Azimuths azimuths(const Slices& slices, const AzimuthOptions& options) {
  Azimuths result;
  result.interference_mm3.resize(angle_count);
  result.exposure_s.resize(angle_count);
  result.fits.resize(angle_count, 1);
  if (options.fits)
    for (int a = 0; a < angle_count; ++a) result.fits[std::size_t(a)] = options.fits(a);
  for (std::size_t k = 0; k < slices.slabs.size(); ++k)
    for (const PackedPolygons& region : slices.regions[k])
      result.part_mm3 += area_mm2(region) * slices.slabs[k].height_mm;

  const std::vector<std::pair<int, int>> all = pairs(slices);
  if (!all.empty()) {
    const Interference interference(slices);
    const ExposureMap exposure(slices, options.pace, options.threads);
    // For two nozzles half a turn swaps p and p + d: the volume stays the same. The exposure does not. For more there
    // are many pairs: every other angle is looked at, those between are their means.
    const int half = all.size() == 2 ? angle_count / 2 : angle_count, step = all.size() == 2 ? 1 : 2;
    parallel_for(angle_count / step, options.threads, [&](int i) {
      const int a = step * i;
      for (const auto& [printing, idle] : all) {
        const Vec2 delta =
            options.nozzle_offset_mm[std::size_t(idle)] - options.nozzle_offset_mm[std::size_t(printing)];
        const Vec2 d = turned(delta, -a * std::numbers::pi / 180);
        if (a < half) result.interference_mm3[std::size_t(a)] += interference.volume_mm3(printing, idle, d);
        result.exposure_s[std::size_t(a)] += exposure.seconds(printing, idle, d);
      }
    });
    for (int a = half; a < angle_count; ++a)
      result.interference_mm3[std::size_t(a)] = result.interference_mm3[std::size_t(a - half)];
    for (std::vector<double>* curve : {&result.interference_mm3, &result.exposure_s})
      for (int a = 1; step == 2 && a < angle_count; a += step)
        (*curve)[std::size_t(a)] = (at_azimuth(*curve, a - 1) + at_azimuth(*curve, a + 1)) / 2;
  }
  const double negligible_s = negligible_exposure * std::ranges::max(result.exposure_s);
  const auto smallest_turn = [&](double share) { return least(result.exposure_s, result.fits, share, negligible_s); };
  result.best_deg = smallest_turn(worth_a_turn) == 0 ? 0 : smallest_turn(same_exposure);
  result.least_interference_deg = least(result.interference_mm3, result.fits, 0, same_interference * result.part_mm3);
  result.candidates_deg = candidates(result.exposure_s, result.fits, negligible_s);
  return result;
}

}  // namespace cleancolor
