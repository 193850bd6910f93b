#include "audit/ooze.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace cleancolor {
namespace {

constexpr double room_c = 25;
constexpr double hottest_c = 500;

/// 1 - exp(-x / scale).
double gone(double x, double scale) {
  return scale > 0 ? -std::expm1(-x / scale) : 1;
}

}  // namespace

OozeParameters worst_ooze() {
  return {};
}

OozeParameters model_ooze() {
  return {.volume_mm3 = 2,
          .time_s = 40,
          .missing_is_spent = true,
          .elastic_time_s = 0.05,
          .halving_c = 10,
          .heating_c_s = 2,
          .cooling_c_s = 2,
          .touch_height_mm = 0.6};
}

void NozzleState::start(double celsius) {
  settle();
  started_ = true;
  slow_mm3_ = slow_reserve();
  if (print_c_ <= 0) print_c_ = celsius;
}

double NozzleState::slow_reserve() const {
  const double v = parameters_.volume_mm3;
  return parameters_.missing_is_spent ? std::max(0., v - missing_mm3_) : v;
}

double NozzleState::flow_share(double celsius) const {
  if (parameters_.halving_c <= 0 || print_c_ <= 0 || celsius <= 0) return 1;
  return std::exp2((celsius - print_c_) / parameters_.halving_c);
}

/// The heater works for so long. Returns the seconds at printing temperature in which as much would flow.
double NozzleState::warm(double seconds) {
  const double rate = target_c_ > celsius_ ? parameters_.heating_c_s : -parameters_.cooling_c_s;
  double ramp_s = 0, ramp = 0;
  if (celsius_ > 0 && target_c_ != celsius_) {
    const double before = flow_share(celsius_);
    const double needed_s = rate != 0 ? (target_c_ - celsius_) / rate : 0;
    ramp_s = std::min(seconds, needed_s);
    celsius_ = seconds < needed_s ? celsius_ + rate * seconds : target_c_;
    const double after = flow_share(celsius_);
    // The integral of an exponential in time.
    const double growth = before > 0 && after > 0 ? std::log(after / before) : 0;
    ramp = ramp_s * (std::abs(growth) > 1e-6 ? (after - before) / growth : before);
  }
  return ramp + (seconds - ramp_s) * flow_share(celsius_);
}

/// Counts the time idled so far.
void NozzleState::settle() {
  if (pending_s_ <= 0) return;
  const double s = warm(std::exchange(pending_s_, 0));
  if (!started_ || s <= 0) return;
  const double slow = slow_mm3_ * gone(s, parameters_.time_s);
  const double elastic = elastic_mm3_ > 0 ? elastic_mm3_ * gone(s, parameters_.elastic_time_s) : 0;
  slow_mm3_ -= slow;
  elastic_mm3_ -= elastic;
  carried_mm3_ += slow + elastic;
  missing_mm3_ = std::min(parameters_.volume_mm3 + most_elastic_mm3_, missing_mm3_ + slow + elastic);
}

double NozzleState::leave(double length_mm, const OozeRules& rules) {
  settle();
  const double left = carried_mm3_ * (rules.touch_mm > 0 ? gone(length_mm, rules.touch_mm) : 1);
  carried_mm3_ -= left;
  if (rules.tireless && left > 0) slow_mm3_ = slow_reserve();
  return left;
}

NozzleState::Pushed NozzleState::push(double mm3, double seconds, bool prints) {
  settle();
  Pushed pushed;
  pushed.made_up_mm3 = std::min(missing_mm3_, mm3);
  missing_mm3_ -= pushed.made_up_mm3;
  if (!prints) return pushed;
  pushed.carried_mm3 = std::exchange(carried_mm3_, 0);
  started_ = true;
  slow_mm3_ = slow_reserve();
  elastic_mm3_ = most_elastic_mm3_ = seconds > 0 ? parameters_.elastic_time_s * mm3 / seconds : 0;
  // Whoever prints is hot, whatever the file told of its heater.
  if (target_c_ > room_c) print_c_ = target_c_;
  celsius_ = target_c_ = print_c_;
  return pushed;
}

void NozzleState::retract(double mm3) {
  settle();
  if (mm3 > 0) elastic_mm3_ = std::max(0., elastic_mm3_ - mm3);
}

void NozzleState::set_target(double celsius) {
  settle();
  if (celsius_ <= 0) celsius_ = room_c;
  target_c_ = std::clamp(celsius, room_c, hottest_c);
}

double NozzleState::seconds_to_target() {
  settle();
  const double missing_c = target_c_ - celsius_;
  return celsius_ > 0 && missing_c > 0 && parameters_.heating_c_s > 0 ? missing_c / parameters_.heating_c_s : 0;
}

double NozzleState::carried_mm3() {
  settle();
  return carried_mm3_;
}

double NozzleState::missing_mm3() {
  settle();
  return missing_mm3_;
}

}  // namespace cleancolor
