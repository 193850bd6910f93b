#include "audit/exposed.hpp"

#include <gtest/gtest.h>

using namespace cleancolor;

namespace {

constexpr float width = 0.4f, area = 0.08f;

/// A closed rectangle of roads around the origin, but for a gap in the middle of its lower side.
std::vector<LabelledRoad> rectangle(double half_x, double half_y, Role role, double gap_mm = 0) {
  const Vec2 a{-half_x, -half_y}, b{half_x, -half_y}, c{half_x, half_y}, d{-half_x, half_y};
  std::vector<LabelledRoad> roads;
  const auto add = [&](Vec2 from, Vec2 to) { roads.push_back({from, to, width, area, role}); };
  // The round ends of the roads reach half a width into the gap.
  const double open = gap_mm > 0 ? (gap_mm + double(width)) / 2 : 0;
  add({open, -half_y}, b);
  add(b, c);
  add(c, d);
  add(d, a);
  add(a, {-open, -half_y});
  return roads;
}

std::vector<LabelledRoad>& operator+=(std::vector<LabelledRoad>& roads, const std::vector<LabelledRoad>& more) {
  roads.insert(roads.end(), more.begin(), more.end());
  return roads;
}

PartOutline plate(double half) {
  return PartOutline(rectangle(half, half, Role::unknown));
}

}  // namespace

TEST(PartOutline, HoldsWhatItsWallsEnclose) {
  const PartOutline outline(rectangle(10, 5, Role::external_perimeter));
  EXPECT_TRUE(outline.contains({0, 0}));
  EXPECT_TRUE(outline.contains({10, 0})) << "on the wall";
  EXPECT_FALSE(outline.contains({10.5, 0}));
  EXPECT_FALSE(outline.contains({0, -5.5}));
  EXPECT_FALSE(outline.contains({1e9, -1e9}));
}

TEST(PartOutline, OfNothingHoldsNothing) {
  EXPECT_FALSE(PartOutline().contains({0, 0}));
  EXPECT_FALSE(PartOutline(std::vector<LabelledRoad>{}).contains({0, 0}));
  EXPECT_FALSE(PartOutline(rectangle(5, 5, Role::skirt_brim)).contains({0, 0})) << "auxiliary plastic";
}

TEST(PartOutline, ClosesSeamsButNotDoors) {
  for (const double angle_share : {0.0, 0.3, 0.8}) {
    SCOPED_TRACE(angle_share);
    auto turned = [&](double gap_mm) {
      auto roads = rectangle(10, 5, Role::external_perimeter, gap_mm);
      for (LabelledRoad& r : roads)
        for (Vec2* p : {&r.a_mm, &r.b_mm})
          *p = {p->x * std::cos(angle_share) - p->y * std::sin(angle_share) + angle_share,
                p->x * std::sin(angle_share) + p->y * std::cos(angle_share)};
      return PartOutline(roads);
    };
    EXPECT_TRUE(turned(0.3).contains({angle_share, 0}));
    EXPECT_FALSE(turned(2).contains({angle_share, 0}));
  }
}

TEST(PartOutline, TakesLargerCellsForLargeParts) {
  EXPECT_EQ(plate(10).cell_mm(), 0.2);
  const PartOutline large = plate(5000);
  EXPECT_GT(large.cell_mm(), 1);
  EXPECT_TRUE(large.contains({0, 0}));
  EXPECT_FALSE(large.contains({5100, 0}));
}

TEST(Exposures, FollowWhatTheFileCallsItsRoads) {
  std::vector<LabelledRoad> roads;
  for (const Role role : {Role::external_perimeter, Role::top_solid_infill, Role::ironing, Role::internal_infill,
                          Role::solid_infill, Role::perimeter})
    roads.push_back({{-1, 0}, {1, 0}, width, area, role});
  roads += rectangle(10, 10, Role::unknown);
  const auto e = exposures(roads, PartOutline(roads), plate(10), ExposedBy::labels);
  const std::vector<bool> visible = {true, true, true, false, false, false};
  for (std::size_t i = 0; i < visible.size(); ++i) {
    EXPECT_EQ(e[i].visible, visible[i]) << i;
    EXPECT_EQ(e[i].outer, i == 0) << i;
    EXPECT_FALSE(e[i].wipes);
  }
}

