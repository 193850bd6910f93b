// What holds for each print_order, on random layers whose colours lie in each other.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "drawn_layer.hpp"
#include "plan/planner.hpp"

namespace cleancolor {
namespace {

using namespace test;

constexpr unsigned seeds = 10;

struct Boxes {
  std::vector<Polygons> regions{2};
  std::vector<Path> paths;
  int islands = 0;
};

struct Drawn {
  DrawnLayer layer;
  std::vector<Path> paths;
};

/// A box of one colour, its loops and fills; where there is room with a hole, and another one of either colour in it.
void draw_box(Boxes& drawn, std::mt19937& random, int extruder, Vec2 low, Vec2 high, int nested) {
  const auto any = [&](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  const auto grown = [&](double by) { return rectangle(low - Vec2{by, by}, high + Vec2{by, by}); };
  const int island = drawn.islands++;
  const auto loop = [&](const Polygons& box, int depth) {
    drawn.paths.push_back(drawn_path(extruder, to_mm(box.front()), true, depth, island));
  };
  const auto fill = [&](Vec2 a, Vec2 b) {
    drawn.paths.push_back(drawn_path(extruder, {a, b}, false, fill_depth, island));
  };
  Polygons region = rectangle(low, high);
  loop(grown(-0.2), 0);
  loop(grown(-0.6), 1);
  const Vec2 size = high - low;
  fill(low + Vec2{1, 1}, low + Vec2{1, any(2, size.y - 1)});
  fill(low + Vec2{any(2, size.x - 2), 1.2}, low + Vec2{size.x - 1, 1.2});
  if (nested > 0 && std::min(size.x, size.y) > 10) {
    const Vec2 inner_low = low + Vec2{any(2.5, 4), any(2.5, 4)}, inner_high = high - Vec2{any(2, 3), any(2, 3)};
    const auto hole = [&](double by) { return rectangle(inner_low - Vec2{by, by}, inner_high + Vec2{by, by}); };
    region = difference(region, hole(0));
    loop(hole(0.2), 0);
    loop(hole(0.6), 1);
    draw_box(drawn, random, int(random() % 2), inner_low + Vec2{0.1, 0.1}, inner_high - Vec2{0.1, 0.1}, nested - 1);
  }
  drawn.regions[std::size_t(extruder)] = united(drawn.regions[std::size_t(extruder)], region);
}

Drawn random_nested(unsigned seed) {
  std::mt19937 random(seed);
  const auto any = [&](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  Boxes drawn;
  for (int i = 0; i < 3; ++i) {
    const Vec2 low{28. * i, any(0, 6)};
    draw_box(drawn, random, int(random() % 2), low, low + Vec2{any(8, 25), any(8, 25)}, 2);
  }
  std::ranges::shuffle(drawn.paths, random);
  return {DrawnLayer(std::move(drawn.regions)), std::move(drawn.paths)};
}

Path around(int extruder, const DrawnLayer& layer, double by_mm, Role role) {
  const Box<Vec2> box = bounds_mm(layer.outline);
  const Vec2 by{by_mm, by_mm};
  return drawn_path(extruder, to_mm(rectangle(box.min - by, box.max + by).front()), true, fill_depth, -1, role);
}

std::vector<Path> planned(const Drawn& drawn, PrintOrder print_order, Planner planner = Planner::clean,
                          bool walls = false) {
  const DrawnLayer& layer = drawn.layer;
  std::vector<Path> paths = drawn.paths;
  Config config;
  config.extruders.resize(2);
  config.extruders[1].nozzle_offset_mm = {14, 3};
  config.join_perimeters = false;
  config.print_order = print_order;
  config.planner = planner;
  OrderState state;
  if (walls)
    for (const int e : {0, 1}) {
      paths.push_back(around(e, layer, 2 + 4. * e, Role::rampart));
      paths.push_back(around(e, layer, 12 + e, Role::skirt_brim));
    }
  Layer all{.index = 3, .print_z_mm = 45, .height_mm = 1, .paths = std::move(paths), .fan_by_extruder = {}};
  const PlanScene scene{.part = {layer.regions, layer.outline, layer.above, 45, 0.4},
                        .site = {{0, 1}, layer.outline},
                        .hanging = {0, 1},
                        .reach = {}};
  return PlannedLayer(std::move(all), state, config, scene, layer.visibility).layer().paths;
}

int runs(const std::vector<Path>& paths) {
  int result = 1;
  for (std::size_t i = 1; i < paths.size(); ++i) result += paths[i].extruder != paths[i - 1].extruder;
  return result;
}

Polygons inside_of(const Path& path) {
  Ring ring;
  for (const Vec2 p : path.points) ring.push_back(to_nm(p));
  if (area_mm2(ring) < 0) std::ranges::reverse(ring);
  return {ring};
}

/// Whether every point of the path lies inside the loop.
bool lies_in(const Path& path, const Path& loop) {
  return within(path, inside_of(loop)) && area_mm2(inside_of(path)) < area_mm2(inside_of(loop));
}

TEST(PrintOrder, PaperNeverGoesBackIntoARegionWhoseBorderIsDone) {
  for (unsigned seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Path> paths = planned(random_nested(seed), PrintOrder::paper);
    int inside = 0;
    for (std::size_t i = 0; i < paths.size(); ++i)
      for (std::size_t k = 0; k < paths.size(); ++k) {
        if (!paths[i].closed || !lies_in(paths[k], paths[i])) continue;
        EXPECT_LT(k, i) << k << " lies in " << i;
        ++inside;
      }
    EXPECT_GT(inside, 10);
  }
}

// Of an island: no loop after the one between it and the air, no loop after a fill.
TEST(PrintOrder, OneColourAfterTheOtherNeitherGoesBackBehindALoopThatIsDone) {
  for (unsigned seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    const Drawn drawn = random_nested(seed);
    for (const PrintOrder print_order : {PrintOrder::exposure, PrintOrder::few_changes}) {
      const std::vector<Path> paths = planned(drawn, print_order);
      int neighbours = 0;
      for (std::size_t i = 0; i < paths.size(); ++i)
        for (std::size_t k = 0; k < paths.size(); ++k) {
          const Path &inner = paths[k], &outer = paths[i];
          if (inner.extruder != outer.extruder || inner.island != outer.island || !inner.closed) continue;
          if (!outer.closed) {
            EXPECT_LT(k, i) << "a loop of its island after a fill";
            continue;
          }
          // Both of the outline, or both of the hole: 0.4 mm apart on each side.
          const bool next = std::abs(std::abs(length_mm(inner) - length_mm(outer)) - 3.2) < 1e-6;
          if (!next || inner.depth != outer.depth + 1) continue;
          EXPECT_LT(k, i) << k << " is further inside than " << i;
          ++neighbours;
        }
      EXPECT_GT(neighbours, 2);
    }
  }
}

TEST(PrintOrder, FewChangesHasOneRunForEachColour) {
  int more = 0;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    const Drawn drawn = random_nested(seed);
    for (const bool walls : {false, true})
      for (const PrintOrder print_order : {PrintOrder::few_changes, PrintOrder::exposure})
        EXPECT_LE(runs(planned(drawn, print_order, Planner::clean, walls)), 2);
    more += runs(planned(drawn, PrintOrder::paper)) > 2;
  }
  EXPECT_GT(more, 3) << "else the paper's order was hardly tried";
}

TEST(PrintOrder, EveryOrderPrintsEveryPathOnce) {
  const auto laid = [](const std::vector<Path>& paths) {
    std::vector<std::tuple<int, int, int, long>> result;
    for (const Path& p : paths) result.emplace_back(p.extruder, p.island, p.depth, std::lround(1000 * length_mm(p)));
    std::ranges::sort(result);
    return result;
  };
  for (unsigned seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    const Drawn drawn = random_nested(seed);
    for (const PrintOrder print_order : {PrintOrder::exposure, PrintOrder::few_changes, PrintOrder::paper})
      EXPECT_EQ(laid(planned(drawn, print_order)), laid(drawn.paths));
    EXPECT_EQ(laid(planned(drawn, PrintOrder::exposure, Planner::paper)), laid(drawn.paths));
  }
}

TEST(PrintOrder, SkirtThenWallsOfAColourComeBeforeItsFirstRun) {
  for (unsigned seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    const Drawn drawn = random_nested(seed);
    for (const PrintOrder print_order : {PrintOrder::exposure, PrintOrder::few_changes, PrintOrder::paper}) {
      std::map<int, std::vector<Role>> roles;
      for (const Path& path : planned(drawn, print_order, Planner::clean, true)) {
        std::vector<Role>& own = roles[path.extruder];
        EXPECT_EQ(path.road().role == Role::skirt_brim, own.empty());
        EXPECT_EQ(path.road().role == Role::rampart, own.size() == 1);
        own.push_back(path.road().role);
      }
      EXPECT_EQ(roles.size(), 2U);
    }
  }
}

TEST(PrintOrder, IroningComesAfterAllElseOfItsColourAsItIsGiven) {
  for (unsigned seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    Drawn drawn = random_nested(seed);
    std::mt19937 random(seed);
    std::map<int, std::vector<Vec2>> given;  // starts
    for (int i = 0; i < 8; ++i) {
      const auto place = [&] { return Vec2{double(random() % 70), double(random() % 20)}; };
      const Path over = drawn_path(i % 2, {place(), place()}, false, fill_depth, int(random() % 3), Role::ironing);
      given[over.extruder].push_back(over.start());
      drawn.paths.insert(drawn.paths.begin() + (i < 2 ? 0 : std::ptrdiff_t(drawn.paths.size())), over);
    }
    for (const PrintOrder print_order : {PrintOrder::exposure, PrintOrder::few_changes, PrintOrder::paper}) {
      std::map<int, std::vector<Vec2>> starts;
      for (const Path& path : planned(drawn, print_order, Planner::clean, true)) {
        if (path.road().role == Role::ironing)
          starts[path.extruder].push_back(path.start());
        else
          EXPECT_FALSE(starts.contains(path.extruder)) << "printed after it is ironed";
      }
      EXPECT_EQ(starts, given);
    }
  }
}

TEST(PrintOrder, PlannerPaperHasThePapersOrder) {
  for (unsigned seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    const auto names = [](const std::vector<Path>& paths) {
      std::vector<std::pair<int, long>> result;
      for (const Path& path : paths) result.emplace_back(path.extruder, std::lround(1000 * length_mm(path)));
      return result;
    };
    const Drawn drawn = random_nested(seed);
    EXPECT_EQ(names(planned(drawn, PrintOrder::exposure, Planner::paper)), names(planned(drawn, PrintOrder::paper)));
  }
}

}  // namespace
}  // namespace cleancolor
