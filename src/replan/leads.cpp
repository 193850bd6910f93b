#include "replan/leads.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "plan/joined_loops.hpp"

namespace cleancolor {
namespace {

constexpr double least_stroke_mm = 0.05;
constexpr double least_mm3 = 0.003;   // missing that is worth a stroke
constexpr double probe_widths = 0.7;  // plastic goes on so far on one side of a wall, and ends before on the other

/// A stroke inside the part, by the road of a wall.
Path stroke(Vec2 from, const Path& wall, double missing_mm3) {
  Path path;
  path.extruder = wall.extruder;
  path.island = wall.island;
  path.points = {from, wall.start()};
  Road road = wall.road();
  const double share = std::min(1., missing_mm3 / (length_mm(path) * road.area_mm2));
  road.role = Role::refill;
  road.area_mm2 *= share;
  road.width_mm *= share;
  path.stretches = {{0, road}};
  return path;
}

/// The wall with its plastic to the left of its start, as lead_mm and led_inside take it; slicers walk holes either
/// way. Nothing where it is not plain which side that is.
std::optional<Path> with_plastic_left(Path wall, const Polygons& region) {
  const Vec2 start = wall.start(), along = wall.points[1] - wall.points.back();
  if (length(along) == 0) return std::nullopt;
  const Vec2 side = Vec2{-along.y, along.x} * (probe_widths * wall.road().width_mm / length(along));
  const bool left = contains(region, to_nm(start + side)), right = contains(region, to_nm(start - side));
  if (left == right) return std::nullopt;
  if (right) std::reverse(wall.points.begin() + 1, wall.points.end());
  return wall;
}

/// The stroke to a single wall; nothing where there is no room for it.
std::optional<Path> lead(const Path& path, double missing_mm3, const Polygons& region,
                         std::span<const Path* const> loops) {
  const std::optional<Path> wall = with_plastic_left(path, region);
  if (!wall) return std::nullopt;
  const double room_mm = lead_mm(*wall, 0, wall->start(), loops);
  if (room_mm <= 0) return std::nullopt;
  return stroke(led_inside(*wall, room_mm).start(), path, missing_mm3);
}

/// That oozes out on a way.
double missing_mm3(double way_mm, int extruder, const LeadOptions& options) {
  const double way_s = options.hop[std::size_t(extruder)].seconds(way_mm);
  return options.ooze.volume_mm3 * (1 - options.ooze.left(way_s));
}

}  // namespace

std::optional<Path> stroke_between(const Path& inner, double gap_mm, const Path& outer, const LeadOptions& options) {
  Vec2 at = inner.start();
  for (std::size_t i = inner.points.size(); i-- > 0 && gap_mm > 0;) {
    const double way = distance(at, inner.points[i]);
    at = way > gap_mm ? lerp(at, inner.points[i], gap_mm / way) : inner.points[i];
    gap_mm -= way;
  }
  const double way_mm = distance(at, outer.start());
  if (way_mm < least_stroke_mm) return std::nullopt;
  return stroke(at, outer, missing_mm3(way_mm, outer.extruder, options));
}

Layer with_leads(Layer layer, const std::vector<Polygons>& regions, const Path* from, const LeadOptions& options) {
  std::map<std::pair<int, int>, std::vector<const Path*>> loops;  // of each extruder and island
  for (const Path& path : layer.paths)
    if (path.island >= 0 && path.depth != fill_depth) loops[{path.extruder, path.island}].push_back(&path);
  std::vector<std::optional<Path>> leads;
  for (const Path& path : layer.paths) {
    const Path* before = std::exchange(from, &path);
    std::optional<Path>& own = leads.emplace_back();
    if (!path.closed || path.island < 0 || path.depth != 0 || path.inner_source >= 0 || before == nullptr) continue;
    const double missing = before->extruder == path.extruder
                               ? missing_mm3(travel_mm(before->end(), path), path.extruder, options)
                               : options.ooze.volume_mm3;
    if (missing >= least_mm3)
      own = lead(path, missing, regions[std::size_t(path.extruder)], loops[{path.extruder, path.island}]);
  }
  std::vector<Path> result;
  for (std::size_t i = 0; i < layer.paths.size(); ++i) {
    if (leads[i]) {
      leads[i]->travel = std::exchange(layer.paths[i].travel, {});  // it begins beside the wall's start
      result.push_back(std::move(*leads[i]));
    }
    result.push_back(std::move(layer.paths[i]));
  }
  layer.paths = std::move(result);
  return layer;
}

}  // namespace cleancolor
