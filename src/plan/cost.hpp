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

#include <algorithm>
#include <utility>
#include <vector>

#include "plan/layer_map.hpp"

namespace cleancolor {

/// In mm of way.
struct TravelWeights {
  double crossing = 1000;  // over foreign plastic that can be seen at all: a wall 0.4 mm wide is worth a way of 400 mm
  double foreign = 100;    // beside it, x visibility
  double own = 30;         // x visibility
  double hidden = 0.5;
  double seam = 300;  // x visibility
  double smear = 20;  // for each mm of way before foreign plastic is touched, x its visibility
  double hole = 100;  // for each mm of way before an outer wall, x visibility of its start
};

/// Of one mm, beside the 1 of the way itself, for one nozzle.
inline double over_cost(const TravelWeights& w, LayerMap::Cell cell, int nozzle) {
  if (cell.extruder == LayerMap::air) return 0;
  if (cell.visibility == 0) return w.hidden;
  const double v = cell.visibility / 255.;
  if (cell.extruder == nozzle) return w.own * v;
  // Below 0.05 it hardly shows.
  return w.crossing * std::min(1., v / 0.05) + w.foreign * v;
}

/// The nozzles that hang at print height, and the layer below them. Positions are the carriage's: of nozzle 0.
class TravelCost {
 public:
  struct Nozzle {
    int extruder = 0;
    Vec2 offset_mm;
    Polygons reach;  // where it can go while it is in use, convex; empty: anywhere
  };
  TravelCost(const LayerMap& map, std::vector<Nozzle> nozzles, const TravelWeights& weights)
      : map_(map), nozzles_(std::move(nozzles)), weights_(weights) {}

  struct Way {
    double cost = 0;
    double foreign = 0;  // the largest visibility of foreign plastic under a nozzle
  };

  /// The straight way from a to b.  Cost: about 3 ns for each nozzle and 0.2 mm.
  Way straight(Vec2 a, Vec2 b) const {
    const double length = distance(a, b);
    const int steps = int(length / step_mm) + 1;
    double sum = 0;
    int foreign = 0;
    for (int i = 0; i < steps; ++i) {
      const Vec2 p = lerp(a, b, (i + 0.5) / steps);
      for (const Nozzle& n : nozzles_) {
        const LayerMap::Cell cell = map_.at(p + n.offset_mm);
        sum += over_cost(weights_, cell, n.extruder);
        if (cell.extruder != n.extruder) foreign = std::max(foreign, int(cell.visibility));
      }
    }
    return {length + sum * length / steps, foreign / 255.};
  }
  double way(Vec2 a, Vec2 b) const { return straight(a, b).cost; }

  /// Of touching foreign plastic of this visibility after a way of so many mm since the last touch: what has oozed out.
  double smear(double foreign, double way_mm) const { return weights_.smear * foreign * way_mm; }

  /// Of beginning or ending a road at a place of the part.
  double seam(Vec2 p_mm) const { return weights_.seam * visibility(p_mm); }

  /// Of beginning an outer wall of this visibility after a way of so many mm: plastic that oozed out is missing there.
  double hole(double visible, double way_mm) const {
    return weights_.hole * visible * (way_mm + (way_mm > short_hop_mm ? stop_mm : 0));
  }

  double visibility(Vec2 p_mm) const { return map_.at(p_mm).visibility / 255.; }

  /// Whether the nozzle in use can be where it is when the carriage is at c.
  static bool reaches(const Nozzle& nozzle, Vec2 c) {
    return nozzle.reach.empty() || contains(nozzle.reach, to_nm(c + nozzle.offset_mm));
  }

  const LayerMap& map() const { return map_; }
  const std::vector<Nozzle>& nozzles() const { return nozzles_; }

 private:
  static constexpr double step_mm = 0.2;
  static constexpr double short_hop_mm = 1, stop_mm = 18;  // a travel that is no short one loses the time of so many mm
  const LayerMap& map_;
  std::vector<Nozzle> nozzles_;
  TravelWeights weights_;
};

}  // namespace cleancolor
