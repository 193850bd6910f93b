// reader/interpreter.hpp
//
// Interpreter: the printer's state while a file is read, line by line.
#pragma once

#include <array>
#include <map>
#include <string>

#include "reader/dialect.hpp"
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

 private:
  struct Axis {
    double at_mm = 0;      // where it physically is
    double origin_mm = 0;  // physical = origin + what the file says
    bool known = false;
  };

  void command_g(const GcodeLine& line);
  void command_m(const GcodeLine& line);
  void command_in_words(const GcodeLine& line);
  void straight(const GcodeLine& line);
  void arc(const GcodeLine& line);
  void set_position(const GcodeLine& line);
  void home(const GcodeLine& line);
  void firmware_retraction(bool back);
  void select(int tool, bool bare, bool per_tool_counts);
  void temperature(const GcodeLine& line, bool waits);
  void limits(const GcodeLine& line, GcodeEvent::Kind kind);
  void accelerations(const GcodeLine& line);

  double target_mm(const GcodeLine& line, char letter, int axis) const;
  /// Filament of this line, mm; the tool that it belongs to goes to feeds.
  double filament_mm(const GcodeLine& line, int& feeds);
  double to_filament_mm(double e, int tool) const;
  void move_to(Vec3 to, double filament, int feeds, bool is_arc);
  void event(GcodeEvent event);
  void unknown(const GcodeLine& line);
  int checked_tool(double number) const;
  [[noreturn]] void fail(const std::string& what) const;

  GcodePrint& print_;
  CommentReader comments_;
  std::array<Axis, 3> axes_;
  std::array<double, max_tools> count_mm_{};  // E of each tool as the firmware counts it, in the file's unit
  std::uint32_t offset_ = 0;
  double unit_mm_ = 1;
  bool relative_ = false, relative_e_ = false, e_mode_told_ = false;
  bool counts_per_tool_ = false;
  bool z_known_ = false;
  int tool_ = 0;
  double feed_mm_s_ = 25, speed_factor_ = 1;
  double acceleration_print_ = 0, acceleration_travel_ = 0;
  double retract_mm_ = 1, recover_extra_mm_ = 0;
  std::array<bool, max_tools> drawn_back_{};
  bool volumetric_ = false;
  std::array<double, max_tools> filament_area_mm2_{};
  std::map<std::string, UnknownCommand, std::less<>> unknown_;
};

}  // namespace cleancolor
