// audit/exposed.hpp
//
// Exposed: which roads of a layer are visible plastic, by what the file says and by what the geometry shows.
//
// Visible is a road of the part that the file calls an outer wall, a top surface or ironing, or that is outermost (one
// of its sides faces the outside of the layer), or that is an open top (the outline of the layer above does not cover
// it). Auxiliary plastic wipes only outside the outline of the part and where its road has at least 0.03 mm2.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

struct LabelledRoad {
  Vec2 a_mm, b_mm;
  float width_mm = 0;
  float area_mm2 = 0;  // cross-section
  Role role = Role::unknown;
};

/// The outline of the part in one layer with everything inside filled, as a grid.
class PartOutline {
 public:
  /// An empty layer: everything is outside.
  PartOutline() = default;
  /// Auxiliary roads are left out.  Cost: linear in the cells of 0.2 mm (coarser for very large parts) of the part's
  /// box.
  explicit PartOutline(std::span<const LabelledRoad> roads);

  bool contains(Vec2 p_mm) const;
  double cell_mm() const { return cell_mm_; }

 private:
  Vec2 origin_mm_;
  double cell_mm_ = 0.2;
  int columns_ = 0, rows_ = 0;
  std::vector<std::uint8_t> inside_;
};

struct Exposure {
  bool visible = false;  // outer wall or top surface
  bool outer = false;    // outer wall: holes and zippers count on it
  bool wipes = false;    // auxiliary plastic that counts
};

/// For each road; above: the outline of the layer above (empty for the last one).
std::vector<Exposure> exposures(std::span<const LabelledRoad> roads, const PartOutline& outline,
                                const PartOutline& above);

}  // namespace cleancolor
