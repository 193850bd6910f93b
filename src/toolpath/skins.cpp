#include "toolpath/skins.hpp"

#include <algorithm>

namespace cleancolor {
namespace {

// How far a face reaches under its surroundings.
constexpr double hold_mm = 3;
// Half the width of what is left over from two borders that should be one.
constexpr double sliver_mm = 0.01;

/// Strips narrower than a few lines are widened, so that their lines end on something solid.
Polygons widened(const Polygons& solid, const Polygons& fill, double spacing_mm) {
  const Polygons narrow = difference(solid, opened(solid, 3 * spacing_mm));
  if (narrow.empty()) return solid;
  Polygons all = intersection(offset(narrow, 3 * spacing_mm), fill);
  append(all, solid);
  return united(all);
}

}  // namespace

Faces faces(const Polygons& region, const Polygons& fill, const Polygons& above, const Polygons& below, bool on_bed,
            double line_mm) {
  const auto open = [&](const Polygons& cover) { return opened(difference(region, cover), line_mm / 10); };
  const auto held = [&](const Polygons& face) {
    const Polygons seen = intersection(face, fill);
    return seen.empty() ? seen : intersection(offset(seen, hold_mm), fill);
  };
  Faces result;
  result.on_bed = on_bed;
  result.top_cover = open(above);
  result.top = held(result.top_cover);
  append(result.top_cover, result.top);
  result.bottom_cover = on_bed ? region : open(below);
  result.bottom = on_bed ? fill : held(result.bottom_cover);
  if (!on_bed) append(result.bottom_cover, result.bottom);
  return result;
}

FillAreas fill_areas(const Polygons& fill, int layer, int first, std::span<const Faces* const> all_faces,
                     const SkinOptions& options) {
  FillAreas areas;
  if (fill.empty()) return areas;
  const Faces& own = *all_faces[std::size_t(layer - first)];
  if (options.bottom_layers > 0) (own.on_bed ? areas.bottom : areas.bridge) = own.bottom;
  if (options.top_layers > 0) areas.top = difference(difference(own.top, areas.bridge), areas.bottom);

  // What lies at most n - 1 layers under a top or over a bottom is solid too.
  Polygons inside;
  for (int k = first; k < first + int(all_faces.size()); ++k) {
    if (k > layer && k - layer < options.top_layers) append(inside, all_faces[std::size_t(k - first)]->top_cover);
    if (k < layer && layer - k < options.bottom_layers) append(inside, all_faces[std::size_t(k - first)]->bottom_cover);
  }
  Polygons seen = areas.top;
  append(seen, areas.bottom);
  append(seen, areas.bridge);
  const Polygons rest = seen.empty() ? fill : difference(fill, seen);
  if (options.all_solid) {
    areas.solid = rest;
    return areas;
  }
  if (!inside.empty()) {
    areas.solid = opened(intersection(united(inside), rest), sliver_mm);
    areas.solid = widened(areas.solid, rest, options.solid_spacing_mm);
  }
  areas.sparse = areas.solid.empty() ? rest : difference(rest, areas.solid);
  if (options.solid_below_area_mm2 <= 0) return areas;
  Polygons sparse;
  for (const Island& island : islands(areas.sparse)) {
    const Polygons piece = polygons(island);
    append(area_mm2(piece) < options.solid_below_area_mm2 ? areas.solid : sparse, piece);
  }
  if (sparse.size() != areas.sparse.size()) areas.solid = united(areas.solid);
  areas.sparse = std::move(sparse);
  return areas;
}

}  // namespace cleancolor
