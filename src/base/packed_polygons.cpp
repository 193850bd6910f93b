#include "base/packed_polygons.hpp"

#include <algorithm>
#include <limits>

namespace cleancolor {
namespace {

std::int32_t word(std::int64_t nm) {
  using Word = std::numeric_limits<std::int32_t>;
  return std::int32_t(std::clamp(nm, std::int64_t(Word::min()), std::int64_t(Word::max())));
}

}  // namespace

PackedPolygons::PackedPolygons(const Polygons& region) {
  if (region.empty()) return;
  std::size_t points = 0;
  for (const Ring& ring : region) points += ring.size();
  words_.reserve(1 + region.size() + 2 * points);
  words_.push_back(word(std::int64_t(region.size())));
  for (const Ring& ring : region) words_.push_back(word(std::int64_t(ring.size())));
  for (const Ring& ring : region)
    for (const Point& p : ring) {
      words_.push_back(word(p.X));
      words_.push_back(word(p.Y));
    }
}

PackedPolygons::operator Polygons() const {
  Polygons region;
  if (words_.empty()) return region;
  region.reserve(size());
  const std::int32_t* coordinate = words_.data() + 1 + size();
  for (std::size_t i = 0; i < size(); ++i) {
    Ring& ring = region.emplace_back();
    ring.reserve(std::size_t(words_[1 + i]));
    for (std::int32_t k = 0; k < words_[1 + i]; ++k, coordinate += 2) ring.emplace_back(coordinate[0], coordinate[1]);
  }
  return region;
}

std::vector<PackedPolygons> packed(std::span<const Polygons> regions) {
  return {regions.begin(), regions.end()};
}

std::vector<Polygons> unpacked(std::span<const PackedPolygons> regions) {
  return {regions.begin(), regions.end()};
}

Box<Vec2> bounds_mm(std::span<const PackedPolygons> regions) {
  Box<Vec2> box;
  for (const PackedPolygons& region : regions) {
    const Box<Vec2> own = bounds_mm(Polygons(region));
    if (own.empty()) continue;
    box.add(own.min);
    box.add(own.max);
  }
  return box;
}

}  // namespace cleancolor
