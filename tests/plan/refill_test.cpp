#include "plan/refill.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drawn_layer.hpp"
#include "plan/planner.hpp"
#include "plan/wall_room.hpp"

namespace cleancolor {
namespace {

using namespace test;

//   |  wall at x = 2          far away at x = 80: what was printed before
//   |   +-+
//   |   | |  a post of one loop at x = 5
//   |   +-+
struct Post {
  DrawnLayer drawn{{united(rectangle({5, 5}, {7, 7}), rectangle({80, 0}, {90, 10})), rectangle({120, 0}, {121, 1})}};
  std::vector<Path> paths{drawn_path(0, {{2, 0}, {2, 20}}, false, fill_depth, -1, Role::rampart),
                          drawn_path(0, {{82, 2}, {88, 2}}, false, fill_depth, 1),
                          drawn_path(0, {{5.2, 5.2}, {6.8, 5.2}, {6.8, 6.8}, {5.2, 6.8}}, true, 0, 2)};
  OozeModel model;
  RefillOptions options{.hole_mm = 24000 * 4, .hop = {.speed_mm_s = 100, .acceleration_mm_s2 = 1000}};

  std::vector<Path> refilled() const {
    const LayerMap map = drawn.map(std::span(paths).first(1));
    const TravelCost cost(map, {{0, {0, 0}, {}}, {1, {300, 0}, {}}}, {});
    return with_refills(paths, roadmap(paths, cost), cost, model, options);
  }
};

TEST(Refill, PushesWhatIsMissingBesideTheWallBeforeAPostFarAway) {
  const Post post;
  const std::vector<Path> paths = post.refilled();
  ASSERT_EQ(paths.size(), 4U);
  const Path& refill = paths[2];
  EXPECT_EQ(refill.road().role, Role::refill);
  for (const Vec2 p : refill.points) EXPECT_NEAR(p.x, 2, 1e-9);
  // All that came out on some 86 mm: with accelerations of 0.1 s and 0.04 s for drawing back.
  const double way_mm = travel_mm(paths[1].end(), refill);
  EXPECT_NEAR(volume_mm3(refill), 2 * (1 - post.model.left(way_mm / 100 + 0.1 + 0.04)), 1e-9);
  EXPECT_NEAR(way_mm, 86, 6);
  EXPECT_LE(refill.road().speed_mm_s, 120);
  EXPECT_LE(refill.road().area_mm2, 0.0601);
  EXPECT_LT(travel_mm(refill.end(), paths[3]), 8);
}

TEST(Refill, IsNotMadeWhereItBringsNothing) {
  Post no_wall;
  no_wall.paths.erase(no_wall.paths.begin());
  EXPECT_EQ(no_wall.refilled().size(), 2U);
  Post inner;
  inner.paths[2].depth = 1;
  EXPECT_EQ(inner.refilled().size(), 3U) << "what is missing in an inner loop nobody sees";
  Post near;
  near.paths[1].points = {{8, 5}, {8, 6}};
  EXPECT_EQ(near.refilled().size(), 3U) << "nothing is missing yet";
  Post other;
  other.paths[1].extruder = 1;
  EXPECT_EQ(other.refilled().size(), 3U) << "a nozzle begins with its own wall";
}

TEST(Refill, LosesNoPathAndKeepsTheirOrder) {
  const Post post;
  std::vector<Path> paths = post.refilled();
  std::erase_if(paths, [](const Path& p) { return p.road().role == Role::refill; });
  ASSERT_EQ(paths.size(), post.paths.size());
  for (std::size_t k = 0; k < paths.size(); ++k) EXPECT_EQ(paths[k].points, post.paths[k].points);
}

TEST(Refill, IsAsFastAsItsVolumeAsks) {
  // 2 mm of a filament of 1.75 mm a second are 4.81 mm3; 2 mm3 take 0.416 s.
  EXPECT_NEAR(refill_speed(20, {.volume_mm3 = 2, .feed_mm_s = 2, .filament_diameter_mm = 1.75}),
              20 * 2 * std::numbers::pi * 1.75 * 1.75 / (4 * 2), 1e-12);
  EXPECT_NEAR(refill_speed(20, {}), 48.1056, 1e-3);
  EXPECT_NEAR(refill_speed(10, {.filament_diameter_mm = 2.85}), 24.0528 * std::pow(2.85 / 1.75, 2), 2e-3);
  EXPECT_NEAR(refill_speed(20, {.volume_mm3 = 4}), 48.1056 / 2, 1e-3);
  EXPECT_NEAR(refill_speed(20, {.feed_mm_s = 1}), 48.1056 / 2, 1e-3);
  EXPECT_EQ(refill_speed(200, {}), 120);
  EXPECT_EQ(refill_speed(0, {}), 0);
}

/// The post with a hop that goes along the wall for 12 mm.
struct PostByTheWall : Post {
  PostByTheWall() {
    options.mode = RefillMode::fixed;
    paths[2].travel = {{2, 18}, {2, 6}};
  }
};

TEST(FixedRefill, PushesTheSameVolumeOnEachWayAlongAWall) {
  PostByTheWall post;
  post.options.volume_mm3 = 0.5;
  post.options.filament_diameter_mm = {1.5};
  const std::vector<Path> paths = post.refilled();
  ASSERT_EQ(paths.size(), 4U);
  const Path& refill = paths[2];
  EXPECT_EQ(refill.road().role, Role::refill);
  EXPECT_NEAR(length_mm(refill), 12, 1);
  EXPECT_NEAR(volume_mm3(refill), 0.5, 1e-9);
  EXPECT_NEAR(refill.road().speed_mm_s, length_mm(refill) * 2 * std::numbers::pi * 1.5 * 1.5 / (4 * 0.5), 1e-6);
  // The way is the one that it was.
  EXPECT_NEAR(travel_mm(paths[1].end(), refill) + length_mm(refill) + travel_mm(refill.end(), paths[3]),
              travel_mm(post.paths[1].end(), post.paths[2]), 1e-9);
  // From a wall to the part, though no outer wall begins.
  post.paths.erase(post.paths.begin() + 1);
  post.paths[1].depth = 1;
  post.paths[1].travel = {{2, 8}};
  EXPECT_EQ(post.refilled().size(), 3U);
}

TEST(FixedRefill, PushesNoMoreThanThereIsRoomFor) {
  const PostByTheWall post;
  const std::vector<Path> paths = post.refilled();
  ASSERT_EQ(paths.size(), 4U);
  EXPECT_NEAR(paths[2].road().area_mm2, 0.06, 1e-6) << "2 mm3 on 12 mm would be 0.17 mm2";
  EXPECT_NEAR(paths[2].road().speed_mm_s, 2 * std::numbers::pi / 4 * 1.75 * 1.75 / 0.06, 1e-2) << "as fast as fed";
}

TEST(FixedRefill, IsNotMadeAcrossAWallNorFarFromItNorBeforeAnInnerLoop) {
  PostByTheWall across;
  across.paths[2].travel.clear();
  EXPECT_EQ(across.refilled().size(), 3U);
  PostByTheWall far;
  far.paths[2].travel = {{-3, 18}, {-3, 6}};
  EXPECT_EQ(far.refilled().size(), 3U);
  PostByTheWall inner;
  inner.paths[2].depth = 1;
  EXPECT_EQ(inner.refilled().size(), 3U);
  PostByTheWall later;
  std::rotate(later.paths.begin(), later.paths.begin() + 1, later.paths.end());
  later.paths[1].travel = {{2, 18}, {2, 6}};
  EXPECT_EQ(later.refilled().size(), 3U) << "the wall does not stand yet";
}

TEST(WallRoom, HoldsAllPassesTogether) {
  const Post post;
  const LayerMap map = post.drawn.map();
  WallRoom room(map, 4);
  room.stand(post.paths[0]);
  std::mt19937 random(5);
  const auto any = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  int passes = 0;
  for (int k = 0; k < 300; ++k) {
    const double x = any(0, 2.3);
    const std::vector<Vec2> way{{any(-9, 1), any(-9, 29)}, {x, any(0, 20)}, {x, any(0, 20)}, {any(-9, 1), any(-9, 29)}};
    const auto pass = room.longest_pass(way, 1.5);
    if (!pass) continue;
    ++passes;
    room.lay(*pass, pass->most_area_mm2 * any(0.3, 1));
    for (const Vec2 p : pass->points_mm) EXPECT_EQ(map.at(p).extruder, LayerMap::air);
  }
  EXPECT_GT(passes, 5);
  // Beside the wall 2 roads of 0.4 x 0.2 mm; on it 0.06 mm2.
  for (std::size_t mm = 0; mm < room.size_mm(0); ++mm) EXPECT_LE(room.laid_mm3(0, mm), 0.16 + 1e-9) << mm;
}

TEST(FixedRefill, OverlappingPassesTogetherKeepToTheRoomBesideEachMillimetre) {
  // The same hop again and again: each pass may use only what those before it left.
  PostByTheWall post;
  post.options.volume_mm3 = 0.3;
  const Path far = post.paths[1], loop = post.paths[2];
  for (int k = 0; k < 6; ++k) post.paths.push_back(far), post.paths.push_back(loop);
  std::vector<double> laid(21, 0);
  int passes = 0;
  for (const Path& path : post.refilled()) {
    if (path.road().role != Role::refill) continue;
    ++passes;
    const double low = std::min(path.start().y, path.end().y), high = std::max(path.start().y, path.end().y);
    for (int mm = 0; mm < 20; ++mm)
      laid[std::size_t(mm)] += path.road().area_mm2 * std::max(0., std::min(high, mm + 1.) - std::max(low, double(mm)));
  }
  EXPECT_EQ(passes, 2) << "0.025 mm2 each; then less than half of 0.06 mm2 is left";
  for (const double mm3 : laid) EXPECT_LE(mm3, 0.06 + 1e-9);
}

TEST(FixedRefill, IsPushedOnlyBesideStandingWallsAndOutsideThePart) {
  std::mt19937 random(6);
  int passes = 0;
  for (int t = 0; t < 10; ++t) {
    SCOPED_TRACE(t);
    std::vector<Path> paths;
    const DrawnLayer drawn = random_drawn_layer(random, 8, 30, paths);
    const Box<Vec2> box = bounds_mm(drawn.outline);
    const Path wall = drawn_path(0, to_mm(rectangle(box.min - Vec2{2, 2}, box.max + Vec2{2, 2}).front()), true,
                                 fill_depth, -1, Role::rampart);
    paths.insert(paths.begin(), wall);
    for (Path& path : paths) path.extruder = 0;
    const LayerMap map = drawn.map(std::span(paths).first(1));
    const TravelCost cost(map, {{0, {0, 0}, {}}, {1, {300, 0}, {}}}, {});
    const Roadmap roads = roadmap(paths, cost);
    // By way of two corners of the wall, or straight.
    for (Path& path : paths)
      if (random() % 2 == 0) path.travel = {wall.points[random() % 4], wall.points[random() % 4]};
    for (const Path& path : with_refills(paths, roads, cost, {}, {.mode = RefillMode::fixed, .hop = {}})) {
      if (path.road().role != Role::refill) continue;
      ++passes;
      EXPECT_LE(path.road().area_mm2, 0.16 + 1e-9);
      EXPECT_LE(path.road().speed_mm_s, 120);
      const double half_mm = path.road().area_mm2 / path.road().height_mm / 2;
      for (std::size_t i = 0; i + 1 < path.points.size(); ++i)
        for (int k = 0; k <= 20; ++k) {
          const Vec2 p = lerp(path.points[i], path.points[i + 1], k / 20.);
          double off = 1e9;
          for (std::size_t s = 0; s < wall.segments(); ++s)
            off = std::min(off, distance(p, nearest_on_segment(wall.points[s], wall.points[(s + 1) % 4], p)));
          EXPECT_LE(off, 2.4);
          EXPECT_TRUE(
              intersection(rectangle(p - Vec2{half_mm, half_mm}, p + Vec2{half_mm, half_mm}), drawn.outline).empty());
        }
    }
  }
  EXPECT_GT(passes, 20);
}

TEST(Refill, BeginsAboveTheSkippedLayers) {
  const Polygons square = rectangle({0, 0}, {10, 10});
  const DrawnLayer drawn({square, {}});
  // The way from either end of the wall follows it.
  const std::vector<Path> paths{drawn_path(0, {{-2, -30}, {-2, 40}}, false, fill_depth, -1, Role::rampart),
                                drawn_path(0, to_mm(rectangle({0.2, 0.2}, {9.8, 9.8}).front()), true, 0)};
  for (const int skipped : {0, 2, 3}) {
    Config config;
    config.refill_mode = RefillMode::fixed;
    config.refill_skipped_layers = skipped;
    for (int index = 0; index < 5; ++index) {
      OrderState state;
      PlannedLayer planned({.index = index, .print_z_mm = 45, .height_mm = 0.2, .paths = paths, .fan_by_extruder = {}},
                           state, config,
                           {.part = {drawn.regions, drawn.outline, drawn.above, 45, 0.4},
                            .site = {{0}, drawn.outline},
                            .hanging = {0},
                            .reach = {}},
                           drawn.visibility);
      const auto is_refill = [](const Path& p) { return p.road().role == Role::refill; };
      EXPECT_EQ(std::ranges::any_of(planned.layer().paths, is_refill), index >= skipped) << skipped << ", " << index;
    }
  }
}

}  // namespace
}  // namespace cleancolor
