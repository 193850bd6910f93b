#include "slice/slices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <numeric>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "slice/contours.hpp"
#include "slice/shared_border.hpp"

namespace cleancolor {
namespace {

// Overlaps up to this width are inaccuracies of the model and are mended; wider ones need a decision.
constexpr double tolerated_overlap_mm = 0.05;
// What is left of exact borders after rounding to the grid. Nothing smaller is an overlap at all.
constexpr double rounding_area_mm2 = 1e-4;
// So much of a sound model may overlap after its contours were simplified. Not worth a word.
constexpr double simplified_overlap_share = 2e-5;

/// What went wrong in one layer; the layers are put together afterwards, so that messages do not depend on threads.
struct Finding {
  double mended_overlap_mm3 = 0;
  double wide_overlap_mm2 = 0;
  int wide_first = -1, wide_second = -1;  // extruders
  int mid_air = 0;                        // pieces with nothing below
  Vec2 mid_air_at_mm;
};

/// Gives every place to one extruder only.
void make_disjoint(std::vector<Polygons>& regions, double height_mm, Overlap rule, Finding& finding) {
  for (std::size_t i = 0; i < regions.size(); ++i)
    for (std::size_t j = i + 1; j < regions.size(); ++j) {
      const Polygons both = intersection(regions[i], regions[j]);
      const double area = area_mm2(both);
      if (area < rounding_area_mm2) continue;
      const bool wide = !offset(both, -tolerated_overlap_mm / 2).empty();
      if (wide && area > finding.wide_overlap_mm2) {
        finding.wide_overlap_mm2 = area;
        finding.wide_first = int(i);
        finding.wide_second = int(j);
      }
      if (!wide) finding.mended_overlap_mm3 += area * height_mm;
      const bool last_wins = wide && rule == Overlap::last;
      Polygons& loser = regions[last_wins ? i : j];
      loser = difference(loser, both);
    }
}

/// Whether any region but the i-th has this point.
bool others_have(const std::vector<Polygons>& regions, std::size_t i, const Point& p) {
  for (std::size_t j = 0; j < regions.size(); ++j)
    if (j != i && contains(regions[j], p)) return true;
  return false;
}

/// Fills cracks narrower than twice the radius that no other extruder prints, and what is left of them at their ends.
/// Where there are none, the region stays as it is to the last point: neighbours share these points.
void close_cracks(std::vector<Polygons>& regions, double radius_mm) {
  if (radius_mm <= 0) return;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (regions[i].empty()) continue;
    constexpr double noise_mm = 0.003;  // rounding of offsets, to and fro
    Polygons cracks = opened(difference(closed(regions[i], radius_mm), regions[i]), noise_mm);
    if (cracks.empty()) continue;
    // A hair wider, so that they grow together with the region.
    cracks = offset(cracks, noise_mm);
    for (std::size_t j = 0; j < regions.size(); ++j)
      if (j != i) cracks = difference(cracks, regions[j]);
    regions[i] = united(regions[i], cracks);
    std::erase_if(regions[i], [&](const Ring& ring) {
      const double area = area_mm2(ring);
      return area < 0 && -area < std::numbers::pi * radius_mm * radius_mm && !others_have(regions, i, ring.front());
    });
  }
}

Polygons all_of(const std::vector<Polygons>& regions) {
  Polygons all;
  for (const Polygons& r : regions) all.insert(all.end(), r.begin(), r.end());
  const auto filled = std::count_if(regions.begin(), regions.end(), [](const Polygons& r) { return !r.empty(); });
  return filled < 2 ? all : united(all);
}

/// Grows or shrinks the outside of the layer; borders between two extruders stay where they are.
void compensate(std::vector<Polygons>& regions, double delta_mm) {
  if (delta_mm == 0) return;
  const Polygons all = all_of(regions);
  Polygons target = offset(all, delta_mm);
  if (delta_mm < 0) {
    // What would be left with less than half its width keeps all of it.
    const Polygons thin = difference(all, opened(all, -2 * delta_mm));
    target.insert(target.end(), thin.begin(), thin.end());
    target = united(target);
  }
  Polygons taken;  // where the outside of two colours meets, both grow into the corner: the first has it
  for (Polygons& region : regions) {
    if (region.empty()) continue;
    if (delta_mm < 0) {
      region = intersection(region, target);
      continue;
    }
    Polygons others = difference(all, region);
    others.insert(others.end(), taken.begin(), taken.end());
    region = difference(intersection(offset(region, delta_mm), target), others);
    taken.insert(taken.end(), region.begin(), region.end());
  }
}

/// Counts the pieces of a layer that touch nothing of the layer below.
void find_mid_air(const Polygons& layer, const Polygons& below, Finding& finding) {
  for (const Island& island : islands(layer)) {
    const auto on_below = [&](const Point& p) { return contains(below, p); };
    if (std::any_of(island.outline.begin(), island.outline.end(), on_below)) continue;
    if (!intersection(polygons(island), below).empty()) continue;
    if (finding.mid_air++ == 0) finding.mid_air_at_mm = to_mm(island.outline.front());
  }
}

/// "globe.stl and land.stl": the parts that the two extruders print.
std::string names_of(std::span<const Part> parts, int extruder) {
  std::string names;
  for (const Part& part : parts)
    if (part.extruder == extruder) names += (names.empty() ? "" : ", ") + part.name;
  return names;
}

void report(std::span<const Part> parts, const Slices& slices, const std::vector<Finding>& findings, Overlap rule,
            const Progress& progress) {
  const auto worst = std::max_element(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
    return a.wide_overlap_mm2 < b.wide_overlap_mm2;
  });
  if (worst->wide_overlap_mm2 > 0) {
    const std::string where =
        fmt::format("{} (extruder {}) and {} (extruder {}) overlap by up to {:.2f} mm2, at z = {:.2f} mm",
                    names_of(parts, worst->wide_first), worst->wide_first + 1, names_of(parts, worst->wide_second),
                    worst->wide_second + 1, worst->wide_overlap_mm2,
                    slices.slabs[std::size_t(worst - findings.begin())].slice_z_mm());
    if (rule == Overlap::refuse)
      throw Error(where +
                  "; cut the parts apart in the modeller, or say which one has the place: --overlap first or last");
    progress.warn(fmt::format("{}: given to the {}", where, rule == Overlap::first ? "first" : "last"));
  }
  double mended = 0, printed = 0;
  for (const Finding& f : findings) mended += f.mended_overlap_mm3;
  for (std::size_t k = 0; k < slices.slabs.size(); ++k)
    printed += area_mm2(slices.outlines[k]) * slices.slabs[k].height_mm;
  if (mended > simplified_overlap_share * printed)
    progress.warn(fmt::format("parts overlap by less than {} mm, {:.2f} mm3 in all: given to the first",
                              tolerated_overlap_mm, mended));

