// audit/timeline.hpp
//
// Timeline: the way of the carriage through the whole print, and how long each piece of it takes.
//
//   print, machine  ->  duration of every move; drives of any range of moves
//
// A drive is a straight piece of the carriage's way, or a time in which it stands. Tool changes add drives of their own
// where the firmware jumps: with offsets in the firmware, a bare T on Marlin moves the carriage by old - new offset at
// once; elsewhere the carriage stays, and the next move along X or Y starts from where it is.
//
// Laid is plastic that is pushed beyond what an unretraction gives back, along X or Y. Less than 0.0001 mm of filament
// beyond is rounding of the file.
#pragma once

#include <cstdint>
#include <vector>

#include "audit/machine.hpp"
#include "reader/print.hpp"

namespace cleancolor {

struct Drive {
  static constexpr std::uint32_t no_event = ~std::uint32_t(0);

  Vec2 from_mm, to_mm;  // of the carriage
  double z_mm = 0;      // of the nozzle in use, at the lower of both ends
  double duration_s = 0;
  double pushed_mm3 = 0;           // plastic that leaves the nozzle; 0 for travel, retraction and unretraction
  double filament_mm = 0;          // as in the file: also retraction (< 0) and unretraction
  std::uint32_t move = 0;          // index into GcodePrint::moves; of an event: the move after it
  std::uint32_t event = no_event;  // a jump, a dwell or a heater's target, which lasts 0 s here
  std::uint32_t layer = 0;
  std::uint8_t tool = 0;   // in use
  std::uint8_t feeds = 0;  // whose filament moves
  Role role = Role::unknown;
  bool lays = false;  // plastic along a way: `feeds` prints, all others idle
  bool known = true;  // false: where it starts is not known; it has no length and takes no time

  bool moves_xy() const { return from_mm != to_mm; }
  bool extrudes() const { return pushed_mm3 > 0; }
};

struct Timeline {
  std::vector<float> duration_s;   // of each move
  std::vector<float> pushed_mm3;   // of each move: what leaves the nozzle, unretraction deducted
  std::vector<Vec2> carriage_mm;   // after each move
  std::vector<float> jump_s;       // of each event; 0 where it moves nothing
  double print_time_s = 0;         // with dwells, without waiting for heaters
  double travel_mm = 0;            // of the carriage along X and Y, without laying plastic
  std::vector<std::uint8_t> used;  // by nozzle of the machine: 1 where it lays plastic
};

/// Trapezoids with junction speeds (base/motion.hpp), with the limits of the machine until the file sets others (M201,
/// M203, M205); accelerations of M204 hold as well. Asked speeds above the limits are clamped, so are those below
/// 0.05 mm/s. The carriage comes to rest at tool changes, dwells and waits, and where its position is not known.
/// Cost: about 100 ns a move.
Timeline timeline(const GcodePrint& print, const AuditMachine& machine);

/// The drives of moves [first, last), with the events before each of them, in order.
/// Requires: first <= last <= print.moves.size().  Cost: about 20 ns a move.
std::vector<Drive> drives(const GcodePrint& print, const AuditMachine& machine, const Timeline& time,
                          std::uint32_t first, std::uint32_t last);

/// Where nozzle `nozzle` is, seen from nozzle 0; a tool beyond the machine's (which prints nothing) counts as nozzle 0.
inline Vec2 nozzle_offset_mm(const AuditMachine& machine, int nozzle) {
  return std::size_t(nozzle) < machine.nozzles.size() ? machine.nozzles[std::size_t(nozzle)].offset_mm : Vec2{};
}

/// The cross-section of the nozzle's filament.
double filament_area_mm2(const AuditMachine& machine, int nozzle);

}  // namespace cleancolor
