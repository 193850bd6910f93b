// audit/timeline.hpp
//
// Timeline: the way of the carriage through the whole print, and how long each piece of it takes.
//
//   print, machine  ->  duration of every move; drives of any range of moves
//
// A drive is a straight piece of the carriage's way. Tool changes add drives of their own where the firmware jumps:
// with offsets in the firmware, a bare T on Marlin moves the carriage by old - new offset at once; elsewhere the
// carriage stays, and the next move starts from where it is.
#pragma once

#include <cstdint>
#include <vector>

#include "audit/machine.hpp"
#include "reader/print.hpp"

namespace cleancolor {

struct Drive {
  Vec2 from_mm, to_mm;  // of the carriage
  double z_mm = 0;      // of the nozzle in use, at the end
  double duration_s = 0;
  double pushed_mm3 = 0;   // plastic laid along the way; 0 for travel, retraction and unretraction
  double filament_mm = 0;  // as in the file: also retraction (< 0) and unretraction
  std::uint32_t move = 0;  // index into GcodePrint::moves; of a jump: the move after it
  std::uint32_t layer = 0;
  std::uint8_t tool = 0;
  Role role = Role::unknown;
  bool lays = false;  // plastic along a way: this tool prints, all others idle
  bool known = true;  // false: where it starts is not known; only its duration counts
};

struct Timeline {
  std::vector<float> duration_s;  // of each move
  std::vector<float> pushed_mm3;  // of each move: what leaves the nozzle, unretraction deducted
  std::vector<float> jump_s;      // of each event; 0 where it moves nothing
  double print_time_s = 0;        // with dwells, without waiting for heaters
  double travel_mm = 0;           // of the carriage, without laying plastic
};

/// Trapezoids with junction speeds (base/motion.hpp), limits as the machine has them and as the file sets them (M201,
/// M203, M204, M205); speeds are clamped.  Cost: about 100 ns a move.
Timeline timeline(const GcodePrint& print, const AuditMachine& machine);

/// The drives of moves [first, last), jumps included, in order.
std::vector<Drive> drives(const GcodePrint& print, const AuditMachine& machine, const Timeline& time,
                          std::uint32_t first, std::uint32_t last);

}  // namespace cleancolor
