#include "toolpath/path.hpp"

#include <algorithm>
#include <cassert>

namespace cleancolor {

double length_mm(const Path& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.points.size(); ++i) sum += distance(path.points[i - 1], path.points[i]);
  if (path.closed) sum += distance(path.points.back(), path.points.front());
  return sum;
}

double volume_mm3(const Path& path) {
  double sum = 0;
  const std::size_t n = path.points.size();
  for (std::size_t s = 0; s < path.stretches.size(); ++s) {
    const std::size_t last = s + 1 < path.stretches.size() ? path.stretches[s + 1].first_segment : path.segments();
    for (std::size_t i = path.stretches[s].first_segment; i < last; ++i)
      sum += distance(path.points[i], path.points[(i + 1) % n]) * path.stretches[s].road.area_mm2;
  }
  return sum;
}

double travel_mm(Vec2 from, const Path& path) {
  double sum = 0;
  for (const Vec2 p : path.travel) sum += distance(from, p), from = p;
  return sum + distance(from, path.start());
}

bool within(const Path& path, const Polygons& area) {
  return std::ranges::all_of(path.points, [&](Vec2 p) { return contains(area, to_nm(p)); });
}

Path started_at(Path path, std::size_t first) {
  assert(path.closed && first < path.points.size());
  if (first == 0) return path;
  std::rotate(path.points.begin(), path.points.begin() + std::ptrdiff_t(first), path.points.end());
  if (path.stretches.size() == 1) return path;

  // The stretch that held at the new first segment now begins there, and holds again up to its end at the very last.
  const auto n = std::uint32_t(path.points.size());
  const auto shift = std::uint32_t(first);
  const auto after = std::upper_bound(path.stretches.begin(), path.stretches.end(), shift,
                                      [](std::uint32_t s, const Stretch& t) { return s < t.first_segment; });
  std::vector<Stretch> turned = {{0, (after - 1)->road}};
  for (auto s = after; s != path.stretches.end(); ++s) turned.push_back({s->first_segment - shift, s->road});
  for (auto s = path.stretches.begin(); s != after; ++s)
    if (s->first_segment < shift) turned.push_back({s->first_segment + n - shift, s->road});
  path.stretches = std::move(turned);
  return path;
}

Path started_on(Path path, std::size_t segment, Vec2 p) {
  path.points.insert(path.points.begin() + std::ptrdiff_t(segment) + 1, p);
  for (Stretch& s : path.stretches)
    if (s.first_segment > segment) ++s.first_segment;
  return started_at(std::move(path), segment + 1);
}

Path reversed(Path path) {
  // A closed path keeps its first point: 0 1 2 3 becomes 0 3 2 1.
  std::reverse(path.points.begin() + (path.closed ? 1 : 0), path.points.end());
  const auto n = std::uint32_t(path.segments());
  std::vector<Stretch> turned;
  for (std::size_t s = path.stretches.size(); s-- > 0;) {
    const std::uint32_t last = s + 1 < path.stretches.size() ? path.stretches[s + 1].first_segment : n;
    turned.push_back({n - last, path.stretches[s].road});
  }
  path.stretches = std::move(turned);
  return path;
}

std::string_view role_name(Role role) {
  switch (role) {
    case Role::external_perimeter:
      return "External perimeter";
    case Role::perimeter:
      return "Perimeter";
    case Role::overhang_perimeter:
      return "Overhang perimeter";
    case Role::internal_infill:
      return "Internal infill";
    case Role::solid_infill:
      return "Solid infill";
    case Role::top_solid_infill:
      return "Top solid infill";
    case Role::bridge_infill:
      return "Bridge infill";
    case Role::gap_fill:
      return "Gap fill";
    case Role::skirt_brim:
      return "Skirt/Brim";
    case Role::prime:
    case Role::rampart:
    case Role::refill:
      return "Skirt/Brim";
    case Role::ironing:
      return "Ironing";
    case Role::support:
      return "Support material";
    case Role::support_interface:
      return "Support material interface";
    case Role::wipe_tower:
      return "Wipe tower";
    case Role::custom:
      return "Custom";
    case Role::unknown:
      return "Unknown";
  }
  return "Unknown";
}

}  // namespace cleancolor
