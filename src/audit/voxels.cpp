#include "audit/voxels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace cleancolor {
namespace {

constexpr double widest_road_mm = 20;   // what is told wider is an error of the file, and would only cost time
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

/// An empty grid around the part, of voxels as large as they must be.
Voxels frame(const PartRoads& part, const VoxelOptions& options) {
  Voxels v;
  for (double size = options.size_mm;; size *= 1.05) {
    const double air = 2 + std::ceil(options.reach_mm / size);
    const Vec2 box = part.box.size();
    const double columns = std::ceil(box.x / size) + 3, rows = std::ceil(box.y / size) + 3;
    const double levels = std::ceil(part.top_mm / size) + 2;
    if ((columns + air) * (rows + air) * levels > std::max(options.most, 1e4)) continue;
    v.size_mm = size;
    v.columns = int(columns), v.rows = int(rows), v.levels = int(levels);
    v.row_bits = v.columns + std::int64_t(air);
    v.plane_bits = (v.row_bits * (v.rows + std::int64_t(air)) + 63) / 64 * 64;
    break;
  }
  v.origin_mm = {part.box.min.x - v.size_mm, part.box.min.y - v.size_mm, 0};
  const std::size_t words = std::size_t(v.plane_bits / 64 * v.levels);
  v.solid.resize(words);
  v.outside.resize(words);
  return v;
}

/// The layers that lie in each level, ascending.
std::vector<std::vector<int>> layers_of_levels(const std::vector<PartRoads::Layer>& layers, const Voxels& v) {
  std::vector<std::vector<int>> levels(std::size_t(v.levels));
  const auto level = [&](double z_mm) { return int(std::clamp(std::floor(z_mm / v.size_mm), 0., v.levels - 2.)); };
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (layers[i].roads.empty()) continue;
    const int middle = level((layers[i].bottom_mm + layers[i].top_mm) / 2);
    // The middle of level k is at (k + 0.5) sizes.
    const int first = std::min(middle, level(layers[i].bottom_mm + v.size_mm / 2));
    const int last = std::max(middle, level(layers[i].top_mm + v.size_mm / 2) - 1);
    for (int k = first; k <= last; ++k) levels[std::size_t(k)].push_back(int(i));
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

/// The air around the part: the empty ends of rows and planes, and the topmost level.
void seed_outside(Voxels& v) {
  const std::int64_t top = std::int64_t(v.levels - 1) * v.plane_bits;
  fill_bits(v.outside, top, top + v.plane_bits - 1, true);
  for (int z = 0; z < v.levels - 1; ++z) {
    const std::int64_t plane = z * v.plane_bits;
    for (int y = 0; y < v.rows; ++y)
      fill_bits(v.outside, plane + y * v.row_bits + v.columns - 1, plane + (y + 1) * v.row_bits - 1, true);
    fill_bits(v.outside, plane + v.rows * v.row_bits, plane + v.plane_bits - 1, true);
  }
}

}  // namespace

std::uint8_t Voxels::nozzle(std::int64_t i) const {
  int n = 0;
  for (std::size_t d = 0; d < nozzle_digits.size(); ++d) n |= int(bit(nozzle_digits[d], i)) << d;
  return std::uint8_t(n);
}

std::uint64_t Voxels::surface(std::int64_t w) const {
  const std::uint64_t air = outside[std::size_t(w)];
  if (air == 0) return 0;
  std::uint64_t near = 0;
  for (const std::int64_t shift : {std::int64_t(1), row_bits, plane_bits})
    near |= shifted_word(solid, w, shift) | shifted_word(solid, w, -shift);
  return air & near;
}

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

Voxels voxels(const PartRoads& part, const VoxelOptions& options, int threads, const Progress& progress) {
  if (part.box.empty()) return {};
  Voxels v = frame(part, options);
  if (options.nozzles) v.nozzle_digits.assign(std::size_t(std::bit_width(part.last_nozzle)), BitWords(v.solid.size()));
  const auto levels = layers_of_levels(part.layers, v);
  // Planes begin at words of their own, so that levels can be drawn side by side.
  parallel_for(v.levels, threads, [&](int k) {
    if (progress.interrupted()) throw Error("interrupted");
    std::vector<CellSpan> spans;
    for (const int i : levels[std::size_t(k)]) draw(v, k, part.layers[std::size_t(i)], spans);
  });
  seed_outside(v);
  flood(v.outside, v.solid, v.row_bits, v.plane_bits);
  return v;
}

}  // namespace cleancolor
