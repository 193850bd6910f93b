// A layer drawn for the planner's tests: regions of two colours, paths, what lies where.
#pragma once

#include <random>

#include "plan/layer_map.hpp"
#include "plan/roadmap.hpp"

namespace cleancolor::test {

inline const Road drawn_road{
    .role = Role::perimeter, .width_mm = 0.4, .height_mm = 0.2, .area_mm2 = 0.08, .speed_mm_s = 40};

inline Path drawn_path(int extruder, std::vector<Vec2> points, bool closed, int depth = fill_depth, int island = 0,
                       Role role = Role::perimeter) {
  Path path;
  path.extruder = extruder;
  path.island = island;
  path.depth = depth;
  path.closed = closed;
  path.points = std::move(points);
  path.stretches = {{0, drawn_road}};
  path.stretches.front().road.role = role;
  return path;
}

/// Two colours in one layer of a part that goes straight up, far above the bed: its walls are in full sight.
struct DrawnLayer {
  std::vector<Polygons> regions;
  Polygons outline;
  Polygons above;
  SurfaceVisibility visibility;

  explicit DrawnLayer(std::vector<Polygons> both)
      : regions(std::move(both)),
        outline(united(regions[0], regions[1])),
        above(outline),
        visibility(std::vector<PackedPolygons>(60, outline), std::vector<double>(60, 1.)) {}

  LayerMap map(std::span<const Path> walls = {}) const {
    return LayerMap({regions, outline, above, 45, 0.4}, walls, visibility);
  }
};

inline Polygons at(const Polygons& region, Vec2 by_mm) {
  Polygons result = region;
  for (Ring& ring : result)
    for (Point& p : ring) p = to_nm(to_mm(p) + by_mm);
  return result;
}

/// Rectangles of both colours, apart or touching, and their outer walls; as many as asked for, where they find room.
inline DrawnLayer random_drawn_layer(std::mt19937& random, int count, double size_mm, std::vector<Path>& paths) {
  const auto any = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  std::vector<Polygons> regions(2);
  Polygons taken;
  for (int i = 0; i < count; ++i) {
    const Vec2 p{any(0, size_mm), any(0, size_mm)}, s{any(3, 10), any(3, 10)};
    const Polygons box = rectangle(p, p + s);
    if (!intersection(offset(box, 2), taken).empty()) continue;
    const int extruder = int(random() % 2);
    taken = united(taken, box);
    regions[std::size_t(extruder)] = united(regions[std::size_t(extruder)], box);
    const Vec2 in{0.2, 0.2};
    paths.push_back(drawn_path(extruder, to_mm(rectangle(p + in, p + s - in).front()), true, 0, i));
  }
  return DrawnLayer(std::move(regions));
}

}  // namespace cleancolor::test
