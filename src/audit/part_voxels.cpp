#include "audit/part_voxels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace cleancolor {
namespace {

constexpr double highest_layer_mm = 2;  // likewise: a gap below a road is air

PartRoads::Layer small(const PartLayer& layer) {
  PartRoads::Layer s;
  s.top_mm = layer.top_mm;
  s.bottom_mm = std::clamp(layer.bottom_mm, layer.top_mm - highest_layer_mm, layer.top_mm);
  s.roads.reserve(layer.roads.size());
  for (const PartRoad& r : layer.roads) {
    const double half = std::clamp(double(r.width_mm), 0., widest_road_mm) / 2;
    s.roads.push_back({float(r.a_mm.x), float(r.a_mm.y), float(r.b_mm.x), float(r.b_mm.y), float(half), r.nozzle});
  }
  return s;
}

/// The layers that lie in each level, ascending.
std::vector<std::vector<int>> layers_of_levels(const std::vector<PartRoads::Layer>& layers, const Voxels& v) {
  std::vector<std::vector<int>> levels(std::size_t(v.levels));
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (layers[i].roads.empty()) continue;
    const LevelRange range = v.levels_of(layers[i].bottom_mm, layers[i].top_mm);
    for (int k = range.first; k <= range.last; ++k) levels[std::size_t(k)].push_back(int(i));
  }
  return levels;
}

/// Draws the roads of a layer into one level.
void draw(Voxels& v, int level, const PartRoads::Layer& layer, std::vector<CellSpan>& spans) {
  const auto in_cells = [&](float x, float y) {
    return Vec2{(double(x) - v.origin_mm.x) / v.size_mm, (double(y) - v.origin_mm.y) / v.size_mm};
  };
  for (const PartRoads::Road& r : layer.roads) {
    spans.clear();
    cells_of_road({in_cells(r.ax_mm, r.ay_mm), in_cells(r.bx_mm, r.by_mm), double(r.half_width_mm) / v.size_mm},
                  v.columns - 1, v.rows - 1, spans);
    for (const CellSpan& s : spans) {
      const std::int64_t first = v.index(s.first, s.y, level), last = v.index(s.last, s.y, level);
      fill_bits(v.solid, first, last, true);
      for (std::size_t d = 0; d < v.nozzle_digits.size(); ++d)
        fill_bits(v.nozzle_digits[d], first, last, r.nozzle >> d & 1);
    }
  }
}

}  // namespace

PartRoads part_roads(int layers, const PartLayers& layer, int threads, const Progress& progress) {
  PartRoads part;
  part.layers.resize(std::size_t(std::max(layers, 0)));
  parallel_for(layers, threads, [&](int i) {
    if (progress.interrupted()) throw Error("interrupted");
    part.layers[std::size_t(i)] = small(layer(i));
  });
  double length_mm = 0, area_mm2 = 0;
  for (const PartRoads::Layer& l : part.layers) {
    if (!l.roads.empty()) part.top_mm = std::max(part.top_mm, l.top_mm);
    for (const PartRoads::Road& r : l.roads) {
      const Vec2 a{r.ax_mm, r.ay_mm}, b{r.bx_mm, r.by_mm}, half{r.half_width_mm, r.half_width_mm};
      for (const Vec2 p : {a, b}) {
        part.box.add(p - half);
        part.box.add(p + half);
      }
      length_mm += distance(a, b);
      area_mm2 += distance(a, b) * 2 * double(r.half_width_mm);
      part.last_nozzle = std::max(part.last_nozzle, r.nozzle);
    }
  }
  part.mean_width_mm = length_mm > 0 ? area_mm2 / length_mm : 0;
  return part;
}

Voxels part_voxels(const PartRoads& part, const VoxelOptions& options, bool nozzles, int threads,
                   const Progress& progress) {
  if (part.box.empty()) return {};
  Voxels v = empty_voxels(part.box, part.top_mm, options);
  if (nozzles) v.nozzle_digits.assign(std::size_t(std::bit_width(part.last_nozzle)), BitWords(v.solid.size()));
  const auto levels = layers_of_levels(part.layers, v);
  // Planes begin at words of their own, so that levels can be drawn side by side.
  parallel_for(v.levels, threads, [&](int k) {
    if (progress.interrupted()) throw Error("interrupted");
    std::vector<CellSpan> spans;
    for (const int i : levels[std::size_t(k)]) draw(v, k, part.layers[std::size_t(i)], spans);
  });
  find_outside(v);
  return v;
}

}  // namespace cleancolor
