// reader/interpreter.hpp
//
// Interpreter: the printer's state while a file is read, line by line.
//
//   lines in their order  ->  moves, events, unknown commands
#pragma once

#include <array>
#include <limits>
#include <map>
#include <string>

#include "reader/dialect.hpp"
#include "reader/filament.hpp"
#include "reader/line.hpp"
#include "reader/print.hpp"

namespace cleancolor {

class Interpreter {
 public:
  /// Fills the print's moves and events; its facts are read before.
  explicit Interpreter(GcodePrint& print);

  /// Acts on one line; offset: where it begins in the text. Throws Error.
  void run(const GcodeLine& line, std::uint32_t offset);

  /// Moves the unknown commands into the print.
  void finish();

  const FilamentCounts& filament() const { return filament_; }

 private:
  struct Axis {
    double at_mm = 0;      // where it physically is
    double origin_mm = 0;  // physical = origin + what the file says
    bool known = false;
  };
  /// RepRapFirmware has two targets for each tool: in use, and not. NaN: not told so.
  struct Heater {
    double in_use_c = std::numeric_limits<double>::quiet_NaN();
    double standby_c = std::numeric_limits<double>::quiet_NaN();
    double target_c = 0;
  };
  struct Accelerations {
    double print = 0, travel = 0, retract = 0;
  };

  // interpreter.cpp: moves and where they end
  void command_g(const GcodeLine& line);
  void go(const GcodeLine& line);
  void straight(const GcodeLine& line);
  void arc(const GcodeLine& line);
  void set_position(const GcodeLine& line);
  void forget_position(const GcodeLine& line);
  void firmware_retraction(bool back);
  void dwell(const GcodeLine& line);
  void require_numbers(const GcodeLine& line) const;
  void set_speed(const GcodeLine& line);
  double target_mm(const GcodeLine& line, int axis) const;
  void arrive(const GcodeLine& line);
  /// Filament that the line moves, and of which tool; of two tools only the second one's is left to be moved.
  double filament_mm(const GcodeLine& line, int& feeds);
  void move_to(Vec3 to, double filament, int feeds, bool is_arc = false);

  // interpreter_events.cpp: tools, temperatures, limits
  void command_m(const GcodeLine& line);
  void command_in_words(const GcodeLine& line);
  void tool_word(const GcodeLine& line);
  void select(int tool, bool bare);
  void temperature(const GcodeLine& line, bool waits);
  void two_temperatures(const GcodeLine& line);
  void heat(int tool, double target_c, bool waits);
  void wait_for_heaters(const GcodeLine& line);
  void limits(const GcodeLine& line, GcodeEvent::Kind kind);
  void accelerations(const GcodeLine& line);
  void volumetric(const GcodeLine& line);
  void firmware_offset(const GcodeLine& line);
  void velocity_limit(const GcodeLine& line);
  void event(GcodeEvent event);

  void unknown(const GcodeLine& line);
  int checked_tool(double number) const;
  bool on_last_line() const;
  [[noreturn]] void fail(const std::string& what) const;

  GcodePrint& print_;
  CommentReader comments_;
  std::uint32_t offset_ = 0;

  std::array<Axis, 3> axes_;
  bool end_known_ = false;  // the nozzle is in X and Y where the last move ended, and that is known
  double unit_mm_ = 1;
  bool relative_ = false;
  bool absolute_centers_ = false;
  int plane_ = 17;
  int motion_ = -1;  // G0 ... G3 for lines that go on with it

  FilamentCounts filament_;
  int tool_ = 0;
  std::array<Heater, max_tools> heaters_{};
  double speed_mm_s_ = 0, speed_factor_ = 1;
  Accelerations acceleration_;
  std::map<std::string, UnknownCommand, std::less<>> unknown_;
};

}  // namespace cleancolor