// Three loops, each against the next, and nothing said of them.
TEST(Exposures, SeeTheOutermostLoopByItself) {
  std::vector<LabelledRoad> roads;
  for (int k = 0; k < 3; ++k) roads += rectangle(10 - 0.4 * k, 6 - 0.4 * k, Role::unknown);
  const PartOutline outline(roads);
  const auto both = exposures(roads, outline, plate(20));
  const auto labels = exposures(roads, outline, plate(20), ExposedBy::labels);
  for (std::size_t i = 0; i < roads.size(); ++i) {
    EXPECT_EQ(both[i].outer, i < 5) << i;
    EXPECT_EQ(both[i].visible, i < 5) << i;
    EXPECT_FALSE(labels[i].visible) << i;
  }
}

TEST(Exposures, SeeAThinWallThoughItIsCalledInfill) {
  const std::vector<LabelledRoad> roads = {{{0, 0}, {30, 17}, width, area, Role::internal_infill}};
  EXPECT_TRUE(exposures(roads, PartOutline(roads), plate(100))[0].outer);
}

TEST(Exposures, SeeAnOpenTop) {
  auto roads = rectangle(10, 10, Role::external_perimeter);
  const std::size_t covered = roads.size(), open = covered + 1;
  roads.push_back({{-3, 0}, {3, 0}, width, area, Role::internal_infill});
  roads.push_back({{-3, 7}, {3, 7}, width, area, Role::internal_infill});
  const PartOutline outline(roads), above(rectangle(9, 5, Role::external_perimeter));
  const auto e = exposures(roads, outline, above);
  EXPECT_FALSE(e[covered].visible);
  EXPECT_TRUE(e[open].visible);
  EXPECT_FALSE(e[open].outer);
  EXPECT_TRUE(exposures(roads, outline, PartOutline())[covered].visible) << "the last layer";
}

TEST(Exposures, CallAnOverhangAnOuterWallOnlyWhereItIsOutermost) {
  auto roads = rectangle(10, 10, Role::overhang_perimeter);
  roads += rectangle(9.6, 9.6, Role::overhang_perimeter);
  for (const ExposedBy by : {ExposedBy::labels, ExposedBy::both}) {
    const auto e = exposures(roads, PartOutline(roads), plate(20), by);
    for (std::size_t i = 0; i < e.size(); ++i) EXPECT_EQ(e[i].outer, i < 5) << i;
  }
}

TEST(Exposures, KnowTheWallOfABoreByItsLabelAlone) {
  auto roads = rectangle(10, 10, Role::external_perimeter);
  roads += rectangle(4, 4, Role::external_perimeter);
  const PartOutline outline(roads), above = plate(10);
  EXPECT_TRUE(exposures(roads, outline, above).back().outer);
  EXPECT_FALSE(exposures(roads, outline, above, ExposedBy::geometry).back().outer);
}

TEST(Exposures, LetAuxiliaryPlasticWipeOutsideThePartWhereItHasAVolume) {
  auto roads = rectangle(10, 10, Role::external_perimeter);
  const std::size_t first = roads.size();
  roads.push_back({{20, 0}, {30, 0}, width, 0.08f, Role::wipe_tower});
  roads.push_back({{20, 1}, {30, 1}, width, 0.02f, Role::wipe_tower});
  roads.push_back({{-3, 0}, {3, 0}, width, 0.08f, Role::skirt_brim});
  const auto e = exposures(roads, PartOutline(roads), plate(10));
  EXPECT_TRUE(e[first].wipes);
  EXPECT_FALSE(e[first + 1].wipes) << "a road without plastic";
  EXPECT_FALSE(e[first + 2].wipes) << "inside the part";
  for (const Exposure& x : e) EXPECT_FALSE(x.wipes && x.visible);
}

TEST(Exposures, BearOddRoads) {
  const std::vector<LabelledRoad> roads = {{{0, 0}, {0, 0}, 0, 0, Role::unknown},
                                           {{0, 0}, {0, 0}, 1e30f, 0, Role::unknown},
                                           {{-1e4, 1e4}, {1e4, -1e4}, -3, -1, Role::external_perimeter}};
  EXPECT_EQ(exposures(roads, PartOutline(roads), PartOutline()).size(), 3u);
}
