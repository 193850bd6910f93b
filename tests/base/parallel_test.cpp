#include "base/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>

namespace cleancolor {
namespace {

TEST(ParallelFor, DoesEveryIndexOnce) {
  for (const int threads : {1, 2, 7}) {
    std::vector<std::atomic<int>> done(1000);
    parallel_for(1000, threads, [&](int i) { ++done[std::size_t(i)]; });
    for (const auto& d : done) EXPECT_EQ(d, 1);
  }
}

TEST(ParallelFor, OfNothingDoesNothing) {
  parallel_for(0, 4, [](int) { FAIL(); });
}

TEST(ParallelFor, ThrowsWhatItsBodyThrew) {
  EXPECT_THROW(parallel_for(100, 3,
                            [](int i) {
                              if (i == 50) throw std::runtime_error("50");
                            }),
               std::runtime_error);
}

// Three stages that each write down what they saw of the stage before: all within reach must be there.
struct Recorded {
  std::vector<int> first, second, third;
  std::vector<int> order;
  std::atomic<int> ahead = 0;
  int consumed = 0;
};

void run_recorded(Recorded& r, int count, int threads) {
  r.first.assign(std::size_t(count), 0);
  r.second = r.third = r.first;
  const auto in = [&](int i) { return i >= 0 && i < count; };
  run({.count = count,
       .window = 12,
       .stages = {{0,
                   [&](int i) {
                     std::this_thread::sleep_for(std::chrono::microseconds((i * 37) % 90));
                     r.first[std::size_t(i)] = i + 1;
                   }},
                  {3,
                   [&](int i) {
                     for (int k = i - 3; k <= i + 3; ++k)
                       if (in(k)) r.second[std::size_t(i)] += r.first[std::size_t(k)];
                   }},
                  {1,
                   [&](int i) {
                     r.third[std::size_t(i)] = r.second[std::size_t(i)] + (i > 0 ? r.second[std::size_t(i - 1)] : 0);
                   }}},
       .consume = [&](int i) { r.order.push_back(i); }},
      threads);
}

TEST(Stream, GivesEachStageWhatItReachesAndTheEndInOrder) {
  Recorded alone;
  run_recorded(alone, 200, 1);
  for (const int threads : {2, 5}) {
    Recorded together;
    run_recorded(together, 200, threads);
    EXPECT_EQ(together.third, alone.third);
    std::vector<int> ascending(200);
    std::iota(ascending.begin(), ascending.end(), 0);
    EXPECT_EQ(together.order, ascending);
  }
  EXPECT_EQ(alone.second[100], 7 * 101);
}

TEST(Stream, AStageRunsNoFurtherAheadThanItMay) {
  std::atomic<int> consumed = 0, most = 0;
  std::atomic<bool> ran_ahead = false;
  run({.count = 100,
       .window = 20,
       .stages = {{0, [](int) {}},
                  {2,
                   [&](int i) {
                     const int ahead = i - consumed;
                     if (ahead >= 3) ran_ahead = true;
                     if (ahead > most) most = ahead;
                   },
                   3}},
       .consume =
           [&](int i) {
             if (i % 10 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
             ++consumed;
           }},
      4);
  EXPECT_EQ(consumed, 100);
  EXPECT_FALSE(ran_ahead) << most;
}

TEST(Stream, NeverRunsFurtherAheadThanItsWindow) {
  std::atomic<int> prepared = 0;
  std::atomic<int> most = 0;
  int consumed = 0;
  run({.count = 100,
       .window = 8,
       .stages = {{0, [&](int) { ++prepared; }}},
       .consume =
           [&](int) {
             most = std::max(most.load(), prepared.load() - consumed);
             ++consumed;
           }},
      4);
  EXPECT_LE(most, 8 + 1);
  EXPECT_EQ(consumed, 100);
}

TEST(Stream, StopsAndThrowsFromAnyStage) {
  for (const int where : {0, 1, 2}) {
    int consumed = 0;
    const auto failing = [&](int stage) {
      return [=](int i) {
        if (stage == where && i == 20) throw std::runtime_error("20");
      };
    };
    EXPECT_THROW(run({.count = 50,
                      .window = 6,
                      .stages = {{0, failing(0)}, {2, failing(1)}},
                      .consume =
                          [&](int i) {
                            failing(2)(i);
                            ++consumed;
                          }},
                     3),
                 std::runtime_error);
    EXPECT_LE(consumed, 21);
  }
}

TEST(Stream, OfNoLayersEnds) {
  run({.count = 0, .window = 4, .stages = {{0, [](int) { FAIL(); }}}, .consume = [](int) { FAIL(); }}, 2);
}

}  // namespace
}  // namespace cleancolor
