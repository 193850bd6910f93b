#include "gcode/machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace cleancolor {
namespace {

std::int64_t to_e5(double mm) {
  return std::llround(mm * 1e5);
}
std::int64_t to_um(double mm) {
  return std::llround(mm * 1e3);
}

}  // namespace

Machine::Machine(const Config& config, Text& text, Clock& clock)
    : config_(config),
      words_(words(config.gcode_flavor)),
      text_(text),
      clock_(clock),
      relative_e_(config.use_relative_e_distances && !words_.e_per_tool),
      absolute_in_common_(!relative_e_ && !words_.e_per_tool),
      filaments_(config.extruders.size()) {}

Vec2 Machine::position_mm() const {
  return Vec2{double(at_.x) / 1000, double(at_.y) / 1000} + shift_mm_;
}

Machine::Grid Machine::on_grid(Vec2 p_mm) const {
  const Vec2 g = p_mm - shift_mm_;
  return {to_um(g.x), to_um(g.y)};
}

char* Machine::put_xy(char* p, Grid to) {
  if (to.x != at_.x || !known_) {
    *p++ = ' ', *p++ = 'X';
    p = put_fixed<3>(p, to.x);
  }
  if (to.y != at_.y || !known_) {
    *p++ = ' ', *p++ = 'Y';
    p = put_fixed<3>(p, to.y);
  }
  return p;
}

char* Machine::put_feed(char* p, double speed_mm_s) {
  const std::int64_t feed = std::max<std::int64_t>(1, std::llround(speed_mm_s * 60e3));
  if (feed == feed_) return p;
  feed_ = feed;
  *p++ = ' ', *p++ = 'F';
  return put_fixed<3>(p, feed);
}

void Machine::travel(Vec2 to_mm) {
  const Grid to = on_grid(to_mm);
  const double dx = double(to.x - at_.x) / 1000, dy = double(to.y - at_.y) / 1000;
  if (known_ && dx == 0 && dy == 0) return;
  char* p = text_.room();
  *p++ = 'G', *p++ = '1';
  p = put_xy(p, to);
  p = put_feed(p, config_.travel_speed_mm_s);
  *p++ = '\n';
  text_.advance_to(p);
  clock_.push({{dx, dy, 0, 0}, config_.travel_speed_mm_s, travel_acceleration_mm_s2()});
  at_ = to;
  known_ = true;
}

void Machine::move_z(std::int64_t to_um) {
  if (z_known_ && to_um == told_z_um_) return;
  const double speed = config_.travel_speed_z_mm_s > 0 ? config_.travel_speed_z_mm_s : config_.travel_speed_mm_s;
  char* p = text_.room();
  *p++ = 'G', *p++ = '1', *p++ = ' ', *p++ = 'Z';
  p = put_fixed<3>(p, to_um);
  p = put_feed(p, speed);
  *p++ = '\n';
  text_.advance_to(p);
  clock_.push({{0, 0, double(to_um - told_z_um_) / 1000, 0}, speed, travel_acceleration_mm_s2()});
  told_z_um_ = to_um;
  z_known_ = true;
}

void Machine::set_z(double print_z_mm) {
  z_um_ = to_um(print_z_mm);
  move_z(z_um_ + lift_um_);
}

void Machine::lift(double by_mm) {
  lift_um_ = std::max(lift_um_, to_um(by_mm));
  move_z(z_um_ + lift_um_);
}

void Machine::lower() {
  lift_um_ = 0;
  move_z(z_um_);
}

std::int64_t Machine::counted(std::int64_t delta_e5) {
  if (relative_e_) return delta_e5;
  return filament().count_e5 += delta_e5;
}

void Machine::move_filament(std::int64_t delta_e5, double speed_mm_s) {
  char* p = text_.room();
  *p++ = 'G', *p++ = '1', *p++ = ' ', *p++ = e_axis_;
  p = put_fixed<5>(p, counted(delta_e5));
  p = put_feed(p, speed_mm_s);
  *p++ = '\n';
  text_.advance_to(p);
  clock_.push({{0, 0, 0, double(delta_e5) * 1e-5}, speed_mm_s});
}

void Machine::retract(double length_mm, double restart_extra_mm) {
  Filament& f = filament();
  const std::int64_t back = to_e5(length_mm) - f.retracted_e5;
  if (back <= 0) return;
  move_filament(-back, extruder().retract_speed_mm_s);
  f.retracted_e5 += back;
  f.restart_extra_e5 = to_e5(restart_extra_mm);
}

void Machine::unretract() {
  Filament& f = filament();
  if (f.retracted_e5 == 0) return;
  const Extruder& e = extruder();
  // A negative extra may take away more than was drawn back; nothing is drawn back further here.
  const std::int64_t forward = std::max<std::int64_t>(0, f.retracted_e5 + f.restart_extra_e5);
  if (forward > 0) move_filament(forward, e.deretract_speed_mm_s > 0 ? e.deretract_speed_mm_s : e.retract_speed_mm_s);
  f.extra_e5 += forward - f.retracted_e5;
  f.retracted_e5 = f.restart_extra_e5 = 0;
}

