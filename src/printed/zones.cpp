#include "printed/zones.hpp"

#include <algorithm>

namespace cleancolor {

std::vector<Zone> zones_of(const std::vector<Polygons>& regions) {
  std::vector<Zone> zones;
  for (std::size_t n = 0; n < regions.size(); ++n)
    for (const Island& island : islands(regions[n]))
      zones.push_back({int(n), polygons(island), bounds_mm({island.outline})});
  return zones;
}

int zone_of(const Path& path, const std::vector<Zone>& zones) {
  if (is_auxiliary(path.road().role)) return -1;
  constexpr std::size_t most_looked_at = 9;
  const std::size_t step = std::max<std::size_t>(1, path.points.size() / most_looked_at);
  std::vector<int> hits(zones.size());
  for (std::size_t i = 0; i < path.points.size(); i += step) {
    const Vec2 p = path.points[i];
    for (std::size_t z = 0; z < zones.size(); ++z) {
      const Box<Vec2>& box = zones[z].box;
      const bool near = p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y;
      if (near && zones[z].nozzle == path.extruder && contains(zones[z].region, to_nm(p))) ++hits[z];
    }
  }
  const auto best = std::ranges::max_element(hits);
  return best == hits.end() || *best == 0 ? -1 : int(best - hits.begin());
}

}  // namespace cleancolor
