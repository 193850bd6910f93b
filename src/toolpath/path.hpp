// toolpath/path.hpp
//
// Path: the one vocabulary for what a nozzle does, from the toolpath makers through the planner to the G-code writer.
//
// A Layer is a list of paths in the order in which they are printed. Between two paths the carriage travels: straight,
// or by way of Path::travel. Every stage that reorders, turns round or re-routes works on these structs alone and needs
// to know neither meshes nor G-code.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/polygon.hpp"
#include "base/vec.hpp"

namespace cleancolor {

enum class Role : std::uint8_t {
  external_perimeter,
  perimeter,
  overhang_perimeter,
  internal_infill,
  solid_infill,
  top_solid_infill,
  bridge_infill,
  gap_fill,
  skirt_brim,
  prime,
  rampart,
  // Only in G-code of other slicers.
  ironing,
  support,
  support_interface,
  wipe_tower,
  refill,   // plastic pushed on the way, in the corridor of a rampart
  custom,   // the user's own code
  unknown,  // the file does not say
};
inline constexpr int role_count = 18;

constexpr bool is_wall(Role role) {
  return role == Role::external_perimeter || role == Role::perimeter || role == Role::overhang_perimeter;
}

/// Plastic that is not the part's: it wipes nozzles and fills them, and is thrown away.
constexpr bool is_auxiliary(Role role) {
  switch (role) {
    case Role::skirt_brim:
    case Role::prime:
    case Role::rampart:
    case Role::support:
    case Role::support_interface:
    case Role::wipe_tower:
    case Role::refill:
    case Role::custom:
      return true;
    default:
      return false;
  }
}

/// What is laid down: the cross-section of the plastic and how fast the nozzle goes.
struct Road {
  Role role = Role::perimeter;
  double width_mm = 0;
  double height_mm = 0;
  double area_mm2 = 0;    // plastic per mm of path, extrusion_multiplier not included
  double speed_mm_s = 0;  // of the carriage
};

/// A road that holds from one segment of a path on. Segment i goes from points[i] to points[i + 1].
struct Stretch {
  std::uint32_t first_segment = 0;
  Road road;
};

/// Path::depth of all that is not a perimeter.
inline constexpr int fill_depth = 1000;

/// One continuous extrusion of one nozzle.
///
/// points are in model coordinates (where the plastic lies), mm; a closed path does not repeat its first point.
/// stretches: at least one, ascending, the first from segment 0; a loop that overhangs in places stays one path.
struct Path {
  int extruder = 0;        // 0-based
  int island = 0;          // which connected piece of its extruder's region in this layer; -1: none (skirt, prime)
  int depth = fill_depth;  // of a perimeter: 0 along the outline, 1 the next one inside, ...
  bool closed = false;
  std::vector<Vec2> points;
  std::vector<Stretch> stretches;
  std::vector<Vec2> travel;  // points passed on the way here from the end of the path before, both ends left out
  std::size_t travel_before_change = 0;  // so many of them are passed with the extruder of the path before
  std::vector<Path> inner;  // within the planner: loops printed before this one without a stop (plan/joined_loops.hpp)
  int source = -1;          // by which its maker knows it again, whatever becomes of it; -1: nobody asks
  int inner_source = -1;    // of the inner loop that it was joined with
  std::uint32_t outer_from = 0;  // and the point where the outer one then begins

  const Road& road() const { return stretches.front().road; }
  Vec2 start() const { return points.front(); }
  Vec2 end() const { return closed ? points.front() : points.back(); }
  std::size_t segments() const { return closed ? points.size() : points.size() - 1; }
};

struct Layer {
  int index = 0;
  double print_z_mm = 0;  // the nozzle's height while it prints: the layer's top
  double height_mm = 0;
  std::vector<Path> paths;              // in printing order
  std::vector<double> fan_by_extruder;  // share of full fan speed in [0, 1]; bridges may ask for more (writer)
};

/// Length of the road, mm.
double length_mm(const Path& path);

/// Plastic laid down, mm3, extrusion_multiplier not included.
double volume_mm3(const Path& path);

/// Length of the way from `from` to the path's start, by way of Path::travel.
double travel_mm(Vec2 from, const Path& path);

/// Whether all its points lie inside; the border counts as inside.
bool within(const Path& path, const Polygons& area);

/// The same closed path begun at points[first]; stretches turn with it.  Requires: closed; first < points.size().
Path started_at(Path path, std::size_t first);

/// The same closed path with one more point, on segment `segment`; begun there.
/// Requires: closed; p on or near the segment.
Path started_on(Path path, std::size_t segment, Vec2 p);

/// The same path walked the other way.
Path reversed(Path path);

/// PrusaSlicer's name of the role, as in its ;TYPE: comments.
std::string_view role_name(Role role);

}  // namespace cleancolor
