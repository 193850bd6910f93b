// plan/exposure_order.hpp
//
// Exposure order: the order of one extruder's paths in a layer that lets idle nozzles smear least, by forecast.
//
//   paths in an allowed order, each begun somewhere  ->  the same in a better order
//
// A search by small steps: a path is moved to another place in the order, or an open one turned round, where what must
// come before stays before; better orders are kept, worse ones at first too (simulated annealing, seeded). What counts:
//
//   smear + hole_weight x plastic missing at the start of outer walls, x visibility, + time x s_mm3
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "plan/ooze_forecast.hpp"

namespace cleancolor {

struct OrderWeights {
  double hole_weight = 4;  // mm3 of smear that a missing mm3 is worth
  double s_mm3 = 0.005;    // that a second is worth
  HopTime hop;
};

/// One idle nozzle at the beginning of the run.
struct HangingNozzle {
  int extruder = 0;
  Vec2 offset_mm;  // as seen from the one that prints
  IdleState state;
};

struct ExposureRun {
  std::span<const Path> walls;         // printed first, in this order
  std::span<const Path> paths;         // in an allowed order
  std::uint64_t standing = 0;          // walls of the map that stand before, by bit
  std::uint64_t own_walls = 0;         // and after `walls`
  std::vector<HangingNozzle> hanging;  // at most 8 are looked at
  Vec2 from_mm;                        // where the nozzle is, without walls
  bool external_first = false;

  /// Between islands: how much longer a way is than the straight one, and what it costs beside its length, in seconds;
  /// [row of the island left][of the one entered]. Empty: straight. island_row: of each path.
  struct Detour {
    double factor = 1, extra_s = 0;
  };
  std::vector<std::vector<Detour>> detours;
  std::vector<int> island_row;
  std::uint32_t seed = 0;
  int steps_a_path = 30;
};

struct ExposureOrder {
  std::vector<int> order;  // of ExposureRun::paths
  double smear_mm3 = 0, hole_mm3 = 0, seconds = 0;

  /// Of each path in its place of the order: the idle nozzles when it begins, as in ExposureRun::hanging.
  std::vector<std::vector<IdleState>> at_start;
  std::vector<HangingNozzle> after;  // the idle nozzles at the end
};

/// Cost: steps x paths x some 20 ns, bounded at some 10 ms.  The same for the same input.
ExposureOrder exposure_order(const ExposureRun& run, const LayerMap& map, const OozeModel& model,
                             const OrderWeights& weights);

}  // namespace cleancolor
