// audit/surface.hpp
//
// LayerSurface: what lies under a nozzle that passes over a layer.
//
//   roads of a layer, a straight way  ->  pieces of the way, each over one kind of plastic
//
// Every road is a stadium: all points within half its width of its centre line. The pieces are exact (closed form), not
// sampled. Where several roads cover a point: part before auxiliary; of the part, foreign before own, and visible
// before inner.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/vec.hpp"

namespace cleancolor {

/// One straight road of the layer, where its plastic lies.
struct SurfaceRoad {
  Vec2 a_mm, b_mm;
  float half_width_mm = 0;
  std::uint32_t drive_order = 0;  // index of its move: auxiliary plastic wipes only moves after it
  std::uint8_t nozzle = 0;        // that printed it
  bool part = false;
  bool visible = false;  // of the part: outer wall or top surface (audit/exposed.hpp)
};

struct SurfacePiece {
  float begin = 0, end = 0;  // shares of the way, in [0, 1], ascending; pieces do not overlap; gaps are empty air
  std::uint8_t nozzle = 0;   // whose plastic it is
  bool part = false;
  bool visible = false;
  std::uint32_t road = 0;  // that covers it, the same along the piece; of several of its kind the one printed first
};

class LayerSurface {
 public:
  /// Cost: linear in the cells (about 1 mm) that the roads touch.
  explicit LayerSurface(std::vector<SurfaceRoad> roads);
  ~LayerSurface();
  LayerSurface(LayerSurface&&) noexcept;

  /// The pieces of the way a -> b of a tip of `nozzle`; auxiliary roads count where their move is before `before`.
  /// Appends to pieces.  Cost: about 20 ns for each road near the way.
  void along(Vec2 a_mm, Vec2 b_mm, int nozzle, std::uint32_t before, std::vector<SurfacePiece>& pieces) const;

  std::span<const SurfaceRoad> roads() const;

 private:
  struct Cells;
  std::unique_ptr<Cells> cells_;
};

}  // namespace cleancolor
