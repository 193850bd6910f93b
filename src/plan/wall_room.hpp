// plan/wall_room.hpp
//
// Wall room: how much more plastic the strip beside the standing walls of a rampart can take, by the mm of wall.
//
//   a way of one nozzle  ->  its longest piece along a wall, and the area of road that fits there
//
// The strip reaches half a rampart_gap to either side of a wall's centre line, so that those of two neighbouring walls
// share their corridor. On the wall's own road a little more sticks; beside it lies a road at most twice as wide, and
// all roads together leave the layer as high as it is. What is laid is kept account of, so passes may overlap.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "plan/layer_map.hpp"

namespace cleancolor {

class WallRoom {
 public:
  /// gap_mm: from wall to wall.
  WallRoom(const LayerMap& map, double gap_mm) : map_(map), gap_mm_(gap_mm) {}

  /// From now on the wall stands.  Requires: it outlives this.
  void stand(const Path& wall);
  bool empty() const { return walls_.empty(); }

  struct Pass {
    std::vector<Vec2> before_mm, after_mm;  // places of the way passed before and after, its ends left out
    std::vector<Vec2> points_mm;
    double length_mm = 0;
    double most_area_mm2 = 0;  // of road
    Road wall;                 // of the first wall passed
    struct Use {
      std::size_t wall = 0, mm = 0;  // which millimetre of it
      double length_mm = 0;
    };
    std::vector<Use> uses;
  };

  /// The longest piece of the way, as long as `shortest_mm`, that runs along standing walls in their strip, two road
  /// widths away from the part, where half of the room is left; of equals the first.
  /// Cost: segments of all walls x 5 ns for each 0.5 mm of way.
  std::optional<Pass> longest_pass(std::span<const Vec2> way_mm, double shortest_mm) const;

  /// Takes the room of a pass with this road.  Requires: area_mm2 <= pass.most_area_mm2.
  void lay(const Pass& pass, double area_mm2);

  /// What passes have laid on that millimetre of wall, mm3.
  double laid_mm3(std::size_t wall, std::size_t mm) const { return walls_[wall].laid_mm3[mm]; }
  /// So many millimetres of the wall are kept account of.
  std::size_t size_mm(std::size_t wall) const { return walls_[wall].laid_mm3.size(); }

 private:
  struct Wall {
    const Path* path = nullptr;
    std::vector<double> begin_mm;  // of each segment
    std::vector<double> laid_mm3;  // on each mm
  };
  struct Place {
    std::size_t wall = 0;
    double along_mm = 0, distance_mm = 0;
    Vec2 direction;
  };
  struct Step;
  std::optional<Place> nearest(Vec2 p) const;
  double area_mm2(const Place& place) const;
  bool is_clear(Vec2 p, double by_mm) const;
  std::vector<Step> steps(std::span<const Vec2> way_mm) const;
  bool is_usable(const Step& step) const;
  Pass pass(std::span<const Vec2> way_mm, std::span<const Step> steps) const;

  const LayerMap& map_;
  double gap_mm_;
  std::vector<Wall> walls_;
};

}  // namespace cleancolor
