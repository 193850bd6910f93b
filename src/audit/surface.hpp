// audit/surface.hpp
//
// LayerSurface: what lies under a nozzle that passes over a layer.
//
//   roads of a layer, a straight way  ->  pieces of the way, each over one kind of plastic
//
// Every road is a stadium: all points within half its width of its centre line. The pieces are exact (closed form), not
// sampled. Where several roads cover a point: part before auxiliary; of the part, foreign before own, and visible
// before inner; of one kind the one printed first.
//
// Roads are looked up in square cells of 1 mm, larger where roads are long or far apart. The table of cells wraps round
// at its borders, so its size follows the number of roads, not the distance between them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/vec.hpp"

namespace cleancolor {

/// One straight road of the layer, where its plastic lies.
struct SurfaceRoad {
  Vec2 a_mm, b_mm;                // the same point: a disc
  float half_width_mm = 0;        // more than 2.5 counts as 2.5
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

/// The tip of a nozzle on its straight way.
struct SurfaceWay {
  Vec2 a_mm, b_mm;  // the same point: it stands, and is over one piece [0, 1] or none
  int nozzle = 0;
  std::uint32_t move = 0;  // auxiliary roads count where their move is before this one
};

/// Memory that along() uses again from call to call; each thread has its own, for any number of surfaces.
struct SurfaceScratch {
  struct Cover {
    double begin = 0, end = 0;
    std::uint64_t rank = 0;  // the lowest is on top
    std::uint32_t road = 0;
  };
  std::vector<std::uint32_t> met;  // by road: the last call that met it
  std::uint32_t call = 0;
  std::vector<Cover> covers, open;
  std::uint64_t work = 0;  // roads and cells looked at so far, by all calls: a bound on hostile files goes by it
};

class LayerSurface {
 public:
  /// Cost: linear in the cells that the roads touch, on average fewer than 40 a road.  Requires: finite.
  explicit LayerSurface(std::vector<SurfaceRoad> roads = {});
  ~LayerSurface();
  LayerSurface(LayerSurface&&) noexcept;
  LayerSurface& operator=(LayerSurface&&) noexcept;

  /// The pieces of a way, appended to pieces.  Cost: about 20 ns for each road near the way.
  void along(const SurfaceWay& way, SurfaceScratch& scratch, std::vector<SurfacePiece>& pieces) const;

  std::span<const SurfaceRoad> roads() const;

 private:
  struct Cells;
  std::unique_ptr<Cells> cells_;
};

/// Begin and end, in [0, 1], of the share of the way a -> b that lies within half_width_mm of the segment; begin > end
/// where there is none. A way of no length lies on it as a whole or not at all.
struct Share {
  double begin = 1, end = 0;
};
Share share_over(Vec2 a_mm, Vec2 b_mm, const SurfaceRoad& road);

}  // namespace cleancolor
