// gcode/clock.hpp
//
// Clock: the time of the print so far, known a little after the moves were written (base/motion.hpp).
//
// mark() names a moment, between the last move and the next; when the clock has stopped, time_s() tells when it is.
#pragma once

#include <cstddef>
#include <vector>

#include "base/motion.hpp"

namespace cleancolor {

class Clock {
 public:
  using Mark = std::size_t;

  explicit Clock(const MotionLimits& limits) : timer_(limits, [this](double s) { done(s); }) {}
  Clock(const Clock&) = delete;  // the timer calls back
  Clock& operator=(const Clock&) = delete;

  void push(const Move& move);

  Mark mark();
  void stop();

  double nominal_s() const { return nominal_s_; }  // of all moves so far, at full speed
  double total_s() const { return total_s_; }
  double time_s(Mark mark) const { return times_s_[mark]; }  // Requires: stopped

 private:
  void done(double s);

  MotionTimer timer_;
  double nominal_s_ = 0;
  double total_s_ = 0;
  std::size_t pushed_ = 0;
  std::size_t done_ = 0;
  std::vector<std::size_t> waiting_;  // marks not yet reached: the number of moves before each
  std::vector<double> times_s_;       // of the marks reached
};

}  // namespace cleancolor
