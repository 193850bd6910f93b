#include "explain/explanation.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "explain/drawn_plan.hpp"
#include "explain/plan_picture.hpp"
#include "explain/plan_table.hpp"

namespace cleancolor {
namespace {

struct Explained {
  GcodePrint print;
  AuditMachine machine;
  Explanation plan;
};

Explained of(const Drawing& drawing, std::uint32_t layer, AuditMachine machine, int threads = 1) {
  GcodePrint print = drawing.print();
  Explanation plan = explained(print, machine, layer, {.threads = threads});
  return {std::move(print), std::move(machine), std::move(plan)};
}
Explained of(const Drawing& drawing, std::uint32_t layer) {
  return of(drawing, layer, drawing.machine());
}

TEST(Explanation, FindsZonesAndWhoPrintsInThem) {
  const Explanation plan = of(two_boxes(20), 9).plan;
  ASSERT_EQ(plan.zones.size(), 2u);
  ASSERT_EQ(plan.runs.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(plan.runs[k].zone, k < 3 ? 0 : 1) << k;
  for (const Polygons& region : plan.regions) EXPECT_NEAR(area_mm2(region), 100, 0.1);
  EXPECT_EQ(plan.used, (std::vector<int>{0, 1}));
}

TEST(Explanation, KnowsWhatCanBeSeen) {
  const Explanation plan = of(two_boxes(60), 40).plan;
  EXPECT_GT(plan.map->at({0.2, 5}).visibility, 150);  // a wall outside
  EXPECT_EQ(plan.map->at({5, 5}).visibility, 0);      // inside
  EXPECT_LT(plan.map->at({9.8, 5}).visibility, 26);   // where both colours touch
  EXPECT_LT(plan.map->at({10.2, 5}).visibility, 26);
  EXPECT_EQ(plan.map->at({10.2, 5}).extruder, 1);
  EXPECT_GT(plan.runs[1].start_visibility, 0.5);
  EXPECT_EQ(plan.runs[2].start_visibility, 0);
}

TEST(Explanation, SeesTopSurfaces) {
  EXPECT_GT(of(two_boxes(60), 59).plan.map->at({5, 5}).visibility, 180);
}

// Nozzle 1 goes once through the box of nozzle 0, once around it.
TEST(Explanation, TellsHopsOverAnotherColour) {
  for (const bool around : {false, true}) {
    Drawing d = two_boxes(30);
    d.layer(30).tool(1).infill().road({15, 5}, {18, 5});
    if (around) d.go({15, -2}).go({-5, -2});
    d.go({-5, 5}).lay({-8, 5});
    const Explanation plan = of(d, 30).plan;
    ASSERT_EQ(plan.runs.size(), 2u);
    EXPECT_NEAR(plan.runs[1].hop_mm, around ? std::hypot(3, 7) + 20 + 7 : 23, 1e-3);
    EXPECT_EQ(plan.runs[1].hop_foreign, 0);  // the layer has nothing of nozzle 0
  }
  for (const bool around : {false, true}) {
    Drawing d = two_boxes(30);
    if (around) d.go({15, -2}).go({-5, -2});
    d.infill().go({-5, 5}).lay({-8, 5});
    const Explanation plan = of(d, 29).plan;
    ASSERT_EQ(plan.runs.size(), 7u);
    EXPECT_EQ(plan.runs[6].hop_foreign > 0.3, !around);
  }
}

// The tip of nozzle 0 hangs 33 mm to the left of that of nozzle 1.
TEST(Explanation, TellsWhatIdleNozzlesCrossWhileAnotherPrints) {
  Drawing d = two_boxes(30);
  d.infill().road({38, -5}, {38, 15});
  const Explained e = of(d, 29);

  EXPECT_EQ(e.plan.runs.at(6).idle_foreign, 0);  // over its own colour
  Drawing other = two_boxes(30);
  other.infill().road({48, -5}, {48, 15});
  EXPECT_GT(of(other, 29).plan.runs.at(6).idle_foreign, 0.3);
  AuditMachine docked = other.machine();
  docked.idle_nozzle = IdleNozzle::docked;
  EXPECT_EQ(of(other, 29, docked).plan.runs.at(6).idle_foreign, 0);
}

TEST(Explanation, HasARoadmapThatHangsTogether) {
  for (const IdleNozzle idle : {IdleNozzle::same_height, IdleNozzle::docked}) {
    const Drawing d = two_boxes(10);
    AuditMachine machine = d.machine();
    machine.idle_nozzle = idle;
    const Explanation plan = of(d, 5, machine).plan;
    ASSERT_EQ(plan.roadmaps.size(), idle == IdleNozzle::same_height ? 1u : 2u);
    std::size_t entries = 0;
    for (const Roadmap& map : plan.roadmaps) {
      std::vector<char> reached(map.nodes_mm.size());
      std::vector<std::uint32_t> open{0};
      reached[0] = 1;
      while (!open.empty()) {
        const std::uint32_t a = open.back();
        open.pop_back();
        for (const Arc& arc : map.arcs_of(a))
          if (!reached[arc.to]) reached[arc.to] = 1, open.push_back(arc.to);
      }
      EXPECT_EQ(std::ranges::count(reached, 1), std::ptrdiff_t(reached.size()));
      for (const auto& e : map.entries) entries += e.size();
    }
    // Loops every 1.5 mm, lines at both ends.
    EXPECT_NEAR(double(entries), 2 * (4 * 8.8 / 1.5 + 4 * 9.6 / 1.5 + 2), 8);
  }
}

TEST(Explanation, CountsRampartsAsWalls) {
  Drawing d = two_boxes(3);
  d.layer(3).tool(0).rampart().road({-4, -4}, {14, -4}).wall();
  draw_loop(d, {0.2, 0.2}, {9.8, 9.8});
  const GcodePrint print = read_gcode(d.text(), "drawn.gcode");
  const Explanation plan = explained(print, d.machine(), 3);
  EXPECT_EQ(plan.printed.runs.at(0).path.road().role, Role::rampart);
  EXPECT_EQ(plan.map->at({5, -4}).wall, 1);
  EXPECT_NE(plan_text(plan, print).find("Rampart"), std::string::npos);
}

TEST(PlanTable, HasARowForEachPathAndTotals) {
  const Explained e = of(two_boxes(10), 5);
  const std::string text = plan_text(e.plan, e.print);
  EXPECT_NE(text.find("layer 6 of 10, z 1.20 mm"), text.npos) << text;
  EXPECT_NE(text.find("\n   6 "), text.npos) << text;
  EXPECT_EQ(text.find("\n   7 "), text.npos) << text;
  EXPECT_NE(text.find("6 paths, 163 mm of road"), text.npos) << text;
  const auto json = nlohmann::json::parse(plan_json(e.plan, e.print));
  EXPECT_EQ(json["layer"], 6);
  ASSERT_EQ(json["paths"].size(), 6u);
  EXPECT_EQ(json["paths"][4]["extruder"], 2);
  EXPECT_EQ(json["paths"][4]["zone"], "B");
  EXPECT_EQ(json["paths"][4]["roles"], (std::vector<std::string>{"External perimeter"}));
  EXPECT_EQ(json["roadmap"]["nodes"], e.plan.roadmaps[0].nodes_mm.size());
}

TEST(PlanTable, NamesZonesByLetters) {
  EXPECT_EQ(zone_name(0), "A");
  EXPECT_EQ(zone_name(25), "Z");
  EXPECT_EQ(zone_name(26), "AA");
  EXPECT_EQ(zone_name(26 + 27), "BB");
}

TEST(PlanPicture, IsTheSameForAnyNumberOfThreads) {
  const Drawing d = two_boxes(30);
  const Explained one = of(d, 20, d.machine(), 1), many = of(d, 20, d.machine(), 4);
  const std::string svg = plan_picture(one.print, {one.plan, one.machine}).svg();
  EXPECT_EQ(svg, plan_picture(many.print, {many.plan, many.machine}).svg());
  EXPECT_EQ(plan_text(one.plan, one.print), plan_text(many.plan, many.print));
  EXPECT_GT(svg.size(), 10'000u);
}

TEST(PlanPicture, ShowsFlatAndHighPartsAndSinglePoints) {
  for (const Vec2 to : {Vec2{300, 0}, Vec2{0, 300}, Vec2{0.001, 0}}) {
    Drawing d(drawn_machine({{0, 0}}));
    d.layer(0).infill().road({0, 0}, to);
    const Explained e = of(d, 0);
    EXPECT_GT(plan_picture(e.print, {e.plan, e.machine}).png().size(), 1000u);
  }
}

}  // namespace
}  // namespace cleancolor
