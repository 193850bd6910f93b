#include "audit/timeline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>

namespace cleancolor {
namespace {

constexpr double slowest_mm_s = 0.05;
constexpr double rounding_mm = 1e-4;  // of filament

/// How far the carriage jumps at a change of tool.
Vec2 jump_mm(const AuditMachine& machine, const GcodeEvent& event, int old_tool) {
  if (event.kind != GcodeEvent::Kind::tool_change || !event.jumps || machine.offsets_in == OffsetsIn::slicer) return {};
  if (event.before_move == 0) return {};  // from where is not known
  return nozzle_offset_mm(machine, old_tool) - nozzle_offset_mm(machine, event.tool);
}

/// Where the carriage is after move i; before: where it was. A move that names neither X nor Y leaves it there, also
/// where a change of tool has given its place another name.
Vec2 carriage_after(const GcodePrint& print, const AuditMachine& machine, std::size_t i, Vec2 before) {
  const GcodeMove& move = print.moves[i];
  if (i > 0 && move.known_start && !move.names_xy) return before;
  const Vec2 at{move.to_mm.x, move.to_mm.y};
  return machine.offsets_in == OffsetsIn::slicer ? at : at - nozzle_offset_mm(machine, move.tool);
}

/// Filament drawn back and not yet given back, by tool.
class Retracted {
 public:
  /// What of the filament leaves the nozzle.
  double pushed_mm(const GcodeMove& move) {
    double& back = back_mm_[move.feeds];
    const double undone = std::clamp(move.filament_mm, 0., back);
    back += std::max(0., -move.filament_mm) - undone;
    const double pushed = move.filament_mm - undone;
    return pushed > rounding_mm || (undone == 0 && pushed > 0) ? pushed : 0;
  }

 private:
  std::array<double, 256> back_mm_ = {};
};

/// Durations come out of the timer late: this knows whose is next.
class Clock {
 public:
  Clock(const MotionLimits& limits, Timeline& time)
      : time_(time), limits_(limits), timer_(limits, [this](double s) { done(s); }) {}
  Clock(const Clock&) = delete;  // the timer calls back
  Clock& operator=(const Clock&) = delete;

  void move(const Move& move) { timer_.push(move); }
  void jump(const Move& move, std::size_t event, std::size_t before_move) {
    jumps_.push_back({event, before_move});
    timer_.push(move);
  }
  void stop() { timer_.stop(); }
  void limit(const GcodeEvent& event);
  const MotionLimits& limits() const { return limits_; }

 private:
  struct Jump {
    std::size_t event, before_move;
  };
  void done(double s) {
    time_.print_time_s += s;
    if (!jumps_.empty() && jumps_.front().before_move <= next_move_) {
      time_.jump_s[jumps_.front().event] = float(s);
      jumps_.pop_front();
    } else {
      time_.duration_s[next_move_++] = float(s);
    }
  }

  Timeline& time_;
  MotionLimits limits_;
  MotionTimer timer_;
  std::size_t next_move_ = 0;
  std::deque<Jump> jumps_;
};

void Clock::limit(const GcodeEvent& event) {
  const std::size_t axis = event.axis;
  if (axis > 3 || !(event.value > 0)) return;
  switch (event.kind) {
    case GcodeEvent::Kind::max_speed:
      limits_.max_speed_mm_s[axis] = event.value;
      break;
    case GcodeEvent::Kind::max_acceleration:
      limits_.max_acceleration_mm_s2[axis] = event.value;
      break;
    case GcodeEvent::Kind::max_jerk:
      limits_.max_jerk_mm_s[axis] = event.value;
      break;
    default:
      return;
  }
  timer_.set_limits(limits_);
}

/// Goes through the print once.
class Walk {
 public:
  Walk(const GcodePrint& print, const AuditMachine& machine, Timeline& time)
      : print_(print), machine_(machine), time_(time), clock_(machine.limits, time) {}

  void move(std::size_t i);
  void event(std::size_t e);
  void stop() { clock_.stop(); }

