// Printers whose idle nozzles leave the print: IDEX, tool changers. The bars of the file of PrusaSlicer as such
// printers get them: places are those of the nozzle in use.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "replan/change_places.hpp"
#include "replanning.hpp"

namespace cleancolor {
namespace {

using namespace test;

constexpr MachineRequest parked = {
    .printer = {}, .nozzle_offset_mm = {}, .offsets_in = {}, .idle_nozzle = IdleNozzle::parked};

const std::string& bars() {
  static const std::string text = [] {
    std::istringstream in(fixture("prusaslicer.gcode"));
    std::string all;
    bool second = false;
    for (std::string line; std::getline(in, line); all += line + "\n") {
      if (line == "T0" || line == "T1") second = line == "T1";
      const std::size_t x = line.find(" X");
      if (!second || !line.starts_with("G1") || x == line.npos) continue;
      std::size_t length = 0;
      const double told = std::stod(line.substr(x + 2), &length);
      line.replace(x + 2, length, fmt::format("{:.3f}", told + 33));
    }
    return replaced(all, "extruder_offset = 0x0,33x0", "extruder_offset = 0x0,0x0");
  }();
  return text;
}

TEST(ReplanParked, NeedNotKnowWhereTheNozzlesAre) {
  EXPECT_TRUE(replanned_text(bars(), {}, {}, parked).changed);
  EXPECT_ERROR(replanned_text(bars()), "--idle-nozzle parked");
}

TEST(ReplanParked, KeepsFilamentAndComesOutCleaner) {
  const Replanned result = replanned_text(bars(), {}, {}, parked);
  const auto before = part_filament(read_gcode(bars(), "")), after = part_filament(read_gcode(result.text, ""));
  ASSERT_EQ(before.size(), after.size());
  for (const auto& [what, mm] : before) EXPECT_NEAR(after.at(what), mm, 1e-4 * mm);
  ASSERT_TRUE(result.gain);
  EXPECT_LE(result.gain->after.smear_mm3, result.gain->before.smear_mm3 / 8);
  EXPECT_LE(result.gain->after.hole_mm3, result.gain->before.hole_mm3);
}

TEST(ReplanParked, TakesNoToolOverTheOtherColour) {
  const GcodePrint print = read_gcode(replanned_text(bars(), {}, {}, parked).text, "");
  const std::size_t layers = print.text->find(";LAYER_CHANGE");
  int changes = 0;
  for (const GcodeEvent& e : print.events) {
    if (e.kind != GcodeEvent::Kind::tool_change || e.offset < layers || e.before_move == 0) continue;
    if (e.before_move >= print.moves.size()) continue;
    const Vec3 at = print.moves[e.before_move - 1].to_mm;
    const bool on_bars = std::abs(at.x) < 19.8;
    // The bar of T0 reaches from -7.8 to -0.2, that of T1 from 0.2 to 7.8.
    const double into_other = e.tool == 0 ? at.y : -at.y;
    EXPECT_FALSE(on_bars && into_other > 0.2 && into_other < 7.8)
        << "T" << int(e.tool) << " at " << at.x << ", " << at.y;
    ++changes;
  }
  EXPECT_GE(changes, 8);
}

TEST(ReplanParked, PlannedAgainStaysAsItIs) {
  const std::string once = replanned_text(bars(), {}, {}, parked).text;
  EXPECT_FALSE(replanned_text(once, {}, {}, parked).changed);
}

TEST(ReplanParked, WithOrderAndTravelKeptMakesTheSameMoves) {
  const GcodePrint before = read_gcode(bars(), ""),
                   after = read_gcode(replanned_text(bars(), {.keeps_order = true}, {}, parked).text, "");
  const auto moving = [](const GcodePrint& print) {
    std::vector<std::pair<Vec3, double>> moves;
    for (const GcodeMove& m : print.moves)
      if (moves.empty() || m.to_mm != moves.back().first || std::abs(m.filament_mm) > 1e-9)
        moves.emplace_back(m.to_mm, std::round(m.filament_mm * 1e5));
    return moves;
  };
  EXPECT_EQ(moving(before), moving(after));
}

Path path_at(int extruder, Vec2 from, Vec2 to) {
  Path path;
  path.extruder = extruder;
  path.points = {from, to};
  path.stretches.push_back({0, {Role::external_perimeter, 0.4, 0.2, 0.08, 30}});
  return path;
}

// Colour 0 from x = 0 to 10, colour 1 from 20 to 30.
const std::vector<Polygons> two_colours = {rectangle({0, 0}, {10, 10}), rectangle({20, 0}, {30, 10})};

TEST(ChangePlaces, LieWhereTheWayLeavesTheOtherColour) {
  Layer layer;
  layer.paths = {path_at(0, {2, 5}, {4, 5}), path_at(1, {22, 5}, {28, 5})};
  const Layer result = with_change_places(layer, two_colours, {}, nullptr);
  ASSERT_EQ(result.paths[1].travel_before_change, 1u);
  ASSERT_EQ(result.paths[1].travel.size(), 1u);
  EXPECT_NEAR(result.paths[1].travel[0].x, 10.25, 0.3);
}

TEST(ChangePlaces, AreLeftAloneWhereTheOldToolIsBesideItAlready) {
  Layer layer;
  layer.paths = {path_at(0, {2, 5}, {15, 5}), path_at(1, {22, 5}, {28, 5})};
  EXPECT_EQ(with_change_places(layer, two_colours, {}, nullptr).paths[1].travel_before_change, 0u);
}

TEST(ChangePlaces, LookAtTheLayerBelowWhereOneBegins) {
  Layer layer;
  layer.paths = {path_at(1, {22, 5}, {28, 5})};
  const Path before = path_at(0, {2, 5}, {4, 5});
  const std::vector<Polygons> ended = {Polygons{}, two_colours[1]};  // colour 0 does not go on
  EXPECT_EQ(with_change_places(layer, ended, two_colours, &before).paths[0].travel_before_change, 1u);
  EXPECT_EQ(with_change_places(layer, ended, {}, &before).paths[0].travel_before_change, 0u);
}

}  // namespace
}  // namespace cleancolor
