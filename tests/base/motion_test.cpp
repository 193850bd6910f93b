#include "base/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

using namespace cleancolor;

namespace {

MotionLimits limits(double acceleration, double jerk) {
  const double any = 1e6;
  return {.max_speed_mm_s = {any, any, any, any},
          .max_acceleration_mm_s2 = {any, any, any, any},
          .max_jerk_mm_s = {jerk, jerk, jerk, jerk},
          .extruding_mm_s2 = acceleration,
          .travel_mm_s2 = acceleration,
          .retracting_mm_s2 = acceleration};
}

double total_s(const std::vector<Move>& moves, const MotionLimits& l) {
  const auto all = durations_s(moves, l);
  return std::accumulate(all.begin(), all.end(), 0.0);
}

std::vector<Move> random_walk(unsigned seed, std::size_t count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> step(-3, 3);
  std::uniform_real_distribution<double> speed(10, 120);
  std::vector<Move> moves(count);
  for (Move& m : moves) m = {{step(random), step(random), 0, random() % 3 ? 0.1 : 0.0}, speed(random)};
  return moves;
}

// From standing to 0.05 mm/s over 1000 mm at 50 mm/s and 50 mm/s2: the ramp down takes t and d.
const double ramp_down_s = (50 - 0.05) / 50;
const double ramp_down_mm = 25 * ramp_down_s * ramp_down_s + 0.05 * ramp_down_s;

}  // namespace

TEST(MotionTimer, LongMoveFromStandstillAcceleratesCruisesAndBrakes) {
  const double expected = 1 + (1000 - 25 - ramp_down_mm) / 50 + ramp_down_s;
  EXPECT_NEAR(total_s({{{1000, 0, 0, 0}, 50}}, limits(50, 0)), expected, 1e-9);
  EXPECT_NEAR(expected, 20.999, 1e-3);
}

TEST(MotionTimer, WithEndlessJerkAMoveStartsAtFullSpeed) {
  const double expected = (1000 - ramp_down_mm) / 50 + ramp_down_s;
  EXPECT_NEAR(total_s({{{1000, 0, 0, 0}, 50}}, limits(50, std::numeric_limits<double>::infinity())), expected, 1e-9);
  EXPECT_NEAR(expected, 20.499, 1e-3);
}

TEST(MotionTimer, StraightLineTakesTheSameTimeInOnePieceAndInMany) {
  const std::vector<Move> pieces(100, Move{{10, 0, 0, 0}, 50});
  EXPECT_NEAR(total_s(pieces, limits(50, 0)), total_s({{{1000, 0, 0, 0}, 50}}, limits(50, 0)), 1e-9);
}

TEST(MotionTimer, RightAngleIsPassedAtTheSpeedOfTheJerk) {
  // At 8 mm/s of jerk per axis both axes may start and stop at 8 mm/s at once: the corner is entered at 8 mm/s.
  const MotionLimits l = limits(1000, 8);
  const auto turning = durations_s({{{20, 0, 0, 0}, 100}, {{0, 20, 0, 0}, 100}}, l);
  const double v_start = 8, v_corner = 8, v_end = 0.05;
  const auto trapezoid = [](double v0, double v1) {
    return (100 - v0) / 1000 + (100 - v1) / 1000 +
           (20 - (100 * 100 - v0 * v0) / 2000 - (100 * 100 - v1 * v1) / 2000) / 100;
  };
  EXPECT_NEAR(turning[0], trapezoid(v_start, v_corner), 1e-9);
  EXPECT_NEAR(turning[1], trapezoid(v_corner, v_end), 1e-9);
}

TEST(MotionTimer, SlowestAxisLimitsTheWholeMove) {
  MotionLimits l = limits(1000, 1e6);
  l.max_speed_mm_s[3] = 1;  // filament
  // 1 mm/s of filament is 20 mm/s of the carriage, which brakes for 20 ms at half its speed.
  EXPECT_NEAR(total_s({{{10, 0, 0, 0.5}, 100}}, l), 0.5 + 0.01, 1e-4);
}

TEST(MotionTimer, EachKindOfMoveHasItsAcceleration) {
  MotionLimits l = limits(1000, 0);
  l.travel_mm_s2 = 4000;
  l.retracting_mm_s2 = 250;
  l.final_speed_mm_s = 0;
  EXPECT_NEAR(total_s({{{1, 0, 0, 1}, 1e5}}, l), 2 * std::sqrt(1.0 / 1000), 1e-9);
  EXPECT_NEAR(total_s({{{1, 0, 0, 0}, 1e5}}, l), 2 * std::sqrt(1.0 / 4000), 1e-9);
  EXPECT_NEAR(total_s({{{0, 0, 0, -1}, 1e5}}, l), 2 * std::sqrt(1.0 / 250), 1e-9);
}

TEST(MotionTimer, BoundedWindowFindsWhatTheWholeListFinds) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const auto moves = random_walk(seed, 3000);
    const MotionLimits l = limits(1000, 8);
    double in_window = 0;
    MotionTimer timer(l, [&](double s) { in_window += s; }, 64);
    for (const Move& m : moves) timer.push(m);
    timer.stop();
    double at_once = 0;
    MotionTimer patient(l, [&](double s) { at_once += s; }, moves.size());
    for (const Move& m : moves) patient.push(m);
    patient.stop();
    EXPECT_NEAR(in_window, at_once, 1e-6 * at_once);
  }
}

TEST(MotionTimer, EveryMoveGetsOneDurationInItsPlace) {
  std::vector<Move> moves = random_walk(7, 2000);
  for (std::size_t i = 0; i < moves.size(); i += 3) moves[i].delta_mm = {};
  const auto all = durations_s(moves, limits(1000, 8));
  ASSERT_EQ(all.size(), moves.size());
  for (std::size_t i = 0; i < moves.size(); ++i) EXPECT_EQ(all[i] > 0, i % 3 != 0) << i;
}

TEST(MotionTimer, NoMoveIsFasterThanItsSpeed) {
  const auto moves = random_walk(3, 2000);
  const auto all = durations_s(moves, limits(1000, 8));
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const double length = std::hypot(moves[i].delta_mm[0], moves[i].delta_mm[1]);
    EXPECT_GE(all[i] * moves[i].speed_mm_s, length * (1 - 1e-9)) << i;
  }
}
