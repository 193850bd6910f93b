// plan/cost.hpp
//
// Cost: what a way of the carriage is worth, in millimetres of way.
//
//   cost of a mm  =  1  +  over what its nozzles hang:
//     foreign      x visibility  over plastic of another colour
//     own          x visibility  over plastic of its own colour: blobs and strings show less there
//     hidden                     over plastic that cannot be seen
//   cost of a start or end  =  seam x visibility of the place
//
// The paper charges a nozzle's way over another colour once an edge, by the place where the edge ends; here it is
// charged by the mm, or the cost would depend on the length of edges, and some would leap over a colour for nothing.
// Source: Hergel and Lefebvre, Clean color, section 6.4.
#pragma once

#include "plan/layer_map.hpp"

namespace cleancolor {

/// In mm of way.
struct TravelWeights {
  double foreign = 20000;  // a wall of visibility 0.05, 0.4 mm wide, is worth a way of 400 mm
  double own = 40;
  double hidden = 0.5;
  double seam = 60;
};

/// Of one mm, beside the 1 of the way itself, for one nozzle.
inline double over_cost(const TravelWeights& w, LayerMap::Cell cell, int nozzle) {
  if (cell.extruder == LayerMap::air) return 0;
  if (cell.visibility == 0) return w.hidden;
  return (cell.extruder == nozzle ? w.own : w.foreign) * cell.visibility / 255;
}

/// The nozzles that hang at print height, and the layer below them. Positions are the carriage's: of nozzle 0.
class TravelCost {
 public:
  /// nozzle_offset_mm: of each extruder that hangs, by extruder; a map that outlives this.
  struct Nozzle {
    int extruder = 0;
    Vec2 offset_mm;
  };
  TravelCost(const LayerMap& map, std::vector<Nozzle> nozzles, const TravelWeights& weights)
      : map_(map), nozzles_(std::move(nozzles)), weights_(weights) {}

  /// Of the straight way from a to b.  Cost: about 3 ns for each nozzle and 0.2 mm.
  double way(Vec2 a, Vec2 b) const {
    const double length = distance(a, b);
    const int steps = int(length / step_mm) + 1;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const Vec2 p = lerp(a, b, (i + 0.5) / steps);
      for (const Nozzle& n : nozzles_) sum += over_cost(weights_, map_.at(p + n.offset_mm), n.extruder);
    }
    return length + sum * length / steps;
  }

  /// Of beginning or ending a road at a place of the part.
  double seam(Vec2 p_mm) const { return weights_.seam * map_.at(p_mm).visibility / 255; }

  const LayerMap& map() const { return map_; }
  const std::vector<Nozzle>& nozzles() const { return nozzles_; }

 private:
  static constexpr double step_mm = 0.2;
  const LayerMap& map_;
  std::vector<Nozzle> nozzles_;
  TravelWeights weights_;
};

}  // namespace cleancolor
