#include "shield/rampart.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/parallel.hpp"

namespace cleancolor {
namespace {

constexpr double detail_mm = 0.1;      // finer details of the part do not show in a wall
constexpr double bay_radius_mm = 10;   // of bays that a wall passes by
constexpr double finer_mm = 0.02;      // likewise of each step towards a wall
constexpr double left_out_mm = 0.02;   // points of a wall that lie nearer to the line between their neighbours
constexpr double least_disc_mm = 3;    // radius that an island keeps where it shrinks downwards
constexpr double longest_steps = 2.5;  // so far from an old outline a shrunk one may lie
constexpr double sliver_mm2 = 0.01;

/// Without its details, but none is lost as a whole.
Polygons without_details(const Polygons& outline) {
  Polygons result;
  for (const Ring& ring : outline) {
    const Polygons less = simplified(Polygons{ring}, detail_mm);
    result.insert(result.end(), less.empty() ? ring : less.front());
  }
  return result;
}

/// Round corners have more points than walls need, and each further step would add to them.
Polygons grown(const Polygons& region, double delta_mm) {
  return simplified(offset(region, delta_mm, Corners::round), finer_mm);
}

/// The part grown by distance_mm at least; what is narrower than twice the radius between two of its walls is filled,
/// a wall shortens its way there.
Polygons around(const Polygons& outline, double distance_mm) {
  const Polygons region = filled(grown(without_details(filled(outline)), distance_mm + detail_mm));
  Polygons result;
  for (const Ring& island : region)
    for (Ring& ring : grown(grown({island}, bay_radius_mm), -bay_radius_mm)) result.push_back(std::move(ring));
  return filled(result);
}

/// An island shrunk by one step, where walls on its outline carry those around the island; else as it is.
Polygons carrying(const Ring& island, double step_mm) {
  const Polygons whole{island};
  Polygons small = grown(whole, -step_mm);
  if (small.size() != 1 || grown(small, -least_disc_mm).empty()) return whole;
  const Polygons lost = difference(whole, grown(small, longest_steps * step_mm));
  return area_mm2(lost) > sliver_mm2 ? whole : small;
}

Polygons carrying(const Polygons& region, double step_mm) {
  Polygons result;
  for (const Ring& island : region)
    for (Ring& ring : carrying(island, step_mm)) result.push_back(std::move(ring));
  return result;
}

/// Regions that each rest on the one below.
void make_stand(std::vector<PackedPolygons>& regions, const std::vector<double>& step_mm) {
  const std::size_t count = regions.size();
  for (std::size_t k = count - 1; k-- > 0;)
    regions[k] = filled(united(regions[k], carrying(Polygons(regions[k + 1]), step_mm[k + 1])));
  for (std::size_t k = 1; k < count; ++k) regions[k] = filled(united(regions[k], grown(regions[k - 1], -step_mm[k])));
}

}  // namespace

double overhang_step_mm(double layer_height_mm, const RampartOptions& options) {
  return std::min(layer_height_mm * std::tan(options.max_overhang_deg * std::numbers::pi / 180),
                  options.line_width_mm / 2);
}

Rampart rampart(std::span<const PackedPolygons> outlines, std::span<const double> height_mm,
                const RampartOptions& options) {
  assert(outlines.size() == height_mm.size() && options.walls > 0);
  Rampart result;
  result.walls.resize(outlines.size(), std::vector<PackedPolygons>(std::size_t(options.walls)));
  if (outlines.empty()) return result;
  std::vector<double> step_mm;
  for (const double h : height_mm) step_mm.push_back(overhang_step_mm(h, options));
  std::vector<PackedPolygons> regions(outlines.size());
  parallel_for(int(outlines.size()), options.threads,
               [&](int k) { regions[std::size_t(k)] = around(outlines[std::size_t(k)], options.distance_mm); });
  for (int wall = 0; wall < options.walls; ++wall) {
    if (options.conforming) {
      if (options.stands) make_stand(regions, step_mm);
    } else if (wall == 0) {
      Polygons all;
      for (const Polygons& region : unpacked(regions)) all.insert(all.end(), region.begin(), region.end());
      std::ranges::fill(regions, PackedPolygons(filled(all)));
    }
    parallel_for(int(regions.size()), options.threads, [&](int i) {
      const auto k = std::size_t(i);
      const Polygons region = regions[k];
      result.walls[k][std::size_t(wall)] = simplified(region, left_out_mm);
      // What no further wall needs is freed at once: of tall parts all layers are here together.
      regions[k] = wall + 1 < options.walls ? filled(grown(region, options.gap_mm)) : Polygons{};
    });
  }
  return result;
}

}  // namespace cleancolor
