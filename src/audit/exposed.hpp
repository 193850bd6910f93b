// audit/exposed.hpp
//
// Exposed: which roads of a layer are visible plastic, by what the file says and by what the geometry shows.
//
//   roads of a layer, outlines of it and of the layer above  ->  visible, outer wall, wipes: for each road
//
// Visible is a road of the part that the file calls an outer wall, a top surface or ironing, or that is outermost (one
// of its sides faces the outside of the layer), or that is an open top (the outline of the layer above does not cover
// it). Auxiliary plastic wipes only outside the outline of the part and where its road has at least 0.03 mm2.
//
// A hole in the outline, such as the bore of a tube, counts as inside: its wall is visible by what the file says alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/bit_grid.hpp"
#include "base/vec.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

struct LabelledRoad {
  Vec2 a_mm, b_mm;
  float width_mm = 0;
  float area_mm2 = 0;  // cross-section
  Role role = Role::unknown;
};

/// The outline of the part in one layer with everything inside filled, as a grid. Gaps of less than 0.4 mm (seams) are
/// closed.
class PartOutline {
 public:
  /// An empty layer: everything is outside.
  PartOutline() = default;
  /// Auxiliary roads are left out.  Requires: finite.  Cost: about 0.1 ms and 0.1 us a road for 100 x 100 mm; cells of
  /// 0.2 mm, larger where the box would need more than 4 million.
  explicit PartOutline(std::span<const LabelledRoad> roads);

  /// Inside, or on a road.
  bool contains(Vec2 p_mm) const;
  double cell_mm() const { return cell_mm_; }

 private:
  Vec2 origin_mm_;
  double cell_mm_ = 0.2;
  int columns_ = 0, rows_ = 0;
  std::int64_t row_bits_ = 0;
  BitWords outside_;
};

struct Exposure {
  bool visible = false;  // outer wall or top surface
  bool outer = false;    // outer wall: holes and zippers count on it
  bool wipes = false;    // auxiliary plastic that counts
};

/// What makes a road visible; one alone shows what the other adds.
enum class ExposedBy : std::uint8_t { labels, geometry, both };

/// For each road; above: the outline of the layer above (empty for the last one).
///
/// By geometry a road is outermost or an open top where at least half of its places are: its middle, or places 1 mm
/// apart. An overhang_perimeter is an outer wall only where it is outermost.
std::vector<Exposure> exposures(std::span<const LabelledRoad> roads, const PartOutline& outline,
                                const PartOutline& above, ExposedBy by = ExposedBy::both);

}  // namespace cleancolor
