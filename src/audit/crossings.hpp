// audit/crossings.hpp
//
// Crossings: what the tips of idle nozzles pass over, drive by drive.
//
//   plastic of a layer, drives in it  ->  pieces of the way of every idle nozzle: over what, and how visible it is
//
// Nothing here depends on how much the nozzles ooze, so layers are looked at side by side; replay.hpp then goes through
// the print once, in the order of time.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "audit/exposed.hpp"
#include "audit/surface.hpp"
#include "audit/timeline.hpp"
#include "audit/visibility.hpp"

namespace cleancolor {

/// The plastic of one layer as tips find it.
struct LayerPlastic {
  LayerSurface surface;
  std::vector<std::uint8_t> outer;  // of each laying drive of the layer, in their order: 1 on an outer wall
  double z_mm = 0;
};

/// Which moves belong to which layer.
struct LayerMoves {
  struct Range {
    std::uint32_t first = 0, last = 0;
  };
  std::vector<std::vector<Range>> ranges;  // by layer, ascending
  std::vector<std::uint32_t> above;        // the next layer of the part above one of it; else as many as layers
};
LayerMoves layer_moves(const GcodePrint& print, const Timeline& time);

/// The roads of a layer where their plastic lies, in the order of the drives that lay them. A width that nobody tells
/// follows from the amount.
struct LayerRoads {
  std::vector<LabelledRoad> roads;
  std::vector<std::uint32_t> moves;   // of each
  std::vector<std::uint8_t> nozzles;  // that lays it
};
LayerRoads layer_roads(const GcodePrint& print, const AuditMachine& machine, const Timeline& time,
                       std::span<const LayerMoves::Range> ranges);

/// above: the roads of the next layer of the part, empty for the last.
LayerPlastic layer_plastic(const LayerRoads& layer, const LayerRoads& above, double z_mm, ExposedBy by);

/// A piece of the way of a tip.
struct Crossing {
  enum class Over : std::uint8_t { auxiliary, visible, inner };
  float begin = 0, end = 0;  // shares of the drive
  float visibility = 0;      // of what is visible, in the middle of the piece
  std::uint8_t nozzle = 0;   // whose tip
  std::uint8_t over = 0;     // whose plastic
  Over what = Over::inner;
  bool printed = false;  // the plastic is there already
};

/// Drives in the order of time with their crossings.
struct Crossings {
  std::vector<Drive> drives;
  std::vector<Crossing> all;         // by drive, then by nozzle, then along the way; pieces of a tip do not overlap
  std::vector<std::uint32_t> first;  // of each drive, and the end
  bool cut_short = false;            // some drives at the end were left out, because too much lies on their way

  std::span<const Crossing> of(std::size_t drive) const {
    return std::span(all).subspan(first[drive], first[drive + 1] - first[drive]);
  }
};

/// What crossings are found from.
struct CrossingInput {
  const GcodePrint& print;
  const AuditMachine& machine;
  const Timeline& time;
  const PrintedVisibility& visibility;
  std::span<const std::shared_ptr<const LayerPlastic>> plastic;  // by layer; those of the moves are there
  double step_mm = 0.5;                                          // pieces over visible plastic are no longer
};

/// The crossings of some moves.
///
/// While a nozzle extrudes, all others are idle; else all are. On machines that lift, park or dock their idle nozzles
/// only the one in use touches anything. Nozzles that print nothing are left out.
/// Hostile prints: after about 2000 roads a move, the rest is left out (cut_short).
/// Cost: about 1 us a move of a usual print.
Crossings crossings(const CrossingInput& input, LayerMoves::Range moves);

}  // namespace cleancolor
