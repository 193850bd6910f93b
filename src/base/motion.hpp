// base/motion.hpp
//
// Motion: how long a printer takes for a stream of moves.
//
//   moves, limits  ->  duration of every move, in order
//
// Every move is a trapezoid: it accelerates from its entry speed, cruises at the asked speed where there is room, and
// slows to the entry speed of the next move. The speed at a junction is the highest at which no axis jumps by more than
// its jerk (Marlin's classic rule) and from which the carriage can still stop by the end of all moves known so far.
//
// Moves are looked at in a window: durations come out as soon as `window` newer moves are known, so memory is bounded.
// A window too short to brake in makes the estimate a little long, never short.
//
// Source: Marlin's planner, as documented in its configuration (DEFAULT_ACCELERATION, CLASSIC_JERK).
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace cleancolor {

using Axes = std::array<double, 4>;  // X, Y, Z of the carriage, E of the filament

/// All > 0; jerk may be 0, and infinity means no limit.
struct MotionLimits {
  Axes max_speed_mm_s = {500, 500, 12, 120};
  Axes max_acceleration_mm_s2 = {9000, 9000, 500, 10000};
  Axes max_jerk_mm_s = {10, 10, 0.2, 2.5};
  double extruding_mm_s2 = 1500;   // acceleration along a move with X or Y that feeds filament,
  double travel_mm_s2 = 1500;      // along any other move of the carriage,
  double retracting_mm_s2 = 1500;  // and where only the filament moves
  double final_speed_mm_s = 0.05;  // firmware calls this slow a standstill
};

struct Move {
  Axes delta_mm = {};
  double speed_mm_s = 0;          // of the carriage; of the filament where only that moves
  double acceleration_mm_s2 = 0;  // 0: from the limits for this kind of move; both hold where both are given
};

class MotionTimer {
 public:
  /// duration(seconds) is called once for every move pushed, in order; a move of no length takes 0 s.
  explicit MotionTimer(const MotionLimits& limits, std::function<void(double)> duration, std::size_t window = 512);

  /// Requires: speed_mm_s > 0.  Cost: about 50 ns, amortised.
  void push(const Move& move);

  /// Other limits for the moves pushed from now on.
  void set_limits(const MotionLimits& limits) { limits_ = limits; }

  /// The carriage comes to rest here; all moves pushed so far get their durations.
  void stop();

 private:
  struct Planned {
    Axes direction = {};  // delta / length
    double length_mm = 0;
    double cruise_mm_s = 0;
    double acceleration_mm_s2 = 0;
    double junction_mm_s = 0;      // the highest speed at which the jerk allows to enter
    double entry_mm_s = 0;         // the highest from which there is also room to brake, as far as is known
    std::size_t empty_before = 0;  // moves of no length between the planned one before and this
  };
  Planned planned(const Move& move) const;
  double junction_speed(const Planned& before, const Planned& after) const;
  double start_speed(const Planned& first) const;
  void emit(std::size_t count, double exit_mm_s);

  MotionLimits limits_;
  std::function<void(double)> duration_;
  std::size_t window_;
  std::vector<Planned> moves_;   // not yet timed; at most 2 x window
  std::size_t empty_after_ = 0;  // moves of no length after the last planned one
  double speed_mm_s_ = 0;        // at which moves_.front() is really entered
};

/// Durations of all moves of a list, s.
std::vector<double> durations_s(const std::vector<Move>& moves, const MotionLimits& limits);

}  // namespace cleancolor
