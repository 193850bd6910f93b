#include "gcode/clock.hpp"

#include <cmath>

namespace cleancolor {

void Clock::push(const Move& move) {
  const Axes& d = move.delta_mm;
  const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  nominal_s_ += (length > 0 ? length : std::abs(d[3])) / move.speed_mm_s;
  ++pushed_;
  timer_.push(move);
}

Clock::Mark Clock::mark() {
  const Mark mark = times_s_.size() + waiting_.size();
  if (waiting_.empty() && done_ == pushed_) {
    times_s_.push_back(total_s_);
  } else {
    waiting_.push_back(pushed_);
  }
  return mark;
}

void Clock::stop() {
  timer_.stop();
}

void Clock::done(double s) {
  total_s_ += s;
  ++done_;
  std::size_t reached = 0;
  while (reached < waiting_.size() && waiting_[reached] == done_) ++reached;
  if (reached == 0) return;
  times_s_.insert(times_s_.end(), reached, total_s_);
  waiting_.erase(waiting_.begin(), waiting_.begin() + std::ptrdiff_t(reached));
}

}  // namespace cleancolor
