#include "plan/refill.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>

namespace cleancolor {
namespace {

constexpr double farthest_mm = 15;      // of the wall from where the outer wall begins
constexpr double shortest_mm = 1.5;     // pass
constexpr double most_area_mm2 = 0.06;  // of plastic beside the wall's own
constexpr double least_mm = 20;         // of way that a refill must be worth
constexpr double fastest_mm_s = 120;
constexpr double filament_mm_s = 2;  // at which plastic is pushed

struct OnWall {
  const Path* wall = nullptr;
  std::size_t segment = 0;
  Vec2 at_mm;
};

OnWall nearest(const std::vector<const Path*>& walls, Vec2 p) {
  OnWall best;
  double least = farthest_mm * farthest_mm;
  for (const Path* wall : walls)
    for (std::size_t i = 0; i < wall->segments(); ++i) {
      const Vec2 q = nearest_on_segment(wall->points[i], wall->points[(i + 1) % wall->points.size()], p);
      if (length_squared(q - p) >= least) continue;
      least = length_squared(q - p);
      best = {wall, i, q};
    }
  return best;
}

/// The wall from there on, so long; shorter at the end of an open wall.
std::vector<Vec2> along(const OnWall& place, double length_mm) {
  std::vector<Vec2> points{place.at_mm};
  const std::vector<Vec2>& all = place.wall->points;
  std::size_t i = place.segment;
  for (std::size_t k = 0; k < place.wall->segments() && length_mm > 1e-6; ++k) {
    if (!place.wall->closed && i + 1 >= all.size()) break;
    const Vec2 next = all[(i + 1) % all.size()];
    const double way = distance(points.back(), next);
    if (way > 1e-6) points.push_back(lerp(points.back(), next, std::min(1., length_mm / way)));
    length_mm -= way;
    i = (i + 1) % all.size();
  }
  return points;
}

class Refills {
 public:
  Refills(const Roadmap& roads, const TravelCost& cost, const OozeModel& model, const RefillOptions& options)
      : roads_(roads), cost_(cost), model_(model), options_(options) {}

  /// A pass between two paths of one nozzle, and the second one's new travel; nothing where it is not worth it.
  struct Pass {
    Path refill;
    std::vector<Vec2> travel;
  };
  std::optional<Pass> between(const Path& before, const Path& path, const std::vector<const Path*>& walls) const {
    const double visible = visibility_ahead(path, 0, path.start(), cost_.map());
    const double hop_mm = travel_mm(before.end(), path);
    const double worth = options_.hole_mm * visible;
    if (worth * missing_mm3(hop_mm) < least_mm) return std::nullopt;
    const OnWall place = nearest(walls, path.start());
    if (place.wall == nullptr) return std::nullopt;

    const Vec2 offset = offset_of(path.extruder);
    const PlannedWay there = way_between(roads_, cost_, path.extruder, before.end() - offset, place.at_mm - offset);
    const double mm3 = missing_mm3(there.way_mm);
    Pass pass{.refill = path, .travel = {}};
    pass.refill.points = along(place, std::max(shortest_mm, mm3 / most_area_mm2));
    if (pass.refill.points.size() < 2) return std::nullopt;
    const PlannedWay back =
        way_between(roads_, cost_, path.extruder, pass.refill.points.back() - offset, path.start() - offset);
    if (there.cost + back.cost + worth * missing_mm3(back.way_mm) + least_mm >
        straightened(before, path) + worth * missing_mm3(hop_mm))
      return std::nullopt;
    finish(pass, mm3, *place.wall);
    for (const Vec2 c : there.between_mm) pass.refill.travel.push_back(c + offset);
    for (const Vec2 c : back.between_mm) pass.travel.push_back(c + offset);
    return pass;
  }

 private:
  double missing_mm3(double way_mm) const {
    return model_.volume_mm3 * (1 - model_.left(options_.hop.seconds(way_mm)));
  }
  Vec2 offset_of(int extruder) const {
    for (const auto& n : cost_.nozzles())
      if (n.extruder == extruder) return n.offset_mm;
    return {};
  }
  /// What the planned travel costs as it is.
  double straightened(const Path& before, const Path& path) const {
    const Vec2 offset = offset_of(path.extruder);
    Vec2 from = before.end();
    double sum = 0;
    for (const Vec2 p : path.travel) sum += cost_.way(from - offset, p - offset), from = p;
    return sum + cost_.way(from - offset, path.start() - offset);
  }
  /// Its road: slow enough for so much plastic.
  void finish(Pass& pass, double mm3, const Path& wall) const {
    Path& refill = pass.refill;
    refill.closed = false;
    refill.island = -1;
    refill.depth = fill_depth;
    refill.travel.clear();
    Road road = wall.road();
    const double length = length_mm(refill);
    road.role = Role::refill;
    road.area_mm2 = mm3 / length;
    road.width_mm = road.area_mm2 / road.height_mm;
    constexpr double filament_mm = 1.75;
    const double flow_mm3_s = filament_mm_s * std::numbers::pi / 4 * filament_mm * filament_mm;
    road.speed_mm_s = std::min({fastest_mm_s, road.speed_mm_s, length * flow_mm3_s / mm3});
    refill.stretches = {{0, road}};
  }

  const Roadmap& roads_;
  const TravelCost& cost_;
  const OozeModel& model_;
  const RefillOptions& options_;
};

}  // namespace

std::vector<Path> with_refills(std::vector<Path> paths, const Roadmap& roads, const TravelCost& cost,
                               const OozeModel& model, const RefillOptions& options) {
  const Refills refills(roads, cost, model, options);
  std::vector<Path> result;
  std::vector<const Path*> walls;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    const bool may_lack = k > 0 && begins_outer_wall(paths[k]) && paths[k].extruder == paths[k - 1].extruder;
    if (may_lack && !walls.empty())
      if (auto pass = refills.between(paths[k - 1], paths[k], walls)) {
        result.push_back(std::move(pass->refill));
        paths[k].travel = std::move(pass->travel);
      }
    result.push_back(paths[k]);
    if (paths[k].road().role == Role::rampart) walls.push_back(&paths[k]);
  }
  return result;
}

}  // namespace cleancolor
