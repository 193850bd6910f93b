#include "visibility/visibility.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/rows.hpp"
#include "visibility/depth.hpp"

namespace cleancolor {
namespace {

constexpr int rows_a_voxel = 2;  // a wall along X thinner than a voxel must meet one

/// Sets the cells of one level whose middle lies inside, and those that a thin wall runs through.
void fill(BitWords& bits, const Voxels& v, int level, const Polygons& outline) {
  const double row_mm = v.size_mm / rows_a_voxel;
  const Rows rows(outline, {v.origin_mm.y + row_mm / 2, row_mm, v.rows * rows_a_voxel});
  for (int r = 0; r < rows.count(); ++r)
    for (const Interval& i : rows.row(r)) {
      const double begin = (double(i.begin_mm) - v.origin_mm.x) / v.size_mm;
      const double end = (double(i.end_mm) - v.origin_mm.x) / v.size_mm;
      int first = int(std::ceil(begin - 0.5)), last = int(std::ceil(end - 0.5)) - 1;
      if (first > last) first = last = int((begin + end) / 2);
      fill_bits(bits, v.index(first, r / rows_a_voxel, level), v.index(last, r / rows_a_voxel, level), true);
    }
}

/// Sets the cells of all levels that layers of these heights lie in.
void fill(BitWords& bits, const Voxels& v, std::span<const PackedPolygons> outlines, std::span<const double> bottom_mm,
          int threads, const Progress& progress) {
  std::vector<std::vector<std::size_t>> layers(std::size_t(v.levels));
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    const LevelRange range = v.levels_of(bottom_mm[k], bottom_mm[k + 1]);
    for (int level = range.first; level <= range.last; ++level) layers[std::size_t(level)].push_back(k);
  }
  parallel_for(v.levels, threads, [&](int level) {
    if (progress.interrupted()) throw Error("interrupted");
    for (const std::size_t k : layers[std::size_t(level)]) fill(bits, v, level, outlines[k]);
  });
}

/// Of each layer, and the top of the last.
std::vector<double> bottoms_mm(std::span<const double> height_mm) {
  std::vector<double> result{0};
  for (const double height : height_mm) result.push_back(result.back() + height);
  return result;
}

Voxels voxels_of(std::span<const PackedPolygons> outlines, std::span<const double> height_mm,
                 const SurfaceVisibilityOptions& options, const Progress& progress) {
  assert(outlines.size() == height_mm.size());
  const Box<Vec2> box = bounds_mm(outlines);
  const std::vector<double> bottom_mm = bottoms_mm(height_mm);
  if (box.empty()) return {};
  Voxels v =
      empty_voxels(box, bottom_mm.back(), {.size_mm = options.voxel_mm, .reach_mm = options.reach_mm, .most = 6e7});
  fill(v.solid, v, outlines, bottom_mm, options.threads, progress);
  find_outside(v);
  return v;
}

}  // namespace

SurfaceVisibility::SurfaceVisibility(std::span<const PackedPolygons> outlines, std::span<const double> height_mm,
                                     const SurfaceVisibilityOptions& options, const Progress& progress)
    : rays_(voxels_of(outlines, height_mm, options, progress), options.reach_mm, options.threads, progress,
            options.view) {
  const Voxels& v = rays_.voxels();
  if (options.opaque.empty() || v.levels == 0) return;
  assert(options.opaque.size() == outlines.size());
  opaque_.resize(v.solid.size());
  fill(opaque_, v, options.opaque, bottoms_mm(height_mm), options.threads, progress);
  clear_surface_ = clear_surface(v, opaque_);
}

double SurfaceVisibility::below(Vec3 p_mm, double translucency_mm) const {
  assert(translucency_mm > 0);
  constexpr double farthest_mm = 10;
  constexpr double least = 1. / 512;  // less is nothing in a layer's map
  const double reach_mm = std::min({farthest_mm, translucency_mm * -std::log(least), 20 * rays_.voxels().size_mm});
  if (clear_surface_.empty()) return 0;
  const auto place = nearest_surface(rays_.voxels(), clear_surface_, opaque_, p_mm, reach_mm);
  return place ? rays_.at(place->at_mm) * std::exp(-place->depth_mm / translucency_mm) : 0;
}

}  // namespace cleancolor
