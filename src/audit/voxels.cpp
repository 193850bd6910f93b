#include "audit/voxels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace cleancolor {
namespace {

constexpr double most_voxels = 1e8;     // 12 MB for each string of bits
constexpr double widest_road_mm = 20;   // what is told wider is an error of the file, and would only cost time
constexpr double highest_layer_mm = 2;  // likewise: a gap below a road is air

/// A road in half the memory: all layers are kept until the box of the part is known.
struct SmallRoad {
  float ax, ay, bx, by, half_width;
  std::uint8_t nozzle;
};

struct SmallLayer {
  double bottom_mm = 0, top_mm = 0;
  std::vector<SmallRoad> roads;
  Box<Vec2> box;
  std::uint8_t last_nozzle = 0;
};

SmallLayer small(const PartLayer& layer) {
  SmallLayer s;
  s.top_mm = layer.top_mm;
  s.bottom_mm = std::clamp(layer.bottom_mm, layer.top_mm - highest_layer_mm, layer.top_mm);
  s.roads.reserve(layer.roads.size());
  for (const PartRoad& r : layer.roads) {
    const double half = std::clamp(double(r.width_mm), 0., widest_road_mm) / 2;
    s.roads.push_back(
        {float(r.a_mm.x), float(r.a_mm.y), float(r.b_mm.x), float(r.b_mm.y), float(half), r.nozzle});
    for (const Vec2 p : {r.a_mm, r.b_mm}) {
      s.box.add(p - Vec2{half, half});
      s.box.add(p + Vec2{half, half});
    }
    s.last_nozzle = std::max(s.last_nozzle, r.nozzle);
  }
  return s;
}

/// An empty grid around the part, of voxels as large as they must be.
Voxels frame(const Box<Vec2>& box, double top_mm, double size_mm, double reach_mm) {
  Voxels v;
  for (double size = size_mm;; size *= 1.05) {
    const double air = 2 + std::ceil(reach_mm / size);
    const double columns = std::ceil(box.size().x / size) + 3, rows = std::ceil(box.size().y / size) + 3;
    const double levels = std::ceil(top_mm / size) + 2;
    if ((columns + air) * (rows + air) * levels > most_voxels) continue;
    v.size_mm = size;
    v.columns = int(columns), v.rows = int(rows), v.levels = int(levels);
    v.row_bits = v.columns + std::int64_t(air);
    v.plane_bits = (v.row_bits * (v.rows + std::int64_t(air)) + 63) / 64 * 64;
    break;
  }
  v.origin_mm = {box.min.x - v.size_mm, box.min.y - v.size_mm, 0};
  const std::size_t words = std::size_t(v.plane_bits / 64 * v.levels);
  v.solid.resize(words);
  v.outside.resize(words);
  return v;
}

/// The layers that lie in each level, ascending.
std::vector<std::vector<int>> layers_of_levels(const std::vector<SmallLayer>& layers, const Voxels& v) {
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
void draw(Voxels& v, int level, const SmallLayer& layer, std::vector<CellSpan>& spans) {
  const auto in_cells = [&](float x, float y) {
    return Vec2{(double(x) - v.origin_mm.x) / v.size_mm, (double(y) - v.origin_mm.y) / v.size_mm};
  };
  for (const SmallRoad& r : layer.roads) {
    spans.clear();
    cells_of_road({in_cells(r.ax, r.ay), in_cells(r.bx, r.by), double(r.half_width) / v.size_mm}, v.columns - 1,
                  v.rows - 1, spans);
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

Voxels voxels(int layers, const PartLayers& layer, double size_mm, double reach_mm, int threads,
              const Progress& progress) {
  std::vector<SmallLayer> all(std::size_t(std::max(layers, 0)));
  parallel_for(layers, threads, [&](int i) {
    if (progress.interrupted()) throw Error("interrupted");
    all[std::size_t(i)] = small(layer(i));
  });

  Box<Vec2> box;
  double top_mm = 0;
  std::uint8_t last_nozzle = 0;
  for (const SmallLayer& l : all) {
    if (l.roads.empty()) continue;
    box.add(l.box.min);
    box.add(l.box.max);
    top_mm = std::max(top_mm, l.top_mm);
    last_nozzle = std::max(last_nozzle, l.last_nozzle);
  }
  if (box.empty()) return {};

  Voxels v = frame(box, top_mm, size_mm, reach_mm);
  v.nozzle_digits.assign(std::size_t(std::bit_width(last_nozzle)), BitWords(v.solid.size()));
  const auto levels = layers_of_levels(all, v);
  // Planes begin at words of their own, so that levels can be drawn side by side.
  parallel_for(v.levels, threads, [&](int k) {
    if (progress.interrupted()) throw Error("interrupted");
    std::vector<CellSpan> spans;
    for (const int i : levels[std::size_t(k)]) draw(v, k, all[std::size_t(i)], spans);
  });
  seed_outside(v);
  flood(v.outside, v.solid, v.row_bits, v.plane_bits);
  return v;
}

}  // namespace cleancolor
