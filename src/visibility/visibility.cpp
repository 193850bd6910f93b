#include "visibility/visibility.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/rows.hpp"

namespace cleancolor {
namespace {

constexpr int rows_a_voxel = 2;  // a wall along X thinner than a voxel must meet one

/// Cells of one level whose middle lies inside, and those that a thin wall runs through.
void fill(Voxels& v, int level, const Polygons& outline) {
  const double row_mm = v.size_mm / rows_a_voxel;
  const Rows rows(outline, {v.origin_mm.y + row_mm / 2, row_mm, v.rows * rows_a_voxel});
  for (int r = 0; r < rows.count(); ++r)
    for (const Interval& i : rows.row(r)) {
      const double begin = (double(i.begin_mm) - v.origin_mm.x) / v.size_mm;
      const double end = (double(i.end_mm) - v.origin_mm.x) / v.size_mm;
      int first = int(std::ceil(begin - 0.5)), last = int(std::ceil(end - 0.5)) - 1;
      if (first > last) first = last = int((begin + end) / 2);
      fill_bits(v.solid, v.index(first, r / rows_a_voxel, level), v.index(last, r / rows_a_voxel, level), true);
    }
}

Voxels voxels_of(std::span<const Polygons> outlines, std::span<const double> height_mm,
                 const SurfaceVisibilityOptions& options, const Progress& progress) {
  assert(outlines.size() == height_mm.size());
  const Box<Vec2> box = bounds_mm(outlines);
  std::vector<double> bottom_mm{0};
  for (const double height : height_mm) bottom_mm.push_back(bottom_mm.back() + height);
  if (box.empty()) return {};
  Voxels v =
      empty_voxels(box, bottom_mm.back(), {.size_mm = options.voxel_mm, .reach_mm = options.reach_mm, .most = 6e7});
  std::vector<std::vector<std::size_t>> layers(std::size_t(v.levels));
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    const LevelRange range = v.levels_of(bottom_mm[k], bottom_mm[k + 1]);
    for (int level = range.first; level <= range.last; ++level) layers[std::size_t(level)].push_back(k);
  }
  parallel_for(v.levels, options.threads, [&](int level) {
    if (progress.interrupted()) throw Error("interrupted");
    for (const std::size_t k : layers[std::size_t(level)]) fill(v, level, outlines[k]);
  });
  find_outside(v);
  return v;
}

}  // namespace

SurfaceVisibility::SurfaceVisibility(std::span<const Polygons> outlines, std::span<const double> height_mm,
                                     const SurfaceVisibilityOptions& options, const Progress& progress)
    : rays_(voxels_of(outlines, height_mm, options, progress), options.reach_mm, options.threads, progress) {}

}  // namespace cleancolor
