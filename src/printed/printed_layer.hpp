// printed/printed_layer.hpp
//
// Printed layer: the paths of one layer as the planner would know them, found again in its G-code.
//
//   moves of a layer  ->  drives of the carriage; runs of them without a stop as paths, in printing order
//
// A run is what one nozzle extrudes without a break: neither travel, nor retraction, nor another nozzle, nor a leap.
// Its roads may change on the way: an inner loop that goes over into an outer wall is one run.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "audit/timeline.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

/// Drives are indices into PrintedLayer::drives.
struct PrintedRun {
  Path path;  // where the plastic lies; closed where its end meets its start; island, depth and travel are left out
  std::size_t way_begin = 0, begin = 0, end = 0;  // [way_begin, begin) go there, [begin, end) print it
};

struct PrintedLayer {
  std::vector<Drive> drives;  // those that move along X or Y from a known place, in order
  std::vector<PrintedRun> runs;
};

/// Requires: layer < print.layers.size().  Cost: one pass over the moves of the print.
PrintedLayer printed_layer(const GcodePrint& print, const AuditMachine& machine, const Timeline& time,
                           std::uint32_t layer);

/// Of the road that the move lays, within what a nozzle can print, whatever the file says.
inline double road_width_mm(const GcodeMove& move) {
  return std::clamp(double(move.width_mm), 0.02, 10.);
}

/// A straight piece of plastic.
struct LaidRoad {
  Vec2 from_mm, to_mm;  // where the plastic lies
  double width_mm = 0;
  int nozzle = 0;
  Role role = Role::unknown;
};

/// The roads of layers [first, last], each in printing order.  Cost: 30 ns a move.
std::vector<std::vector<LaidRoad>> laid_roads(const GcodePrint& print, const AuditMachine& machine,
                                              const Timeline& time, std::uint32_t first, std::uint32_t last);

/// The loops that a run consists of: an inner loop and the outer wall that it goes over into are two paths, the first
/// as Path::inner of the second; any other run is one path. Loops are closed, also where they begin and end beside
/// their start: that is how the planner knew them.
Path taken_apart(const Path& run);

/// The outer wall of a run: all of it, or what follows an inner loop.
struct OuterWall {
  std::size_t first = 0, last = 0;  // segments [first, last); first == last: it has none
};
OuterWall outer_wall(const Path& run);

/// Where it begins and ends; of a run without one the start of the run.
inline Vec2 begin_mm(const Path& run, const OuterWall& wall) {
  return run.points[wall.first];
}
inline Vec2 end_mm(const Path& run, const OuterWall& wall) {
  return run.points[wall.last % run.points.size()];
}

}  // namespace cleancolor
