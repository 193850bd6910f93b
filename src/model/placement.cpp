#include "model/placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <numbers>
#include <set>

#include "base/error.hpp"
#include "base/polygon.hpp"
#include "model/reach.hpp"

namespace cleancolor {

namespace {

constexpr double rounding_mm = 0.001;  // parts may stick out this far: coordinates come from floats

std::set<int> extruders_of(std::span<const Part> parts) {
  std::set<int> extruders;
  for (const Part& part : parts) extruders.insert(*part.extruder);
  return extruders;
}

std::string listed(const std::set<int>& extruders) {
  std::string text;
  for (const int e : extruders) text += fmt::format("{}{}", text.empty() ? "" : ", ", e + 1);
  return text;
}

Box<Vec3> common_box(std::span<const Part> parts) {
  Box<Vec3> box;
  for (const Part& part : parts)
    for (const Vec3& p : part.mesh.vertices) box.add(p);
  return box;
}

void turn_and_scale(std::span<Part> parts, double rotate_deg, double scale) {
  if (rotate_deg == 0 && scale == 1) return;
  // Quarter turns are exact: no box may grow by the rounding of a cosine.
  const double quarters = rotate_deg / 90;
  const bool is_quarter = quarters == std::floor(quarters);
  const double angle = rotate_deg * std::numbers::pi / 180;
  const double c = (is_quarter ? std::round(std::cos(angle)) : std::cos(angle)) * scale;
  const double s = (is_quarter ? std::round(std::sin(angle)) : std::sin(angle)) * scale;
  for (Part& part : parts)
    for (Vec3& p : part.mesh.vertices) p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z * scale};
}

void move(std::span<Part> parts, Vec3 by) {
  for (Part& part : parts)
    for (Vec3& p : part.mesh.vertices) p = p + by;
}

std::string size_text(Vec3 size) {
  return fmt::format("{:.1f} x {:.1f} x {:.1f} mm", size.x, size.y, size.z);
}

/// By how much outlines are printed larger than the parts.
double growth_mm(const Config& config) {
  return std::max(0.0, config.xy_size_compensation_mm);
}

std::string growth_text(const Config& config) {
  return growth_mm(config) > 0 ? fmt::format(" (with xy_size_compensation = {:g})", growth_mm(config)) : "";
}

/// Throws where the box of all parts is larger than the print volume.
void require_size(const Box<Vec3>& box, const Config& config, std::span<const Part> parts) {
  const double grown_mm = 2 * growth_mm(config);
  const Vec3 size = box.size() + Vec3{grown_mm, grown_mm, 0};
  const Vec2 bed = bounds_mm(bed_region(config)).size();
  const Vec3 room{bed.x, bed.y, config.max_print_height_mm};
  if (size.x <= room.x + rounding_mm && size.y <= room.y + rounding_mm && size.z <= room.z + rounding_mm) return;
  throw Error(
      fmt::format("{}{} too large: {}{}, but the print volume is {}; use --scale or --rotate, or choose another "
                  "printer",
                  parts.front().name, parts.size() == 1 ? ":" : ": it and the other parts together are",
                  size_text(size), growth_text(config), size_text(room)));
}

Box<Vec3> printed_box(const Part& part, double growth_mm) {
  Box<Vec3> box = bounds(part.mesh);
  box.min = box.min - Vec3{growth_mm, growth_mm, 0};
  box.max = box.max + Vec3{growth_mm, growth_mm, 0};
  return box;
}

bool lies_in(const Part& part, double growth_mm, const Polygons& area) {
  // Boxes first: they tell most cases, and keep coordinates within the range of Clipper.
  const Box<Vec3> box = printed_box(part, growth_mm);
  const Box<Vec2> room = bounds_mm(area);
  if (box.min.x < room.min.x || box.max.x > room.max.x || box.min.y < room.min.y || box.max.y > room.max.y)
    return false;
  Ring shadow;
  for (const Vec3& p : part.mesh.vertices) shadow.push_back(to_nm({p.x, p.y}));
  return difference(offset({convex_hull({shadow})}, growth_mm), area).empty();
}

/// Throws where the outline of a part leaves what its nozzle reaches.
void require_reach(std::span<const Part> parts, const Config& config) {
  for (const Part& part : parts) {
    const Polygons area = offset(reach(config, *part.extruder), rounding_mm);
    if (lies_in(part, growth_mm(config), area)) continue;
    const Box<Vec3> box = printed_box(part, growth_mm(config));
    const Box<Vec2> room = bounds_mm(area);
    throw Error(fmt::format(
        "{}: would lie at X {:.1f} to {:.1f}, Y {:.1f} to {:.1f}{}, but extruder {} reaches only X {:.1f} to "
        "{:.1f}, Y {:.1f} to {:.1f} of the bed; move it with --center, or print it with another extruder",
        part.name, box.min.x, box.max.x, box.min.y, box.max.y, growth_text(config), *part.extruder + 1, room.min.x,
        room.max.x, room.min.y, room.max.y));
  }
}

bool apart(double min_a, double max_a, double min_b, double max_b) {
  return max_a < min_b || max_b < min_a;
}

/// Parts drawn around the origin or somewhere on the bed are centred without a word; others were meant to be elsewhere.
void warn_of_moves(const Box<Vec3>& box, const Box<Vec2>& area, const std::string& name, bool centred,
                   const Progress& progress) {
  if (std::abs(box.min.z) > 0.01)
    progress.warn(fmt::format("{}: the parts were {:.2f} mm {} the bed; moved to stand on it", name,
                              std::abs(box.min.z), box.min.z < 0 ? "below" : "above"));
  const Vec2 room = area.size();
  const bool off_bed =
      apart(box.min.x, box.max.x, std::min(area.min.x, -room.x / 2), std::max(area.max.x, room.x / 2)) ||
      apart(box.min.y, box.max.y, std::min(area.min.y, -room.y / 2), std::max(area.max.y, room.y / 2));
  if (centred && off_bed)
    progress.warn(fmt::format("{}: the parts were outside the bed, around X {:.1f}, Y {:.1f}; moved to its middle",
                              name, box.center().x, box.center().y));
}

}  // namespace