void Machine::extrude(Vec2 to_mm, const Feed& feed) {
  Filament& f = filament();
  assert(f.retracted_e5 == 0 && lift_um_ == 0 && known_ && z_known_);
  const Grid to = on_grid(to_mm);
  const double dx = double(to.x - at_.x) / 1000, dy = double(to.y - at_.y) / 1000;
  f.asked_mm += std::hypot(dx, dy) * feed.filament_per_mm;
  if (dx == 0 && dy == 0) return;
  const std::int64_t delta = to_e5(f.asked_mm) - f.written_e5;
  f.written_e5 += delta;

  char* p = text_.room();
  *p++ = 'G', *p++ = '1';
  p = put_xy(p, to);
  *p++ = ' ', *p++ = e_axis_;
  p = put_fixed<5>(p, counted(delta));
  p = put_feed(p, feed.speed_mm_s);
  *p++ = '\n';
  text_.advance_to(p);
  clock_.push({{dx, dy, 0, double(delta) * 1e-5}, feed.speed_mm_s, acceleration_mm_s2_});
  at_ = to;
}

void Machine::zero_count() {
  text_.line("G92 E0");
  for (Filament& f : filaments_) f.count_e5 = 0;
}

void Machine::start_counting() {
  counting_ = true;
  if (words_.e_per_tool) return;
  tell_distances();
  zero_count();
}

void Machine::tell_distances() {
  text_.line(relative_e_ ? "M83 ; use relative distances for extrusion" : "M82 ; use absolute distances for extrusion");
}

void Machine::shorten_count() {
  constexpr std::int64_t long_count_e5 = 100'000'000;  // 1 m: a float still resolves 1e-4 mm
  if (absolute_in_common_ && filament().count_e5 > long_count_e5) zero_count();
}

void Machine::select(int tool, std::string_view code, bool word_in_code) {
  const bool by_firmware = config_.offsets_in == OffsetsIn::firmware;
  if (counting_ && absolute_in_common_) zero_count();
  put_custom(code);
  if (!word_in_code) {
    const auto word = by_firmware ? words_.tool_change_standing : words_.tool_change;
    text_.line(fmt::format(fmt::runtime(word), fmt::arg("tool", tool)));
  }
  if (counting_ && absolute_in_common_) zero_count();

  const Vec2 offset = config_.extruders[std::size_t(tool)].nozzle_offset_mm;
  const Vec2 before = config_.extruders[std::size_t(tool_)].nozzle_offset_mm;
  if (by_firmware) {
    // The carriage stands still, so the new nozzle is elsewhere.
    at_.x += to_um(offset.x - before.x);
    at_.y += to_um(offset.y - before.y);
  }
  shift_mm_ = by_firmware ? Vec2{} : offset;
  tool_ = tool;
  e_axis_ = words_.e_axes.size() > 1 ? words_.e_axes[std::size_t(tool)] : words_.e_axes[0];
  clear_position();
  if (counting_) fan_ = -1;  // tools may have fans of their own
}

void Machine::set_fan(double share) {
  const int value = int(std::lround(255 * std::clamp(share, 0.0, 1.0)));
  if (value == fan_) return;
  fan_ = value;
  text_.line(value == 0 ? std::string(words_.fan_off)
                        : fmt::format(fmt::runtime(words_.fan_on), fmt::arg("value", value)));
}

void Machine::set_acceleration(double mm_s2) {
  if (mm_s2 <= 0 || mm_s2 == acceleration_mm_s2_ || words_.acceleration.empty()) return;
  const auto tell = [&](std::string_view word, double value) {
    text_.line(fmt::format(fmt::runtime(word), fmt::arg("value", std::lround(value))));
  };
  const double travel = config_.machine_max_acceleration_travel_mm_s2;
  if (acceleration_mm_s2_ == 0 && travel > 0 && !words_.travel_acceleration.empty())
    tell(words_.travel_acceleration, travel);
  acceleration_mm_s2_ = mm_s2;
  tell(words_.acceleration, mm_s2);
}

double Machine::travel_acceleration_mm_s2() const {
  return words_.travel_acceleration.empty() ? acceleration_mm_s2_ : 0;
}

void Machine::set_nozzle(int tool, int temperature_c, bool wait) {
  const auto word = wait ? words_.wait_nozzle : words_.set_nozzle;
  text_.line(fmt::format(fmt::runtime(word), fmt::arg("tool", tool), fmt::arg("value", temperature_c)));
}

void Machine::set_bed(int temperature_c, bool wait) {
  text_.line(fmt::format(fmt::runtime(wait ? words_.wait_bed : words_.set_bed), fmt::arg("value", temperature_c)));
}

void Machine::custom(std::string_view gcode) {
  put_custom(gcode);
  if (!gcode.empty() && counting_ && absolute_in_common_) zero_count();  // whatever it did to the count
}

void Machine::put_custom(std::string_view gcode) {
  if (gcode.empty()) return;
  text_.put(gcode);
  if (gcode.back() != '\n') text_.put("\n");
  clear_position();
  const auto mentions = [&](std::string_view word) {
    const std::string_view code = word.substr(0, word.find(' '));
    return !code.empty() && gcode.find(code) != gcode.npos;
  };
  if (mentions(words_.fan_on) || mentions(words_.fan_off)) fan_ = -1;
  if (mentions(words_.acceleration)) acceleration_mm_s2_ = 0;
  if (counting_ && (mentions("G90") || mentions("G91") || mentions("M82") || mentions("M83"))) {
    text_.line("G90");
    if (!words_.e_per_tool) tell_distances();
  }
}

double Machine::filament_mm(int tool) const {
  const Filament& f = filaments_[std::size_t(tool)];
  return double(f.written_e5 + f.extra_e5) * 1e-5;
}

}  // namespace cleancolor
