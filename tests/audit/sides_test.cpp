#include "audit/sides.hpp"

#include <gtest/gtest.h>

using namespace cleancolor;

namespace {

/// A block of 10 x 6 x 4 mm by nozzle 0, with one smear of nozzle 1 on its front where asked for.
struct Print {
  GcodePrint print;
  AuditMachine machine;
  AuditResult result;
};
Print print_with(double mm3, Place::Kind kind) {
  Print p;
  const auto layer = [](int i) {
    PartLayer l{.bottom_mm = 0.2 * i, .top_mm = 0.2 * (i + 1), .roads = {}};
    for (int k = 0; k < 15; ++k) l.roads.push_back({{0, 0.4 * k}, {10, 0.4 * k}, 0.4f, 0});
    return l;
  };
  for (int i = 0; i < 20; ++i) p.print.layers.push_back({0.2 * (i + 1), 0.2});
  p.machine.nozzles.resize(2);
  p.machine.nozzles[0].rgb = 0xFFFFFF;
  p.machine.nozzles[1].rgb = 0x0000FF;
  p.result.visibility = std::make_shared<PrintedVisibility>(20, layer, VisibilityOptions{}, 1);
  p.result.scenarios.resize(1);
  if (mm3 > 0) {
    Place place;
    place.kind = kind;
    place.nozzle = 1;
    place.mm3 = float(mm3);
    place.layer = 10;
    place.at_mm = place.end_mm = {5, 0};
    p.result.scenarios[0].places.push_back(place);
  }
  return p;
}
std::vector<Side> pictures(const Print& p) {
  return sides(p.print, p.machine, p.result, 0, 100);
}

}  // namespace

TEST(Sides, AreFourPictures) {
  const auto all = pictures(print_with(0, Place::Kind::smear));
  ASSERT_EQ(all.size(), 4u);
  const char* names[] = {"front", "right", "back", "left"};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(all[i].name, names[i]);
    EXPECT_EQ(all[i].png.substr(1, 3), "PNG");
  }
}

TEST(Sides, ShowASmearOnItsSideOnly) {
  const auto clean = pictures(print_with(0, Place::Kind::smear));
  for (const Place::Kind kind : {Place::Kind::smear, Place::Kind::hole}) {
    const auto smeared = pictures(print_with(1, kind));
    EXPECT_NE(clean[0].png, smeared[0].png);
    EXPECT_EQ(clean[2].png, smeared[2].png) << "the back";
  }
}

TEST(Sides, LeaveOutWhatCannotBeSeen) {
  EXPECT_EQ(pictures(print_with(0, Place::Kind::inner))[0].png, pictures(print_with(1, Place::Kind::inner))[0].png);
}

TEST(Sides, ShowMoreWhereMoreIsLeft) {
  EXPECT_NE(pictures(print_with(0.1, Place::Kind::smear))[0].png, pictures(print_with(2, Place::Kind::smear))[0].png);
}

TEST(Sides, OfNothingAreEmptyPictures) {
  Print p = print_with(1, Place::Kind::smear);
  p.result.visibility = std::make_shared<PrintedVisibility>(0, [](int) { return PartLayer{}; }, VisibilityOptions{}, 1);
  EXPECT_EQ(pictures(p).size(), 4u);
}