void place(std::span<Part> parts, const Config& config, const Placement& placement, const Progress& progress) {
  assert(std::all_of(parts.begin(), parts.end(), [&](const Part& part) {
    return part.extruder && *part.extruder >= 0 && std::size_t(*part.extruder) < config.extruders.size();
  }));
  if (!(placement.scale > 0) || !std::isfinite(placement.scale) || !std::isfinite(placement.rotate_deg))
    throw Error(fmt::format("--scale {} and --rotate {}: the scale must be above 0, the angle a number",
                            placement.scale, placement.rotate_deg));
  if (parts.empty()) return;

  turn_and_scale(parts, placement.rotate_deg, placement.scale);
  const std::set<int> extruders = extruders_of(parts);
  Polygons common = reach(config, *extruders.begin());
  for (const int e : extruders) common = intersection(common, reach(config, e));
  if (common.empty())
    throw Error(
        fmt::format("the extruders {} reach no common area of the bed; check extruder_printable_area in the "
                    "printer profile",
                    listed(extruders)));
  const Box<Vec2> area = bounds_mm(common);
  const Box<Vec3> box = common_box(parts);
  require_size(box, config, parts);

  const bool centred = !placement.keep && !placement.center_mm;
  warn_of_moves(box, area, parts.front().name, centred, progress);
  const Vec2 target = placement.center_mm.value_or(area.center());
  const Vec2 shift = placement.keep ? Vec2{} : target - Vec2{box.center().x, box.center().y};
  move(parts, {shift.x, shift.y, -box.min.z});
  require_reach(parts, config);
}

}  // namespace cleancolor
