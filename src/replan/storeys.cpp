#include "replan/storeys.hpp"

#include <utility>

#include "base/polygon.hpp"

namespace cleancolor {
namespace {

constexpr double least_mm = 0.09;              // of a storey that does not stand on the one before
constexpr double told_height_error_mm = 0.01;  // of heights that are told

double top_mm(const Slices& layers, std::size_t k) {
  return layers.slabs[k].print_z_mm;
}
double bottom_mm(const Slices& layers, std::size_t k) {
  return layers.slabs[k].print_z_mm - layers.slabs[k].height_mm;
}
bool has_part(const Slices& layers, std::size_t k) {
  return !layers.outlines[k].empty();
}

/// Whether layer k is one above a storey that ends there.
bool begins_storey(const Slices& layers, std::size_t k, double below_mm) {
  const double height_mm = top_mm(layers, k) - below_mm;
  if (has_part(layers, k)) return height_mm >= least_mm || bottom_mm(layers, k) >= below_mm - told_height_error_mm;
  std::size_t next = k;
  while (next < layers.slabs.size() && !has_part(layers, next)) ++next;
  const bool carries =
      next < layers.slabs.size() && bottom_mm(layers, next) >= top_mm(layers, k) - told_height_error_mm;
  return carries && height_mm >= least_mm;
}

void unite(PackedPolygons& all, const PackedPolygons& more) {
  if (more.empty()) return;
  Polygons rings = all;
  append(rings, more);
  all = united(rings);
}

/// Adds what other layers have between the storey's bottom and top.
void fill(Slices& storeys, Slices& around, const Slices& all, const Slices& all_around, std::size_t own) {
  const Slab& slab = storeys.slabs.back();
  const double bottom = slab.print_z_mm - slab.height_mm;
  for (std::size_t k = 0; k < all.slabs.size(); ++k) {
    if (k == own || top_mm(all, k) < bottom + told_height_error_mm) continue;
    const bool is_below_top = bottom_mm(all, k) < slab.print_z_mm - told_height_error_mm;
    if (has_part(all, k) && is_below_top) {
      for (std::size_t e = 0; e < all.regions[k].size(); ++e) unite(storeys.regions.back()[e], all.regions[k][e]);
      unite(storeys.outlines.back(), all.outlines[k]);
    }
    if (top_mm(all, k) < slab.print_z_mm || (has_part(all, k) && is_below_top))
      unite(around.outlines.back(), all_around.outlines[k]);
  }
}

bool stand_on_each_other(const Slices& layers) {
  double below_mm = 0;
  for (std::size_t k = 0; k < layers.slabs.size(); ++k) {
    if (!has_part(layers, k) || bottom_mm(layers, k) < below_mm - told_height_error_mm) return false;
    below_mm = top_mm(layers, k);
  }
  return true;
}

}  // namespace

Storeys storeys(Slices part, Slices around) {
  const std::size_t count = part.slabs.size();
  Storeys result;
  result.is_storey.assign(count, true);
  for (std::size_t k = 0; k < count; ++k) result.of_layer.push_back(k);
  if (stand_on_each_other(part)) {
    around.slabs = part.slabs, around.regions = part.regions;
    result.part = std::move(part), result.around = std::move(around);
    return result;
  }
  double below_mm = 0;
  std::size_t found = 0;
  for (std::size_t k = 0; k < count; ++k) {
    result.is_storey[k] = begins_storey(part, k, below_mm);
    if (result.is_storey[k]) {
      ++found;
      const Slab slab{.print_z_mm = top_mm(part, k), .height_mm = top_mm(part, k) - below_mm};
      result.part.regions.push_back(part.regions[k]);
      result.part.outlines.push_back(part.outlines[k]);
      result.part.slabs.push_back(slab);
      result.around.outlines.push_back(around.outlines[k]);
      fill(result.part, result.around, part, around, k);
      below_mm = slab.print_z_mm;
    }
    result.of_layer[k] = found > 0 ? found - 1 : 0;
  }
  result.around.slabs = result.part.slabs, result.around.regions = result.part.regions;
  return result;
}

}  // namespace cleancolor
