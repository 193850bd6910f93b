#include "plan/refill.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>

#include "plan/clear_way.hpp"
#include "plan/wall_room.hpp"

namespace cleancolor {
namespace {

constexpr double farthest_wall_mm = 15;     // of the wall from where the outer wall begins
constexpr double shortest_pass_mm = 1.5;    // pass
constexpr double usual_area_mm2 = 0.06;     // by which the length of a pass is chosen
constexpr double least_mm = 20;             // of way that a refill must be worth
constexpr double least_pushed_mm3 = 0.005;  // that can be pushed

struct OnWall {
  const Path* wall = nullptr;
  std::size_t segment = 0;
  Vec2 at_mm;
};

OnWall nearest(const std::vector<const Path*>& walls, Vec2 p) {
  OnWall best;
  double least = farthest_wall_mm * farthest_wall_mm;
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
      : roads_(roads), cost_(cost), model_(model), options_(options), room_(cost.map(), options.gap_mm) {}

  void stand(const Path& wall) {
    room_.stand(wall);
    walls_.push_back(&wall);
  }

  /// A pass between two paths, and the second one's new travel; nothing where there is none.
  struct Pass {
    Path refill;
    std::vector<Vec2> travel;
  };
  std::optional<Pass> between(const Path& before, const Path& path) {
    if (walls_.empty() || is_auxiliary(path.road().role)) return std::nullopt;
    return options_.mode == RefillMode::fixed ? fixed(before, path) : forecast(before, path);
  }

 private:
  /// On the way as it is.
  std::optional<Pass> fixed(const Path& before, const Path& path) {
    if (!begins_outer_wall(path) && before.road().role != Role::rampart) return std::nullopt;
    std::vector<Vec2> way{before.end() - offset_of(before.extruder) + offset_of(path.extruder)};
    way.insert(way.end(), path.travel.begin(), path.travel.end());
    way.push_back(path.start());
    const auto room = room_.longest_pass(way, shortest_pass_mm);
    if (!room) return std::nullopt;
    auto refill = laid(*room, options_.volume_mm3, path);
    if (!refill) return std::nullopt;
    refill->travel = room->before_mm;
    return Pass{std::move(*refill), room->after_mm};
  }

  /// On a way by the nearest wall, where that is worth it.
  std::optional<Pass> forecast(const Path& before, const Path& path) {
    if (!begins_outer_wall(path) || path.extruder != before.extruder) return std::nullopt;
    const double visible = visibility_ahead(path, 0, path.start(), cost_.map());
    const double hop_mm = travel_mm(before.end(), path);
    const double worth = options_.hole_mm * visible;
    if (worth * missing_mm3(hop_mm) < least_mm) return std::nullopt;
    const OnWall place = nearest(walls_, path.start());
    if (place.wall == nullptr) return std::nullopt;

    const double wanted_mm = std::max(shortest_pass_mm, missing_mm3(hop_mm + farthest_wall_mm) / usual_area_mm2);
    const auto room = room_.longest_pass(along(place, wanted_mm), shortest_pass_mm);
    if (!room) return std::nullopt;
    const Vec2 offset = offset_of(path.extruder);
    const PlannedWay there =
        way_between(roads_, cost_, path.extruder, before.end() - offset, room->points_mm.front() - offset);
    const PlannedWay back =
        way_between(roads_, cost_, path.extruder, room->points_mm.back() - offset, path.start() - offset);
    const double mm3 = missing_mm3(there.way_mm);
    const double unfilled_mm3 = std::max(0., mm3 - room->most_area_mm2 * room->length_mm);
    if (there.cost + back.cost + worth * (unfilled_mm3 + missing_mm3(back.way_mm)) + least_mm >
        straightened(before, path) + worth * missing_mm3(hop_mm))
      return std::nullopt;
    auto refill = laid(*room, mm3, path);
    if (!refill) return std::nullopt;
    if (crosses_on(before.end() - offset, there, room->points_mm.front() - offset) ||
        crosses_on(room->points_mm.back() - offset, back, path.start() - offset))
      return std::nullopt;
    for (const Vec2 c : there.between_mm) refill->travel.push_back(c + offset);
    Pass pass{std::move(*refill), {}};
    for (const Vec2 c : back.between_mm) pass.travel.push_back(c + offset);
    return pass;
  }

  bool crosses_on(Vec2 from, const PlannedWay& way, Vec2 to) const {
    std::vector<Vec2> points{from};
    points.insert(points.end(), way.between_mm.begin(), way.between_mm.end());
    points.push_back(to);
    return crosses(cost_, points);
  }

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
  /// The pass as a path, with so much plastic, or what there is room for.
  std::optional<Path> laid(const WallRoom::Pass& pass, double mm3, const Path& next) {
    mm3 = std::min(mm3, pass.most_area_mm2 * pass.length_mm);
    if (mm3 < least_pushed_mm3) return std::nullopt;
    const auto& diameters = options_.filament_diameter_mm;
    const Refill push{.volume_mm3 = mm3,
                      .feed_mm_s = options_.feed_mm_s,
                      .filament_diameter_mm = diameters[std::min(std::size_t(next.extruder), diameters.size() - 1)]};
    Road road = pass.wall;
    road.role = Role::refill;
    road.area_mm2 = mm3 / pass.length_mm;
    road.width_mm = road.area_mm2 / road.height_mm;
    road.speed_mm_s = refill_speed(pass.length_mm, push);
    room_.lay(pass, road.area_mm2);
    Path path;
    path.extruder = next.extruder;
    path.island = -1;
    path.points = pass.points_mm;
    path.stretches = {{0, road}};
    return path;
  }

  const Roadmap& roads_;
  const TravelCost& cost_;
  const OozeModel& model_;
  const RefillOptions& options_;
  WallRoom room_;
  std::vector<const Path*> walls_;
};

}  // namespace

double refill_speed(double length_mm, const Refill& refill) {
  const double filament_mm2 = std::numbers::pi / 4 * refill.filament_diameter_mm * refill.filament_diameter_mm;
  return std::min(refill.max_speed_mm_s, length_mm * refill.feed_mm_s * filament_mm2 / refill.volume_mm3);
}

RefillOptions refill_options(const Config& config, int extruder) {
  RefillOptions options{.mode = config.refill_mode,
                        .volume_mm3 = config.refill_volume_mm3,
                        .feed_mm_s = config.refill_speed_mm_s,
                        .filament_diameter_mm = {},
                        .gap_mm = config.rampart_gap_mm,
                        .hole_mm = config.weight_hole_volume * config.travel_speed_mm_s / config.weight_time,
                        .hop = hop_time(config, extruder)};
  for (const Extruder& e : config.extruders) options.filament_diameter_mm.push_back(e.filament_diameter_mm);
  return options;
}

std::vector<Path> with_refills(std::vector<Path> paths, const Roadmap& roads, const TravelCost& cost,
                               const OozeModel& model, const RefillOptions& options) {
  Refills refills(roads, cost, model, options);
  std::vector<Path> result;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    if (k > 0)
      if (auto pass = refills.between(paths[k - 1], paths[k])) {
        result.push_back(std::move(pass->refill));
        paths[k].travel = std::move(pass->travel);
      }
    result.push_back(paths[k]);
    if (paths[k].road().role == Role::rampart) refills.stand(paths[k]);
  }
  return result;
}

}  // namespace cleancolor
