// Files of PrusaSlicer: the fixture is two bars of two colours, 40 x 8 mm each, side by side in 8 layers, by
// PrusaSlicer 2.5.0.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>

#include "replanning.hpp"
#include "sanitized.hpp"

namespace cleancolor {
namespace {

using namespace test;

const std::string& bar() {
  static const std::string text = fixture("prusaslicer.gcode");
  return text;
}
const std::string& bar_replanned() {
  static const std::string text = replanned_text(bar()).text;
  return text;
}

/// The same print with E in lengths instead of counts.
std::string with_relative_e(const std::string& text) {
  std::istringstream in(text);
  std::string line, out;
  double count = 0;
  while (std::getline(in, line)) {
    const std::size_t e = line.find(" E");
    if (line.starts_with("M82")) line = "M83";
    if (line.starts_with("G92 E")) {
      count = 0;
    } else if (line.starts_with("G1 ") && e != line.npos) {
      std::size_t length = 0;
      const double told = std::stod(line.substr(e + 2), &length);
      line.replace(e + 2, length, fmt::format("{:.5f}", told - count));
      count = told;
    }
    out += line + "\n";
  }
  return out;
}

TEST(ReplanPrusaSlicer, APrintBeyondTheBedIsNoMatterOfRoomForTheRampart) {
  const std::string own = "; bed_shape = -112.5x-72.5,112.5x-72.5,112.5x72.5,-112.5x72.5";
  const std::string text = replaced(fixture("prusaslicer.gcode"), own, "; bed_shape = 0x0,100x0,100x100,0x100");
  std::string said;
  const Replanned result = replanned_text(text, {}, {.warn = [&](const std::string& warning) { said += warning; }});
  EXPECT_TRUE(result.changed);
  EXPECT_NE(said.find("the print itself lies beyond the bed"), said.npos) << said;
}

TEST(ReplanPrusaSlicer, NoNozzleIsDrivenWhereItDoesNotReach) {
  // The bars are 40.4 mm x 16 mm. There is no room for a rampart.
  const std::string own = "; bed_shape = -112.5x-72.5,112.5x-72.5,112.5x72.5,-112.5x72.5";
  const std::string text =
      replaced(fixture("prusaslicer.gcode"), own, "; bed_shape = -20.5x-8.5,20.5x-8.5,20.5x8.5,-20.5x8.5");
  const Replanned result = replanned_text(text);
  ASSERT_TRUE(result.changed);
  EXPECT_FALSE(result.has_rampart);
  const GcodePrint print = read_gcode(result.text, "");
  const AuditMachine machine = audit_machine(print, {});
  const std::size_t begin = result.text.find(";LAYER_CHANGE"), end = result.text.rfind(";TYPE:");
  int ways = 0;
  for (const GcodeMove& move : print.moves) {
    if (move.offset < begin || move.offset > end || !move.names_xy) continue;
    const Vec2 at = plastic_mm(machine, {move.to_mm.x, move.to_mm.y}, move.tool);
    EXPECT_LE(std::abs(at.x), 20.501) << line_at(result.text, move.offset);
    EXPECT_LE(std::abs(at.y), 8.501) << line_at(result.text, move.offset);
    ways += move.filament_mm == 0;
  }
  EXPECT_GT(ways, 20);
}

TEST(ReplanPrusaSlicer, KeepsFilamentOfEachToolAndRole) {
  const auto before = part_filament(read_gcode(bar(), "")), after = part_filament(read_gcode(bar_replanned(), ""));
  ASSERT_EQ(before.size(), after.size());
  for (const auto& [what, mm] : before) {
    SCOPED_TRACE(role_name(what.second));
    EXPECT_NEAR(after.at(what), mm, 1e-4 * mm);
  }
}

TEST(ReplanPrusaSlicer, PrintsEveryRoadOnceButForSeamsThatMoved) {
  const auto before = part_roads(read_gcode(bar(), "")), after = part_roads(read_gcode(bar_replanned(), ""));
  double missing_mm = 0, added_mm = 0;
  int missing = 0;
  for (const auto& [road, times] : before) {
    const auto found = after.find(road);
    const int there = found == after.end() ? 0 : found->second;
    EXPECT_LE(there, times);
    if (there < times) ++missing, missing_mm += length_mm(road);
  }
  for (const auto& [road, times] : after)
    if (!before.contains(road)) added_mm += length_mm(road);
  // Two walls of two colours in eight layers: each cut once, and once where its gap was and is.
  EXPECT_LE(missing, 2 * 2 * 2 * 8);
  EXPECT_NEAR(added_mm, missing_mm, 0.01 * 2 * 2 * 8);
}

/// Outer walls of the part that begin after a way, not out of an inner loop.
int lone_outer_starts(const std::string& text) {
  const GcodePrint print = read_gcode(text, "");
  int starts = 0;
  for (std::size_t i = 1; i < print.moves.size(); ++i)
    starts += lays_plastic(print, i) && print.moves[i].role == Role::external_perimeter && !lays_plastic(print, i - 1);
  return starts;
}

TEST(ReplanPrusaSlicer, LetsInnerLoopsGoOverIntoOuterWallsWithoutAStop) {
  EXPECT_GE(lone_outer_starts(bar()), 2 * 8);
  EXPECT_EQ(lone_outer_starts(bar_replanned()), 0);
  EXPECT_LE(cleanness(bar_replanned()).hole_mm3, cleanness(bar()).hole_mm3 / 20);
}

TEST(ReplanPrusaSlicer, WithOrderAndTravelKeptMakesTheSameMoves) {
  for (const std::string& text : {bar(), with_relative_e(bar())}) {
    const GcodePrint before = read_gcode(text, ""),
                     after = read_gcode(replanned_text(text, {.keeps_order = true}).text, "");
    const auto moving = [](const GcodePrint& print) {
      std::vector<std::pair<Vec3, double>> moves;
      for (const GcodeMove& m : print.moves) {
        const bool moves_at_all = moves.empty() || m.to_mm != moves.back().first || std::abs(m.filament_mm) > 1e-9;
        if (moves_at_all) moves.emplace_back(m.to_mm, std::round(m.filament_mm * 1e5));
      }
      return moves;
    };
    EXPECT_EQ(moving(before), moving(after));
  }
}

TEST(ReplanPrusaSlicer, PlannedAgainChangesNothingAndSaysSo) {
  const Replanned again = replanned_text(bar_replanned());
  EXPECT_FALSE(again.changed);
  EXPECT_EQ(again.text, bar_replanned());
}

TEST(ReplanPrusaSlicer, IsTheSameForAnyNumberOfThreads) {
  EXPECT_EQ(bar_replanned(), replanned_text(bar(), {.threads = 3}).text);
}

TEST(ReplanPrusaSlicer, KeepsStartAndEndToTheLetter) {
  const std::string& out = bar_replanned();
  const std::size_t first = bar().find(";LAYER_CHANGE"), line = bar().find('\n') + 1;
  EXPECT_EQ(out.substr(0, line), bar().substr(0, line));
  const std::size_t ours = out.find('\n', line) + 1;
  EXPECT_TRUE(out.substr(line).starts_with("; replanned by cleancolor "));
  EXPECT_EQ(out.substr(ours, first - line), bar().substr(line, first - line));
  const std::string end = bar().substr(bar().rfind("\nM107"), bar().find("; filament used") - bar().rfind("\nM107"));
  EXPECT_NE(out.find(end), out.npos);
  const std::size_t config = bar().find("; prusaslicer_config = begin");
  EXPECT_TRUE(out.ends_with(bar().substr(config)));
}

/// Where each outer wall begins and ends: z, then both places, the smaller first.
std::multiset<std::array<double, 5>> seams_of(const std::string& text) {
  const GcodePrint print = read_gcode(text, "");
  std::multiset<std::array<double, 5>> seams;
  for (std::size_t i = 1; i < print.moves.size(); ++i) {
    const auto is_outer = [&](std::size_t k) {
      return lays_plastic(print, k) && print.moves[k].role == Role::external_perimeter;
    };
    if (!is_outer(i) || is_outer(i - 1)) continue;
    std::size_t last = i;
    while (last + 1 < print.moves.size() && is_outer(last + 1)) ++last;
    Vec3 a = print.moves[i - 1].to_mm, b = print.moves[last].to_mm;
    if (std::pair(b.x, b.y) < std::pair(a.x, a.y)) std::swap(a, b);
    seams.insert({a.z, a.x, a.y, b.x, b.y});
  }
  return seams;
}

TEST(ReplanPrusaSlicer, LeavesSeamsWhereTheyAreOnRequest) {
  const std::string kept = replanned_text(bar(), {.keeps_seams = true}).text;
  ASSERT_GE(seams_of(bar()).size(), 12u);
  EXPECT_EQ(seams_of(kept), seams_of(bar()));
  EXPECT_NE(seams_of(bar_replanned()), seams_of(bar()));
  EXPECT_NE(kept.find("planned, seams kept"), kept.npos);
}

TEST(ReplanPrusaSlicer, TellsTheTimeThatItTakesNow) {
  const Replanned result = replanned_text(bar());
  const double before = read_gcode(bar(), "").facts.told_time_s, after = read_gcode(result.text, "").facts.told_time_s;
  EXPECT_NEAR(after / before, result.time_s / result.old_time_s, 0.01);
}

TEST(ReplanPrusaSlicer, OneObjectMayBeCompleteBeforeAnother) {
  EXPECT_TRUE(replanned_text(replaced(bar(), "; complete_objects = 0", "; complete_objects = 1")).changed);
}

TEST(ReplanPrusaSlicer, TellsTheRemainingTimeOfTheQuietModeAnew) {
  const std::size_t layers = bar().find(";LAYER_CHANGE");
  const std::string begun = with_line(with_line(bar(), "M73 Q0 S12", "G28"), "M73 P0 R6", "G28");
  const std::string text = with_line(with_line(begun, "M73 Q50 S6", ";TYPE:", layers), "M73 P50 R3", ";TYPE:", layers);
  const std::string out = replanned_text(text).text;
  const GcodePrint print = read_gcode(out, "");
  const auto minutes = [&](const std::string& line, char word) {
    const std::size_t at = out.find(word, out.find('\n' + line, out.find(";LAYER_CHANGE")) + 6);
    return std::stod(out.substr(at + 1));
  };
  EXPECT_NEAR(minutes("M73 Q", 'S'), 2 * minutes("M73 P", 'R'), 1);
  EXPECT_GT(minutes("M73 Q", 'S'), 3);
}

TEST(ReplanPrusaSlicer, DrivesOnWaysAsTheFileDoes) {
  // Before each way another acceleration, before each road its own.
  std::string text, line;
  std::istringstream in(bar());
  bool begun = false, lays = false;
  while (std::getline(in, line)) {
    begun = begun || line == ";LAYER_CHANGE";
    const bool moves = line.starts_with("G1 X") || line.starts_with("G1 Y"),
               prints = moves && line.find(" E") != line.npos;
    if (begun && moves && prints != lays) text += prints ? "M204 S900\n" : "M204 S1500\n";
    if (begun && moves) lays = prints;
    text += line + "\n";
  }
  const std::string out = replanned_text(text).text;
  double now = 0;
  std::map<std::pair<bool, double>, int> driven;
  std::istringstream again(out.substr(out.find(";LAYER_CHANGE")));
  while (std::getline(again, line)) {
    if (line.starts_with("M204 S")) now = std::stod(line.substr(6));
    if (line.starts_with("G1 X") || line.starts_with("G1 Y")) ++driven[{line.find(" E") != line.npos, now}];
  }
  EXPECT_EQ(driven[std::pair(true, 1500.)], 0);
  EXPECT_GT(driven[std::pair(false, 1500.)], 20);
  EXPECT_LT(driven[std::pair(false, 900.)], driven[std::pair(false, 1500.)] / 4);  // over gaps of seams alone
}

TEST(ReplanPrusaSlicer, TellsTheRemainingTimeAnew) {
  const std::size_t layers = bar().find(";LAYER_CHANGE");
  const std::string text = with_line(with_line(bar(), "M73 P50 R3", ";TYPE:", layers), "M73 P0 R6", "G28");
  const std::string out = replanned_text(text).text;
  std::vector<int> percent;
  for (std::size_t at = out.find("\nM73 P"); at != out.npos; at = out.find("\nM73 P", at + 1))
    percent.push_back(std::atoi(out.c_str() + at + 6));
  EXPECT_EQ(percent.size(), 9u);  // in the start code, and one a layer
  EXPECT_TRUE(std::ranges::is_sorted(percent));
  EXPECT_EQ(percent.front(), 0);
  EXPECT_GT(percent.back(), 80);
  EXPECT_LT(percent.back(), 100);
}

TEST(ReplanPrusaSlicer, PrintsWithRelativeEAsWithCounts) {
  const std::string relative = replanned_text(with_relative_e(bar())).text;
  EXPECT_EQ(relative.find("M82"), relative.npos);
  const auto counts = part_filament(read_gcode(bar_replanned(), "")), lengths = part_filament(read_gcode(relative, ""));
  for (const auto& [what, mm] : counts) EXPECT_NEAR(lengths.at(what), mm, 1e-4 * mm + 1e-3);
}

TEST(ReplanPrusaSlicer, KeepsLabelsAroundTheirRoads) {
  const std::string label = "; printing object bar id:0 copy 0";
  std::string text = with_line(bar(), label, ";TYPE:Perimeter", bar().find(";LAYER_CHANGE"));
  const std::size_t second = text.find(";LAYER_CHANGE", text.find(label));
  text.insert(second, "; stop printing object bar id:0 copy 0\n");
  const std::string out = replanned_text(text).text;
  const std::size_t begins = out.find(label), ends = out.find("; stop printing object bar");
  EXPECT_LT(begins, ends);
  EXPECT_EQ(out.substr(begins, ends - begins).find(";RAMPART_WALL"), out.npos);  // it belongs to no object
}

TEST(ReplanPrusaSlicer, StrokesInsideThePartBelongToItsObject) {
  const std::string begin = "; printing object bar id:0 copy 0", end = "; stop printing object bar id:0 copy 0";
  std::string text;
  std::istringstream in(bar());
  for (std::string line, type; std::getline(in, line);) {
    const bool part = line.starts_with(";TYPE:") && line != ";TYPE:Skirt/Brim";
    if (line.starts_with(";LAYER_CHANGE") && !type.empty()) text += end + "\n", type.clear();
    if (part && type.empty()) text += begin + "\n", type = line;
    text += line + "\n";
  }
  const std::string out = replanned_text(text).text;
  int strokes = 0;
  for (std::size_t at = out.find(";REFILL_START"); at != out.npos; at = out.find(";REFILL_START", at + 1), ++strokes) {
    const std::size_t begun = out.rfind(begin, at), ended = out.rfind(end, at);
    EXPECT_TRUE(begun != out.npos && (ended == out.npos || begun > ended)) << "at " << at;
  }
  EXPECT_GE(strokes, 16);
}

TEST(ReplanPrusaSlicer, PrintsEachRoadWithItsFanAndAcceleration) {
  const std::string text = with_line(with_line(bar(), "M106 S77", ";TYPE:Solid infill", bar().find(";LAYER_CHANGE")),
                                     "M204 S800", ";TYPE:Solid infill", bar().find(";LAYER_CHANGE"));
  const std::string back = with_line(text, "M106 S10", "T1", text.find("M106 S77"));
  const auto under = [](const std::string& all) {  // filament under each fan, 1e-5 mm
    std::map<std::string, long> sums;
    const GcodePrint print = read_gcode(all, "");
    std::string fan;
    std::size_t move = 0;
    for (std::size_t at = 0; at < all.size(); at = all.find('\n', at) + 1) {
      if (all.compare(at, 4, "M106") == 0 || all.compare(at, 4, "M107") == 0)
        fan = all.substr(at, all.find('\n', at) - at);
      for (; move < print.moves.size() && print.moves[move].offset <= at; ++move)
        if (lays_plastic(print, move) && !is_auxiliary(print.moves[move].role))
          sums[fan] += std::lround(print.moves[move].filament_mm * 1e5);
    }
    return sums;
  };
  const auto before = under(back), after = under(replanned_text(back).text);
  for (const auto& [fan, filament] : before)
    EXPECT_NEAR(double(after.at(fan)), double(filament), 1e-4 * double(filament) + 50) << fan;
}

TEST(ReplanPrusaSlicer, AddsTheRampartAloneWhereAskedFor) {
  const std::string out = replanned_text(bar(), {.protection = ReplanProtection::rampart}).text;
  EXPECT_NE(out.find(": order and travel plain, rampart added"), out.npos);
  EXPECT_NE(out.find(";RAMPART_WALL"), out.npos);
}

TEST(ReplanPrusaSlicer, GoesWithoutARampartWhereItsTimeCountsMore) {
  Config hasty;
  hasty.weight_time = 10;
  Warned warned;
  const Replanned result = replanned_text(bar(), {.printer = hasty}, warned.progress);
  EXPECT_TRUE(result.changed);
  EXPECT_FALSE(result.has_rampart);
  EXPECT_LT(result.time_s, result.old_time_s);
  ASSERT_FALSE(warned.warnings.empty());
  EXPECT_NE(warned.warnings.back().find("without"), std::string::npos);
}

TEST(ReplanPrusaSlicer, SmearsAnEighthOfIt) {
  const Cleanness before = cleanness(bar()), after = cleanness(bar_replanned());
  ASSERT_GT(before.smear_mm3, 1);
  EXPECT_LE(after.smear_mm3, std::max(0.2, before.smear_mm3 / 8));
}

TEST(ReplanPrusaSlicer, RefusesWithLineAndReasonWhatItDoesNotKnowForSure) {
  const std::size_t layers = bar().find(";LAYER_CHANGE", bar().find(";LAYER_CHANGE") + 1);
  const auto among = [&](const std::string& line) { return with_line(bar(), line, ";TYPE:", layers); };
  EXPECT_ERROR(replanned_text(among("G2 X1 Y1 I5 J5 E1")), "arc");
  EXPECT_ERROR(replanned_text(among("M600")), "M600");
  EXPECT_ERROR(replanned_text(among("PAUSE_HERE")), "PAUSE_HERE");
  EXPECT_ERROR(replanned_text(among("PAUSE_HERE")), "in.gcode:");
  EXPECT_ERROR(replanned_text(among("G4 P5")), "G4 P5");
  EXPECT_ERROR(replanned_text(among("M83")), "M83");
  EXPECT_ERROR(replanned_text(among("G92 X5")), "G92");
  EXPECT_ERROR(replanned_text(among("M104 S200")), "without a tool");
  EXPECT_ERROR(replanned_text(among("G11")), "firmware");
  EXPECT_ERROR(replanned_text(replaced(bar(), "; spiral_vase = 0", "; spiral_vase = 1")), "vase");
  EXPECT_ERROR(replanned_text(among(";WIPE_SCRIPT_BEGIN")), "clean_between_layers");
  EXPECT_ERROR(replanned_text(replaced(bar(), "generated by PrusaSlicer", "G-Code generated by Simplify3D(R)")),
               "made by Simplify3D");
  EXPECT_ERROR(replanned_text(replaced(bar(), "generated by PrusaSlicer", "generated by cleancolor")), "already");
}

TEST(ReplanPrusaSlicer, RefusesDamagedFilesOrPlansThemWhole) {
  EXPECT_GT(planned_of_damaged(bar(), 60), 5);
}

TEST(ReplanPrusaSlicer, WithoutRoomForARampartDoesWithoutAndWarns) {
  Warned warned;
  const Replanned result = replanned_text(
      replaced(bar(), "; bed_shape = ", "; bed_shape = -21x-9,21x-9,21x9,-21x9\n; old = "), {}, warned.progress);
  EXPECT_EQ(result.text.find(";RAMPART_WALL"), result.text.npos);
  ASSERT_FALSE(warned.warnings.empty());
  EXPECT_NE(warned.warnings.back().find("without a rampart"), std::string::npos);
}

/// The models of the paper through PrusaSlicer itself, where it and they are at hand.
struct Model {
  const char *name, *first, *second;
  double smear;  // share that may be left
};
class ReplanModels : public testing::TestWithParam<Model> {};

TEST_P(ReplanModels, ComeOutClean) {
  const std::string shared = CLEANCOLOR_SHARED, script = shared + "/peers/slice-prusa.sh";
  if (!std::filesystem::exists(script) || std::system("command -v prusa-slicer > /dev/null") != 0)
    GTEST_SKIP() << "needs PrusaSlicer and " << script;
  const Model& m = GetParam();
  SKIP_LARGE_WHERE_SANITIZED(m.name);
  const TestFolder folder;
  const std::string out = folder.path("sliced.gcode");
  const std::string command =
      fmt::format("'{0}' '{1}/models/paper/{2}' '{1}/models/paper/{3}' '{4}' plain > /dev/null 2>&1", script, shared,
                  m.first, m.second, out);
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string text = file_text(out), after = replanned_text(text, {.threads = 2}).text;
  const Cleanness sliced = cleanness(text), clean = cleanness(after);
  EXPECT_LE(clean.smear_mm3, std::max(0.2, sliced.smear_mm3 * m.smear));
  EXPECT_LE(clean.hole_mm3, sliced.hole_mm3 / 5);
  EXPECT_LE(clean.time_s, 1.3 * sliced.time_s);
}

INSTANTIATE_TEST_SUITE_P(
    Paper, ReplanModels,
    testing::Values(Model{"world", "two-color-world-50mm_ocean.stl", "two-color-world-50mm_land.stl", 1. / 30},
                    Model{"robot_ice", "robot-ice_robot.stl", "robot-ice_crust.stl", 1. / 8},
                    Model{"crystal", "crystal_black.stl", "crystal_white.stl", 1. / 40},
                    Model{"spot_cow", "spot-cow_dark.stl", "spot-cow_light.stl", 1. / 12},
                    Model{"dragon_heart", "dragon-heart_body.stl", "dragon-heart_accent.stl", 1. / 15},
                    Model{"rose", "rose_green.stl", "rose_petals.stl", 1. / 40},
                    Model{"four_cones", "4-cones_black.stl", "4-cones_white.stl", 1. / 40}),
    [](const testing::TestParamInfo<Model>& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace cleancolor
