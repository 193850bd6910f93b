#include "plan/exposure_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "drawn_layer.hpp"
#include "plan/precedence.hpp"

namespace cleancolor {
namespace {

using namespace test;

/// Ooze in small steps: what TouchTrack sums up in closed form.
double walked_smear(const Path& path, Vec2 offset, int idle, const LayerMap& map, IdleState& nozzle,
                    const OozeModel& model) {
  double smear = 0;
  for (std::size_t i = 0; i < path.segments(); ++i) {
    const Vec2 a = path.points[i], b = path.points[(i + 1) % path.points.size()];
    const int steps = 4 * (int(distance(a, b) / 0.25) + 1);
    const double dt = distance(a, b) / path.road().speed_mm_s / steps;
    for (int k = 0; k < steps; ++k) {
      nozzle.carried_mm3 += model.volume_mm3 * nozzle.left * (1 - model.left(dt));
      nozzle.left *= model.left(dt);
      const LayerMap::Cell cell = map.at(lerp(a, b, (k + 0.5) / steps) + offset);
      if (cell.visibility == 0 || cell.extruder == idle) continue;
      smear += nozzle.carried_mm3 * cell.visibility / 255;
      nozzle.carried_mm3 = 0;
    }
  }
  return smear;
}

// A line of colour 0 drawn past two blocks of it, over which nozzle 1 comes, 10 mm higher.
const DrawnLayer& blocks() {
  static const DrawnLayer layer(
      {united(rectangle({5, 10}, {10, 15}), rectangle({20, 9}, {24, 15})), rectangle({0, 0}, {1, 1})});
  return layer;
}

TEST(TouchTrack, SumsUpWhatSmallStepsGive) {
  const LayerMap map = blocks().map();
  const OozeModel model;
  for (const bool closed : {false, true}) {
    const Path path = drawn_path(0, {{0, 2}, {30, 2}, {30, 3}, {0, 3}}, closed);
    IdleState stepped{0.8, 0.1}, told{0.8, 0.1};
    const double expected = walked_smear(path, {0, 10}, 1, map, stepped, model);
    const double smear = TouchTrack(path, {0, 10}, 1, map, 0).forwards(model).apply(told, model);
    EXPECT_GT(expected, 0.05);
    EXPECT_NEAR(smear, expected, 0.03 * expected);
    EXPECT_NEAR(told.carried_mm3, stepped.carried_mm3, 0.002);
    EXPECT_NEAR(told.left, stepped.left, 1e-9);
  }
}

TEST(TouchTrack, BackwardsIsThePathReversedAndLaterIsThePathBegunThere) {
  const LayerMap map = blocks().map();
  const OozeModel model;
  const auto smear = [&](const Touches& touches) {
    IdleState state{0.7, 0.2};
    return touches.apply(state, model) + 100 * state.carried_mm3;
  };
  const Path open = drawn_path(0, {{0, 2}, {13, 2}, {30, 3}}, false);
  EXPECT_NEAR(smear(TouchTrack(open, {0, 10}, 1, map, 0).backwards(model)),
              smear(TouchTrack(reversed(open), {0, 10}, 1, map, 0).forwards(model)), 0.02);
  const Path ring = drawn_path(0, {{0, 2}, {30, 2}, {30, 6}, {0, 6}}, true);
  const TouchTrack track(ring, {0, 10}, 1, map, 0);
  const Path begun_later = started_on(ring, 0, {14, 2});
  EXPECT_NEAR(smear(track.forwards(model, track.seconds_at(ring, 0, {14, 2}))),
              smear(TouchTrack(begun_later, {0, 10}, 1, map, 0).forwards(model)), 0.3);
}

TEST(TouchTrack, WallsWipeOnlyWhenTheyStand) {
  const std::vector<Path> walls{drawn_path(0, {{3, 5}, {3, 20}}, false, fill_depth, -1, Role::rampart)};
  const LayerMap map = blocks().map(walls);
  const OozeModel model;
  const Path path = drawn_path(0, {{0, 2}, {8, 2}}, false);
  const auto smear = [&](std::uint64_t standing) {
    IdleState state{1, 0.5};
    return TouchTrack(path, {0, 10}, 1, map, standing).forwards(model).apply(state, model);
  };
  EXPECT_GT(smear(0), 0.4);
  EXPECT_LT(smear(1), 0.05);
}

TEST(Precedence, IsInnerLoopsThenOuterThenFills) {
  const std::vector<Path> paths{
      drawn_path(0, {{0, 0}, {9, 0}, {9, 9}}, true, 0, 1), drawn_path(0, {{1, 1}, {8, 1}, {8, 7}}, true, 1, 1),
      drawn_path(0, {{2, 2}, {5, 2}}, false, fill_depth, 1), drawn_path(0, {{20, 2}, {25, 2}}, false, fill_depth, 2)};
  EXPECT_EQ(precedence(paths, false), (std::vector<std::vector<int>>{{1}, {}, {0, 1}, {}}));
  EXPECT_EQ(precedence(paths, true), (std::vector<std::vector<int>>{{}, {0}, {0, 1}, {}}));
}

/// Six paths, some of which put the idle nozzle over a block.
std::vector<Path> random_paths(std::mt19937& random) {
  const auto any = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  std::vector<Path> paths;
  for (int i = 0; i < 6; ++i) {
    const Vec2 p{any(0, 25), any(0, 4)};
    if (i % 3 == 0) {
      paths.push_back(drawn_path(0, {p, p + Vec2{2, 0}, p + Vec2{2, 2}, p + Vec2{0, 2}}, true, 0, i));
    } else {
      paths.push_back(drawn_path(0, {p, {any(0, 25), any(0, 4)}}, false, fill_depth, i - i % 3));
    }
  }
  return paths;
}

ExposureRun run_of(const std::vector<Path>& paths) {
  return {.walls = {},
          .paths = paths,
          .hanging = {{1, {0, 10}, {1, 0.1}}},
          .from_mm = {0, 0},
          .detours = {},
          .island_row = {}};
}

double weighed(const ExposureOrder& order, const OrderWeights& w) {
  return order.smear_mm3 + w.hole_weight * order.hole_mm3 + w.s_mm3 * order.seconds;
}

TEST(ExposureOrder, IsTheBestOfAllForFewPaths) {
  const LayerMap map = blocks().map();
  std::mt19937 random(5);
  int found = 0;
  for (int t = 0; t < 12; ++t) {
    SCOPED_TRACE(t);
    const std::vector<Path> paths = random_paths(random);
    const auto before = precedence(paths, false);
    // Every order and every direction, without a search.
    double least = std::numeric_limits<double>::infinity();
    std::vector<int> order(paths.size());
    std::iota(order.begin(), order.end(), 0);
    do {
      const auto place = [&](int i) { return std::ranges::find(order, i) - order.begin(); };
      bool allowed = true;
      for (std::size_t i = 0; i < paths.size(); ++i)
        for (const int b : before[i]) allowed = allowed && place(b) < place(int(i));
      if (!allowed) continue;
      for (unsigned turned = 0; turned < 64; ++turned) {
        std::vector<Path> walked;
        bool possible = true;
        for (const int i : order) {
          const bool back = turned >> i & 1;
          possible = possible && !(back && paths[std::size_t(i)].closed);
          walked.push_back(back ? reversed(paths[std::size_t(i)]) : paths[std::size_t(i)]);
        }
        if (!possible) continue;
        ExposureRun run = run_of(walked);
        run.steps_a_path = 0;
        least = std::min(least, weighed(exposure_order(run, map, {}, {}), {}));
      }
    } while (std::ranges::next_permutation(order).found);
    ExposureRun run = run_of(paths);
    run.steps_a_path = 2000;
    const double searched = weighed(exposure_order(run, map, {}, {}), {});
    EXPECT_GE(searched, least - 1e-9);
    EXPECT_LE(searched, least + 0.003);
    found += searched < least + 1e-9;
  }
  EXPECT_GE(found, 9);
}

TEST(ExposureOrder, KeepsWhatMustComeBeforeAndLosesNothing) {
  const LayerMap map = blocks().map();
  std::mt19937 random(6);
  for (int t = 0; t < 20; ++t) {
    std::vector<Path> paths;
    for (int k = 0; k < 5; ++k)
      for (Path& p : random_paths(random)) {
        p.island += 10 * k;
        paths.push_back(std::move(p));
      }
    // In an allowed order to begin with.
    std::ranges::stable_sort(paths, {}, [](const Path& p) { return std::pair(p.island, p.depth); });
    const ExposureOrder first = exposure_order(run_of(paths), map, {}, {});
    std::vector<int> place(paths.size(), -1);
    for (std::size_t i = 0; i < first.order.size(); ++i) place[std::size_t(first.order[i])] = int(i);
    EXPECT_EQ(std::ranges::count(place, -1), 0);
    const auto before = precedence(paths, false);
    for (std::size_t i = 0; i < paths.size(); ++i)
      for (const int b : before[i]) EXPECT_LT(place[std::size_t(b)], place[i]);
    ExposureRun unsearched = run_of(paths);
    unsearched.steps_a_path = 0;
    EXPECT_LE(weighed(first, {}), weighed(exposure_order(unsearched, map, {}, {}), {}));
    EXPECT_EQ(exposure_order(run_of(paths), map, {}, {}).order, first.order);
  }
}

}  // namespace
}  // namespace cleancolor