  int mid_air = 0;
  for (const Finding& f : findings) mid_air += f.mid_air;
  if (mid_air == 0) return;
  const auto first = std::find_if(findings.begin(), findings.end(), [](const Finding& f) { return f.mid_air > 0; });
  progress.warn(
      fmt::format("{} {} in mid-air with nothing below, the first at ({:.1f}, {:.1f}), z = {:.2f} mm: it will "
                  "droop; turn the model or put something under it",
                  mid_air, mid_air == 1 ? "piece begins" : "pieces begin", first->mid_air_at_mm.x,
                  first->mid_air_at_mm.y, slices.slabs[std::size_t(first - findings.begin())].slice_z_mm()));
}

}  // namespace

std::vector<Slab> slabs(double top_mm, double first_layer_height_mm, double layer_height_mm) {
  // A thousandth of a layer forgives heights that are not exact in binary, such as 20 / 0.1.
  const double top = top_mm - layer_height_mm * 1e-3;
  std::vector<Slab> result;
  for (Slab slab{first_layer_height_mm, first_layer_height_mm}; slab.slice_z_mm() < top;) {
    result.push_back(slab);
    slab = {first_layer_height_mm + double(result.size()) * layer_height_mm, layer_height_mm};
  }
  return result;
}

Polygons cross_section(const Mesh& mesh, double z_mm) {
  return united(PlaneCuts(mesh, std::span(&z_mm, 1)).rings(0));
}

Slices slices(std::span<const Part> parts, const SliceOptions& options, const Progress& progress) {
  double top_mm = 0;
  for (const Part& part : parts) top_mm = std::max(top_mm, bounds(part.mesh).max.z);
  Slices result{slabs(top_mm, options.first_layer_height_mm, options.layer_height_mm), {}, {}};
  if (result.slabs.empty())
    throw Error(
        fmt::format("{}: the model is {:.3f} mm high, less than half the first layer ({} mm): nothing would be "
                    "printed; scale it (files in metres or inches?) or choose a smaller first_layer_height",
                    parts.front().name, top_mm, options.first_layer_height_mm));

  std::vector<double> planes;
  for (const Slab& slab : result.slabs) planes.push_back(slab.slice_z_mm());
  std::vector<std::unique_ptr<PlaneCuts>> cuts(parts.size());
  parallel_for(int(parts.size()), options.threads,
               [&](int i) { cuts[std::size_t(i)] = std::make_unique<PlaneCuts>(parts[std::size_t(i)].mesh, planes); });

  result.regions.resize(planes.size());
  result.outlines.resize(planes.size());
  std::vector<Finding> findings(planes.size());
  parallel_for(int(planes.size()), options.threads, [&](int index) {
    if (progress.interrupted()) throw Error("interrupted");
    const auto k = std::size_t(index);
    std::vector<Polygons> regions(std::size_t(options.extruders));
    for (std::size_t p = 0; p < parts.size(); ++p) {
      Polygons rings = cuts[p]->rings(k);
      Polygons& region = regions[std::size_t(*parts[p].extruder)];
      region.insert(region.end(), std::make_move_iterator(rings.begin()), std::make_move_iterator(rings.end()));
    }
    regions = simplified_together(regions, options.resolution_mm);
    for (Polygons& region : regions) region = united(region);
    make_disjoint(regions, result.slabs[k].height_mm, options.overlap, findings[k]);
    close_cracks(regions, options.closing_radius_mm);
    compensate(regions, options.xy_size_compensation_mm);
    if (k == 0) compensate(regions, -options.elefant_foot_compensation_mm);
    result.outlines[k] = all_of(regions);
    result.regions[k] = packed(regions);
  });
  parallel_for(int(planes.size()) - 1, options.threads, [&](int below) {
    if (progress.interrupted()) throw Error("interrupted");
    const auto k = std::size_t(below) + 1;
    find_mid_air(result.outlines[k], result.outlines[k - 1], findings[k]);
  });
  report(parts, result, findings, options.overlap, progress);
  return result;
}

}  // namespace cleancolor
