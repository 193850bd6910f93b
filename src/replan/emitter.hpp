// replan/emitter.hpp
//
// Emitter: the text as it grows again, and the printer as the text so far leaves it.
//
// Knows place, height, tool, E, speed, how far each filament is drawn back, and what modal lines said; it writes only
// what changes. Guarantees: nothing is extruded while filament is drawn back; what is drawn back comes forward again by
// as much.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/config.hpp"
#include "replan/dialect_words.hpp"
#include "replan/recovered.hpp"

namespace cleancolor {

class Emitter {
 public:
  /// What stands before the layers, with our line behind the first one, and the printer as it leaves it.
  /// header: our line, without its end.  Requires: the dialect is known (words_of).
  Emitter(const RecoveredPrint& recovered, const GcodePrint& print, const Config& config, const std::string& header);

  int tool() const { return tool_; }
  bool is_known() const { return known_; }
  bool is_lifted() const { return lift_um_ > 0 || rises_by_um_ > 0; }
  FilePoint at() const { return at_; }

  void line(std::string_view text);
  void lines(std::span<const std::string> all);
  void set(const ModalState& to);
  void set_known(std::uint32_t state);  // index into RecoveredPrint::states
  void forget(std::string_view key);    // it is told anew

  void begin_layer(std::span<const std::string> header);
  void end_layer();

  void travel(FilePoint to);
  void travel(FilePoint to, std::int64_t z_um);
  void set_z(double z_mm);                         // of printing
  void take_z(double z_mm);                        // likewise, where the way there says it
  void lift(double by_mm);                         // on the way where the file does so, else at once
  void rises_over(double way_um);                  // the whole of what follows: the lift ends with it at the latest
  void rise(std::span<const std::string> spiral);  // lines of the file
  void lower();
  void draw_back(std::int64_t to_e5);         // by so much in all
  void push_forward(std::int64_t to_e5 = 0);  // until so much is still drawn back
  void feed(std::int64_t by_e5);              // < 0: drawn back
  void take_drawn_back(std::int64_t e5) { back_e5() = e5; }
  void road(FilePoint to, std::int64_t filament_e5, double feed_mm_min, const std::optional<RoadArc>& arc = {});

  /// The lines of the file; afterwards the place is told anew.
  void change_tool(int tool);

  /// The lines as they are; afterwards the place is told anew.  Requires: the tool that the lines begin with is in use.
  void fixed(const FixedLines& lines);

  /// Drawing back on the way.
  void wipe(std::span<const WipeMove> moves);
  std::int64_t drawn_back_e5() const { return drawn_back_e5_[std::size_t(tool_)]; }

  /// With the rest of the file, and all as it takes it for given.
  std::string finish();

 private:
  void header(std::span<const std::string> all);  // may be modal ones: the state follows
  void forget_tool();                             // what holds for a tool alone is told anew for the next
  void put_feed(double feed_mm_min);
  void put_e(std::int64_t delta_e5);
  void end_line() { text_ += '\n'; }
  void zero_count();
  void move_z(std::int64_t to_um);
  void put_place(FilePoint to);
  void rise_at_once();
  void rise_on_the_way(FilePoint to);
  void change_tool(int tool, std::span<const std::string> leave, std::span<const std::string> enter);
  std::int64_t& count_e5() { return count_e5_[recovered_.e_of_each_tool ? std::size_t(tool_) : 0]; }
  std::int64_t& back_e5() { return drawn_back_e5_[std::size_t(tool_)]; }
  const Extruder& extruder() const { return config_.extruders[std::size_t(tool_)]; }

  const RecoveredPrint& recovered_;
  const GcodePrint& print_;
  const DialectWords& words_;
  const Config& config_;
  std::string text_;
  ModalState state_;
  std::optional<std::uint32_t> known_state_;  // that the text is left in
  int tool_ = 0;
  std::size_t layers_ = 0;  // begun
  bool known_ = false, z_known_ = false;
  FilePoint at_;
  std::int64_t z_um_ = 0, told_z_um_ = 0, lift_um_ = 0;
  std::int64_t rises_by_um_ = 0;  // on the next way,
  double rise_slope_ = 0;         // so steeply
  std::vector<std::int64_t> count_e5_;
  std::int64_t feed_ = -1;  // 1e-3 mm/min
  std::vector<std::int64_t> drawn_back_e5_;
};

}  // namespace cleancolor