 private:
  const GcodePrint& print_;
  const AuditMachine& machine_;
  Timeline& time_;
  Clock clock_;
  Retracted retracted_;
  Vec2 carriage_mm_;
  double z_mm_ = 0;
  int tool_ = 0;
};

void Walk::move(std::size_t i) {
  const GcodeMove& m = print_.moves[i];
  const Vec2 to = carriage_after(print_, machine_, i, carriage_mm_);
  const bool known = i > 0 && m.known_start;
  const Vec2 d = known ? to - carriage_mm_ : Vec2{};
  const double pushed_mm3 = retracted_.pushed_mm(m) * filament_area_mm2(machine_, m.feeds);
  if (known) {
    const double speed = m.speed_mm_s > 0 ? double(m.speed_mm_s) : clock_.limits().max_speed_mm_s[0];
    clock_.move({{d.x, d.y, m.to_mm.z - z_mm_, m.filament_mm},
                 std::max(speed, slowest_mm_s),
                 std::max(0., double(m.acceleration_mm_s2))});
  } else {
    clock_.stop();
    clock_.move({{}, 1, 0});
  }
  const bool lays = pushed_mm3 > 0 && d != Vec2{};
  if (!lays) time_.travel_mm += length(d);
  if (lays && m.feeds < time_.used.size()) time_.used[m.feeds] = 1;
  time_.pushed_mm3[i] = float(pushed_mm3);
  time_.carriage_mm[i] = carriage_mm_ = to;
  z_mm_ = m.to_mm.z;
  tool_ = m.tool;
}

void Walk::event(std::size_t e) {
  const GcodeEvent& event = print_.events[e];
  switch (event.kind) {
    case GcodeEvent::Kind::tool_change: {
      clock_.stop();
      const Vec2 d = jump_mm(machine_, event, tool_);
      tool_ = event.tool;
      if (d == Vec2{}) break;
      clock_.jump({{d.x, d.y, 0, 0}, clock_.limits().max_speed_mm_s[0], 0}, e, event.before_move);
      carriage_mm_ = carriage_mm_ + d;
      time_.travel_mm += length(d);
      break;
    }
    case GcodeEvent::Kind::dwell:
      clock_.stop();
      time_.print_time_s += event.value;
      break;
    case GcodeEvent::Kind::target_temperature:
      if (event.waits) clock_.stop();
      break;
    default:
      clock_.limit(event);
  }
}

/// What all drives of one moment have in common.
struct Moment {
  Vec2 carriage_mm;
  double z_mm = 0;
  int tool = 0;
};

/// The drive of an event; nothing where the audit has no use for it. Moves the carriage where it jumps.
bool drive_of_event(const GcodePrint& print, const AuditMachine& machine, const Timeline& time, std::size_t e,
                    Moment& now, Drive& d) {
  const GcodeEvent& event = print.events[e];
  const int old_tool = now.tool;
  if (event.kind == GcodeEvent::Kind::tool_change) now.tool = event.tool;
  const Vec2 jump = jump_mm(machine, event, old_tool);
  const bool stands = event.kind == GcodeEvent::Kind::dwell || event.kind == GcodeEvent::Kind::target_temperature;
  if (!stands && jump == Vec2{}) return false;
  d = {};
  d.from_mm = now.carriage_mm;
  d.to_mm = now.carriage_mm = now.carriage_mm + jump;
  d.z_mm = now.z_mm;
  d.duration_s = event.kind == GcodeEvent::Kind::dwell ? event.value : double(time.jump_s[e]);
  d.move = event.before_move;
  d.event = std::uint32_t(e);
  d.layer = print.moves[event.before_move].layer;
  d.tool = d.feeds = std::uint8_t(now.tool);
  return true;
}

}  // namespace

double filament_area_mm2(const AuditMachine& machine, int nozzle) {
  const double d =
      std::size_t(nozzle) < machine.nozzles.size() ? machine.nozzles[std::size_t(nozzle)].filament_diameter_mm : 1.75;
  return std::numbers::pi / 4 * d * d;
}

Timeline timeline(const GcodePrint& print, const AuditMachine& machine) {
  Timeline time;
  time.duration_s.resize(print.moves.size());
  time.pushed_mm3.resize(print.moves.size());
  time.carriage_mm.resize(print.moves.size());
  time.jump_s.resize(print.events.size());
  time.used.resize(machine.nozzles.size());
  Walk walk(print, machine, time);
  std::size_t e = 0;
  for (std::size_t i = 0; i < print.moves.size(); ++i) {
    for (; e < print.events.size() && print.events[e].before_move <= i; ++e) walk.event(e);
    walk.move(i);
  }
  for (; e < print.events.size(); ++e) walk.event(e);
  walk.stop();
  return time;
}

std::vector<Drive> drives(const GcodePrint& print, const AuditMachine& machine, const Timeline& time,
                          std::uint32_t first, std::uint32_t last) {
  std::vector<Drive> all;
  all.reserve(last - first + 16);
  auto e =
      std::size_t(std::ranges::lower_bound(print.events, first, {}, &GcodeEvent::before_move) - print.events.begin());
  Moment now;
  if (first > 0) {
    const GcodeMove& before = print.moves[first - 1];
    now = {time.carriage_mm[first - 1], before.to_mm.z, before.tool};
  } else if (!time.carriage_mm.empty()) {
    now.carriage_mm = time.carriage_mm.front();
  }
  Drive d;
  for (std::uint32_t i = first; i < last; ++i) {
    for (; e < print.events.size() && print.events[e].before_move <= i; ++e)
      if (drive_of_event(print, machine, time, e, now, d)) all.push_back(d);
    const GcodeMove& m = print.moves[i];
    const bool known = i > 0 && m.known_start;
    d = {};
    d.to_mm = time.carriage_mm[i];
    d.from_mm = known ? now.carriage_mm : d.to_mm;
    d.z_mm = known ? std::min(now.z_mm, m.to_mm.z) : m.to_mm.z;
    d.duration_s = double(time.duration_s[i]);
    d.pushed_mm3 = double(time.pushed_mm3[i]);
    d.filament_mm = m.filament_mm;
    d.move = i;
    d.layer = m.layer;
    d.tool = m.tool;
    d.feeds = m.feeds;
    d.role = m.role;
    d.lays = d.pushed_mm3 > 0 && d.moves_xy();
    d.known = known;
    all.push_back(d);
    now = {d.to_mm, m.to_mm.z, m.tool};
  }
  return all;
}

}  // namespace cleancolor
