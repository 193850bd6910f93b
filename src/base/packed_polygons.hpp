// base/packed_polygons.hpp
//
// Packed polygons: regions that are kept for all layers of a print at once.
//
//   Polygons  <->  PackedPolygons, exact: same rings, same points, same order
//
// Polygons take 16 bytes a point and a block of memory for each ring. Thousands of such blocks, which stay, scattered
// among those that live for a moment, keep the room between them from being used again: it cost as much as they
// themselves. Packed, a region is one block of 8 bytes a point. What is worked on is unpacked for as long as that
// takes, which is little beside anything that Clipper does.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/polygon.hpp"

namespace cleancolor {

class PackedPolygons {
 public:
  PackedPolygons() = default;
  /// Exact within +-2147 mm, twice what Polygons promise to be exact in; what lies further out, as damaged files have
  /// it, is moved to that border.
  PackedPolygons(const Polygons& region);

  /// Cost: about 1 ns a point.
  operator Polygons() const;

  bool empty() const { return words_.empty(); }
  std::size_t size() const { return empty() ? 0 : std::size_t(words_.front()); }  // rings
  bool operator==(const PackedPolygons&) const = default;

 private:
  std::vector<std::int32_t> words_;  // how many rings; how many points each has; X and Y of each point in nm
};

std::vector<PackedPolygons> packed(std::span<const Polygons> regions);
std::vector<Polygons> unpacked(std::span<const PackedPolygons> regions);

Box<Vec2> bounds_mm(std::span<const PackedPolygons> regions);  // of all

}  // namespace cleancolor
