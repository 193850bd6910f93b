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
//
// planner = paper has the paper's costs instead:
//
//   cost of an edge p -> q  =  W_d x length / extent  +  sum over nozzles of M x visibility, where q is over another
//                              colour; a tenth of both along a wall of the rampart
//   cost of a start or end  =  visibility of the place
//
// What cannot be seen and what has the nozzle's own colour is free. Its edges are those of its grid of 0.05 mm: a
// longer way counts as a row of them, whatever the spacing of the nodes.
// Source: Hergel and Lefebvre, Clean color, section 6.4.
// Differs: visibility is charged where a path is begun and ended (the paper's Z, on the edges that enter and leave it),
// not where a travel runs along a path before it begins.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "model/config.hpp"
#include "plan/layer_map.hpp"

namespace cleancolor {

// A visibility that hardly shows.
inline constexpr double hardly_visible = 0.05;

/// In mm of way.
struct TravelWeights {
  double crossing = 1000;  // over foreign plastic that can be seen at all: a wall 0.4 mm wide is worth a way of 400 mm
  double foreign = 100;    // beside it, x visibility
  double own = 30;         // x visibility
  double hidden = 0.5;
  double seam = 300;  // x visibility
  double smear = 20;  // for each mm of way before foreign plastic is touched, x its visibility
  double hole = 100;  // for each mm of way before an outer wall, x visibility of its start

  friend bool operator==(const TravelWeights&, const TravelWeights&) = default;
};

/// As the options say.
inline TravelWeights travel_weights(const Config& c) {
  return {.crossing = c.weight_crossing,
          .foreign = c.weight_foreign,
          .own = c.weight_own,
          .hidden = c.weight_hidden,
          .seam = c.weight_seam,
          .smear = c.weight_smear,
          .hole = c.weight_hole};
}

/// Of one mm, beside the 1 of the way itself, for one nozzle.
inline double over_cost(const TravelWeights& w, LayerMap::Cell cell, int nozzle) {
  if (cell.extruder == LayerMap::air) return 0;
  if (cell.visibility == 0) return w.hidden;
  const double v = cell.visibility / 255.;
  if (cell.extruder == nozzle) return w.own * v;
  return w.crossing * std::min(1., v / hardly_visible) + w.foreign * v;
}

/// The paper's.
struct PaperWeights {
  double distance = 0.1;  // W_d: of a way as long as the extent
  double mismatch = 10;   // M, x visibility
  double rampart = 0.1;   // share of the cost along walls
  double edge_mm = 0.05;
  double extent_mm = 100;                             // the largest of the slice
  double mm() const { return extent_mm / distance; }  // of way that a cost of 1 is worth
};

/// Of the paper's edge that ends over this cell, for one nozzle.
inline double mismatch_cost(const PaperWeights& w, LayerMap::Cell cell, int nozzle) {
  return cell.extruder == LayerMap::air || cell.extruder == nozzle ? 0 : w.mismatch * cell.visibility / 255.;
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
  static TravelCost of_paper(const LayerMap& map, std::vector<Nozzle> nozzles, const PaperWeights& paper) {
    TravelCost cost(map, std::move(nozzles), {.seam = paper.mm(), .smear = 0, .hole = 0});
    cost.paper_ = paper;
    return cost;
  }

  struct Way {
    double cost = 0;
    double foreign = 0;  // the largest visibility of foreign plastic under a nozzle
  };

  /// The straight way from a to b.  Cost: about 3 ns for each nozzle and 0.2 mm.
  Way straight(Vec2 a, Vec2 b) const {
    if (paper_) return straight_of_paper(a, b);
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

  /// Of a mm there, beside the 1 of the way itself; not of_paper.
  double over(Vec2 p) const {
    double sum = 0;
    for (const Nozzle& n : nozzles_) sum += over_cost(weights_, map_.at(p + n.offset_mm), n.extruder);
    return sum;
  }

  /// Whether a nozzle hangs over foreign plastic of a larger visibility anywhere on the straight way from a to b; what
  /// its cost is summed over can leap over a corner.
  bool crosses(Vec2 a, Vec2 b, double visibility) const {
    const auto crosses = [&](const Nozzle& n) {
      return map_.any_along(a + n.offset_mm, b + n.offset_mm, [&](LayerMap::Cell cell) {
        return cell.extruder != n.extruder && cell.visibility > visibility * 255;
      });
    };
    return std::ranges::any_of(nozzles_, crosses);
  }

  /// Whether a nozzle hangs over foreign plastic of a larger visibility there.
  bool is_barred(Vec2 p, double visibility) const {
    return std::ranges::any_of(nozzles_, [&](const Nozzle& n) {
      const LayerMap::Cell cell = map_.at(p + n.offset_mm);
      return cell.visibility > visibility * 255 && cell.extruder != n.extruder;
    });
  }

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

  /// Whether a way costs something else the other way round.
  bool is_directed() const { return paper_.has_value(); }

  const LayerMap& map() const { return map_; }
  const std::vector<Nozzle>& nozzles() const { return nozzles_; }

 private:
  Way straight_of_paper(Vec2 a, Vec2 b) const {
    const double length = distance(a, b);
    const int edges = std::max(1, int(std::ceil(length / paper_->edge_mm - 1e-9)));
    std::vector<LayerMap::Cell> from(nozzles_.size());
    for (std::size_t k = 0; k < nozzles_.size(); ++k) from[k] = map_.at(a + nozzles_[k].offset_mm);
    Way way;
    for (int i = 1; i <= edges; ++i) {
      const Vec2 q = lerp(a, b, double(i) / edges);
      double mismatch = 0;
      bool along_wall = false;
      for (std::size_t k = 0; k < nozzles_.size(); ++k) {
        const int own = nozzles_[k].extruder;
        const LayerMap::Cell cell = map_.at(q + nozzles_[k].offset_mm);
        mismatch += mismatch_cost(*paper_, cell, own);
        along_wall = along_wall || (cell.wall != 0 && cell.wall == from[k].wall);
        if (cell.extruder != own) way.foreign = std::max(way.foreign, cell.visibility / 255.);
        from[k] = cell;
      }
      way.cost += (length / edges + mismatch * paper_->mm()) * (along_wall ? paper_->rampart : 1);
    }
    return way;
  }

  static constexpr double step_mm = 0.2;
  static constexpr double short_hop_mm = 1, stop_mm = 18;  // a travel that is no short one loses the time of so many mm
  const LayerMap& map_;
  std::vector<Nozzle> nozzles_;
  TravelWeights weights_;
  std::optional<PaperWeights> paper_;
};

}  // namespace cleancolor
