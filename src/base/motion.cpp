#include "base/motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace cleancolor {
namespace {

constexpr double nothing_mm = 1e-9;

/// Time over a length entered at v0 and left at v1, cruising at v at most.
double trapezoid_s(double length, double v0, double v, double v1, double acceleration) {
  const double peak = std::sqrt((2 * acceleration * length + v0 * v0 + v1 * v1) / 2);
  if (peak <= v) return (peak - v0 + peak - v1) / acceleration;
  const double ramps_mm = (v * v - v0 * v0 + v * v - v1 * v1) / (2 * acceleration);
  return (v - v0 + v - v1) / acceleration + (length - ramps_mm) / v;
}

}  // namespace

MotionTimer::MotionTimer(const MotionLimits& limits, std::function<void(double)> duration, std::size_t window)
    : limits_(limits), duration_(std::move(duration)), window_(window) {
  assert(window_ > 0);
  assert(limits.extruding_mm_s2 > 0 && limits.travel_mm_s2 > 0 && limits.retracting_mm_s2 > 0);
  moves_.reserve(2 * window_);
}

double MotionTimer::junction_speed(const Planned& before, const Planned& after) const {
  const double speed = std::min(before.cruise_mm_s, after.cruise_mm_s);
  double share = 1;
  for (std::size_t k = 0; k < 4; ++k) {
    const double jump = std::abs(after.direction[k] - before.direction[k]) * speed;
    if (jump > limits_.max_jerk_mm_s[k]) share = std::min(share, limits_.max_jerk_mm_s[k] / jump);
  }
  return speed * share;
}

double MotionTimer::start_speed(const Planned& first) const {
  double share = 1;
  for (std::size_t k = 0; k < 4; ++k) {
    const double jump = std::abs(first.direction[k]) * first.cruise_mm_s;
    if (jump > limits_.max_jerk_mm_s[k]) share = std::min(share, limits_.max_jerk_mm_s[k] / jump);
  }
  return first.cruise_mm_s * share;
}

MotionTimer::Planned MotionTimer::planned(const Move& move) const {
  const Axes& d = move.delta_mm;
  const double carriage = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  const bool only_filament = carriage < nothing_mm;
  const bool extruding = d[3] > 0 && (d[0] != 0 || d[1] != 0);
  Planned p;
  p.length_mm = only_filament ? std::abs(d[3]) : carriage;
  p.cruise_mm_s = move.speed_mm_s;
  p.acceleration_mm_s2 = only_filament ? limits_.retracting_mm_s2
                         : extruding   ? limits_.extruding_mm_s2
                                       : limits_.travel_mm_s2;
  if (move.acceleration_mm_s2 > 0) p.acceleration_mm_s2 = std::min(p.acceleration_mm_s2, move.acceleration_mm_s2);
  if (p.length_mm < nothing_mm) return p;
  for (std::size_t k = 0; k < 4; ++k) {
    p.direction[k] = d[k] / p.length_mm;
    const double share = std::abs(p.direction[k]);
    if (share < 1e-12) continue;
    p.cruise_mm_s = std::min(p.cruise_mm_s, limits_.max_speed_mm_s[k] / share);
    p.acceleration_mm_s2 = std::min(p.acceleration_mm_s2, limits_.max_acceleration_mm_s2[k] / share);
  }
  return p;
}

void MotionTimer::push(const Move& move) {
  assert(move.speed_mm_s > 0);
  Planned p = planned(move);
  if (p.length_mm < nothing_mm) {
    // Takes no time, but its turn comes after the moves before it.
    if (moves_.empty()) {
      duration_(0);
    } else {
      ++empty_after_;
    }
    return;
  }
  p.empty_before = std::exchange(empty_after_, 0);
  p.junction_mm_s = moves_.empty() ? start_speed(p) : junction_speed(moves_.back(), p);
  if (moves_.empty()) speed_mm_s_ = p.junction_mm_s;
  moves_.push_back(p);
  if (moves_.size() == 2 * window_) emit(window_, limits_.final_speed_mm_s);
}

void MotionTimer::stop() {
  emit(moves_.size(), limits_.final_speed_mm_s);
  for (; empty_after_ > 0; --empty_after_) duration_(0);
}

void MotionTimer::emit(std::size_t count, double exit_mm_s) {
  // Backwards: no junction faster than what can be braked from by the end of what is known.
  double next = exit_mm_s;
  for (std::size_t i = moves_.size(); i-- > 0;) {
    Planned& m = moves_[i];
    m.entry_mm_s = std::min(m.junction_mm_s, std::sqrt(next * next + 2 * m.acceleration_mm_s2 * m.length_mm));
    next = m.entry_mm_s;
  }

  // Forwards: no junction faster than what can be reached by then.
  for (std::size_t i = 0; i < count; ++i) {
    const Planned& m = moves_[i];
    const double entry = std::min(speed_mm_s_, m.cruise_mm_s);
    const double asked = i + 1 < moves_.size() ? moves_[i + 1].entry_mm_s : exit_mm_s;
    const double reached = std::sqrt(entry * entry + 2 * m.acceleration_mm_s2 * m.length_mm);
    const double exit = std::min({asked, reached, m.cruise_mm_s});
    for (std::size_t k = 0; k < m.empty_before; ++k) duration_(0);
    duration_(trapezoid_s(m.length_mm, entry, m.cruise_mm_s, exit, m.acceleration_mm_s2));
    speed_mm_s_ = exit;
  }
  moves_.erase(moves_.begin(), moves_.begin() + std::ptrdiff_t(count));
}

std::vector<double> durations_s(const std::vector<Move>& moves, const MotionLimits& limits) {
  std::vector<double> result;
  result.reserve(moves.size());
  MotionTimer timer(limits, [&](double s) { result.push_back(s); });
  for (const Move& m : moves) timer.push(m);
  timer.stop();
  return result;
}

}  // namespace cleancolor
