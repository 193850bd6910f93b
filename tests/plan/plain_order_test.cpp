#include "plan/plain_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

#include "drawn_layer.hpp"

namespace cleancolor {
namespace {

Path path_of(int extruder, int island, int depth, std::vector<Vec2> points, bool closed) {
  return test::drawn_path(extruder, std::move(points), closed, depth, island);
}

Path loop_at(Vec2 c, double r, int extruder, int island, int depth) {
  return path_of(extruder, island, depth, {c + Vec2{-r, -r}, c + Vec2{r, -r}, c + Vec2{r, r}, c + Vec2{-r, r}}, true);
}

/// Islands of two colours, each with two loops and some fill lines; shuffled within reason by the seed.
Layer random_layer(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> at(0, 100);
  Layer layer;
  layer.index = int(seed);
  for (int extruder = 0; extruder < 2; ++extruder)
    for (int island = 0; island < 4; ++island) {
      const Vec2 c{at(random), at(random)};
      layer.paths.push_back(loop_at(c, 3.6, extruder, island, 1));
      layer.paths.push_back(loop_at(c, 4, extruder, island, 0));
      for (int i = 0; i < 3; ++i)
        layer.paths.push_back(
            path_of(extruder, island, fill_depth, {c + Vec2{-3, double(i)}, c + Vec2{3, double(i)}}, false));
    }
  return layer;
}

auto key(const Path& p) {
  return std::tuple(p.extruder, p.island, p.depth, length_mm(p));
}

TEST(PlainOrder, PrintsEveryPathOnce) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const Layer before = random_layer(seed);
    Layer after = before;
    OrderState state;
    order(after, state, {});
    ASSERT_EQ(after.paths.size(), before.paths.size());
    auto a = before.paths, b = after.paths;
    const auto by_key = [](const Path& x, const Path& y) { return key(x) < key(y); };
    std::sort(a.begin(), a.end(), by_key);
    std::sort(b.begin(), b.end(), by_key);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(key(a[i]), key(b[i]));
  }
}

TEST(PlainOrder, PrintsInnerLoopsBeforeOuterAndLoopsBeforeFill) {
  for (const bool outer_first : {false, true}) {
    Config config;
    config.external_perimeters_first = outer_first;
    Layer layer = random_layer(3);
    OrderState state;
    order(layer, state, config);
    for (std::size_t i = 1; i < layer.paths.size(); ++i) {
      const Path &a = layer.paths[i - 1], &b = layer.paths[i];
      if (a.extruder != b.extruder || a.island != b.island) continue;
      const auto rank = [&](const Path& p) {
        return p.depth == fill_depth ? 2 : (p.depth == 0) != outer_first ? 1 : 0;
      };
      EXPECT_LE(rank(a), rank(b));
    }
  }
}

TEST(PlainOrder, StaysWithTheExtruderOfTheLayerBelow) {
  OrderState state;
  int changes = 0;
  for (unsigned k = 0; k < 10; ++k) {
    Layer layer = random_layer(k);
    const int before = state.extruder;
    order(layer, state, {});
    EXPECT_EQ(layer.paths.front().extruder, before);
    for (std::size_t i = 1; i < layer.paths.size(); ++i)
      changes += layer.paths[i].extruder != layer.paths[i - 1].extruder;
  }
  EXPECT_EQ(changes, 10);
}

TEST(PlainOrder, GoesToTheNearestIslandNext) {
  Layer layer;
  for (const double x : {80.0, 10.0, 50.0, 30.0}) layer.paths.push_back(loop_at({x, 0}, 4, 0, int(x), 0));
  OrderState state;
  order(layer, state, {});
  std::vector<int> visited;
  for (const Path& path : layer.paths) visited.push_back(path.island);
  EXPECT_EQ(visited, (std::vector<int>{10, 30, 50, 80}));
}

TEST(PlainOrder, TurnsOpenPathsRoundWhereTheOtherEndIsNearer) {
  Layer layer;
  layer.paths = {path_of(0, 0, fill_depth, {{0, 0}, {10, 0}}, false),
                 path_of(0, 0, fill_depth, {{0, 1}, {10, 1}}, false)};
  OrderState state;
  order(layer, state, {});
  EXPECT_EQ(layer.paths[0].start(), (Vec2{0, 0}));
  EXPECT_EQ(layer.paths[1].start(), (Vec2{10, 1}));
  EXPECT_EQ(state.at, (Vec2{0, 1}));
}

TEST(PlainOrder, PrintsSkirtAndPrimeLinesFirst) {
  Layer layer = random_layer(1);
  layer.paths.push_back(path_of(1, -1, fill_depth, {{0, -9}, {40, -9}}, false));
  layer.paths.push_back(path_of(0, -1, fill_depth, {{0, -10}, {40, -10}}, false));
  OrderState state;
  order(layer, state, {});
  EXPECT_EQ(layer.paths.front().island, -1);
  const auto second =
      std::find_if(layer.paths.begin(), layer.paths.end(), [](const Path& p) { return p.extruder == 1; });
  EXPECT_EQ(second->island, -1);
}

TEST(PlainOrder, OfAnEmptyLayerKeepsTheState) {
  Layer layer;
  OrderState state;
  state.extruder = 1;
  state.at = {3, 4};
  order(layer, state, {});
  EXPECT_EQ(state.extruder, 1);
  EXPECT_EQ(state.at, (Vec2{3, 4}));
}

}  // namespace
}  // namespace cleancolor
