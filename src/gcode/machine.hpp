// gcode/machine.hpp
//
// Machine: the printer as the file so far leaves it, and the words that bring it elsewhere.
//
//   where to, how much  ->  one or a few lines of G-code, and moves for the clock
//
// Knows the position, the tool, how far each filament is drawn back, the E counts, speed, fan and acceleration, and
// writes only what changes. Coordinates are whole micrometres and E whole 1e-5 mm from here on; what rounding takes
// from one segment it gives to the next, so amounts do not drift.
//
// Nozzles: a point given here is where the plastic lies. Where the slicer makes up for the offsets, X Y = point -
// nozzle_offset; where the firmware does, X Y = point. A tool change moves no carriage (gcode/flavour.hpp).
//
// The user's code and tool changes may leave the carriage anywhere: afterwards X, Y, Z and speed are told anew, and
// whether coordinates and E are absolute where the code speaks of it (in Marlin G90 and G91 are about E, too).
//
// Guarantees: nothing is extruded while the filament is drawn back, the nozzle lifted or its place or height unknown; a
// filament drawn back is never drawn back by more than asked, and comes forward by exactly what it went back (plus the
// extra asked for).
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "gcode/clock.hpp"
#include "gcode/flavour.hpp"
#include "gcode/text.hpp"
#include "model/config.hpp"

namespace cleancolor {

class Machine {
 public:
  Machine(const Config& config, Text& text, Clock& clock);

  int tool() const { return tool_; }
  Vec2 position_mm() const;  // of the nozzle in use
  bool position_known() const { return known_; }
  double z_mm() const { return double(z_um_) / 1000; }

  /// Drives straight to a point without extruding.
  void travel(Vec2 to_mm);

  /// The nozzle's height while it prints; where it is lifted it stays so much above.
  void set_z(double print_z_mm);
  void lift(double by_mm);
  void lower();  // to where it prints, from wherever the user's code may have left it

  /// Draws the filament back by length_mm in all; restart_extra_mm comes on top when it is pushed forward again.
  void retract(double length_mm, double restart_extra_mm);
  void unretract();

  struct Feed {
    double speed_mm_s;       // of the carriage
    double filament_per_mm;  // mm of filament for one of path
  };
  /// Requires: travelled and lowered since the last code of the user's; not retracted.
  void extrude(Vec2 to_mm, const Feed& feed);

  /// Makes the tool active: the user's code for the change, and the firmware's word unless the code has it already.
  void select(int tool, std::string_view code, bool word_in_code);

  /// M82 or M83, and counts from 0.
  void start_counting();
  /// Sets the count back before it grows too long for 32-bit firmware; harmless at any time.
  void shorten_count();

  void set_fan(double share);
  /// Of printing moves; 0: left as it is. Before the first, that of travel is told (gcode/flavour.hpp).
  void set_acceleration(double mm_s2);
  void set_nozzle(int tool, int temperature_c, bool wait);
  void set_bed(int temperature_c, bool wait);

  /// G-code of the user.
  void custom(std::string_view gcode);

  /// Pushed through the nozzle so far, mm; what is drawn back and comes forward again does not count.
  double filament_mm(int tool) const;

 private:
  struct Filament {
    double asked_mm = 0;            // extruded by segments, exact
    std::int64_t written_e5 = 0;    // the same as written
    std::int64_t extra_e5 = 0;      // pushed in addition after retractions
    std::int64_t retracted_e5 = 0;  // drawn back now
    std::int64_t restart_extra_e5 = 0;
    std::int64_t count_e5 = 0;  // the firmware's count
  };
  struct Grid {
    std::int64_t x = 0, y = 0;  // um, as in the file
  };

  Filament& filament() { return filaments_[std::size_t(tool_)]; }
  const Extruder& extruder() const { return config_.extruders[std::size_t(tool_)]; }
  std::int64_t counted(std::int64_t delta_e5);
  Grid on_grid(Vec2 p_mm) const;
  char* put_xy(char* p, Grid to);
  char* put_feed(char* p, double speed_mm_s);
  void move_z(std::int64_t to_um);
  void move_filament(std::int64_t delta_e5, double speed_mm_s);
  double travel_acceleration_mm_s2() const;
  void zero_count();
  void tell_distances();
  void put_custom(std::string_view gcode);
  void clear_position() { known_ = z_known_ = false, feed_ = -1; }

  const Config& config_;
  const FlavourWords& words_;
  Text& text_;
  Clock& clock_;
  bool relative_e_;
  bool absolute_in_common_;  // one absolute count that G92 sets back
  bool counting_ = false;    // start_counting() was called
  char e_axis_ = 'E';
  int tool_ = 0;
  Vec2 shift_mm_;  // subtracted from points
  Grid at_;
  std::int64_t z_um_ = 0;  // without lift
  std::int64_t lift_um_ = 0;
  std::int64_t told_z_um_ = 0;  // where the firmware is
  bool known_ = false;          // at_ is where the firmware is, too
  bool z_known_ = false;
  std::int64_t feed_ = -1;         // 1e-3 mm/min
  int fan_ = -1;                   // 0..255
  double acceleration_mm_s2_ = 0;  // as last told; 0: the firmware's own
  std::vector<Filament> filaments_;
};

}  // namespace cleancolor
