// Files of Cura: the fixture is two bars of two colours, 36 x 8 mm each, side by side in 6 layers, by CuraEngine 4.13.0
// for nozzles 33 mm apart whose offset is in the coordinates of T1.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "replan/cura.hpp"
#include "replanning.hpp"
#include "sanitized.hpp"

namespace cleancolor {
namespace {

using namespace test;

MachineRequest apart(OffsetsIn in = OffsetsIn::slicer) {
  return {.nozzle_offset_mm = {{0, 0}, {33, 0}}, .offsets_in = in};
}
const std::string& cura_bar() {
  static const std::string text = fixture("cura.gcode");
  return text;
}
/// Two bars of 12 x 4 mm with ooze shield and prime tower.
const std::string& cura_tower() {
  static const std::string text = fixture("cura-shield-tower.gcode");
  return text;
}
Replanned cura_replanned(const std::string& text, const ReplanRequest& request = {}, const Progress& progress = {}) {
  return replanned_text(text, request, progress, apart());
}
const std::string& cura_bar_replanned() {
  static const std::string text = cura_replanned(cura_bar()).text;
  return text;
}

/// Where the nozzle is after each move along X or Y, and how much filament goes with it or before it on the spot.
std::vector<std::tuple<std::int64_t, std::int64_t, std::int64_t>> ways_of(const std::string& text) {
  const GcodePrint print = read_gcode(text, "");
  std::vector<std::tuple<std::int64_t, std::int64_t, std::int64_t>> ways;
  double filament = 0;
  for (std::size_t i = 0; i < print.moves.size(); ++i) {
    const GcodeMove& m = print.moves[i];
    filament += m.filament_mm;
    if (i > 0 && m.to_mm.x == print.moves[i - 1].to_mm.x && m.to_mm.y == print.moves[i - 1].to_mm.y) continue;
    ways.emplace_back(std::llround(m.to_mm.x * 1e3), std::llround(m.to_mm.y * 1e3), std::llround(filament * 1e5));
    filament = 0;
  }
  return ways;
}

TEST(ReplanCura, ReadsTheConfigurationOffTheMoves) {
  const GcodePrint print = read_gcode(cura_bar(), "");
  const Config config = cura_config(print, audit_machine(print, apart()), nullptr);
  EXPECT_NEAR(config.travel_speed_mm_s, 120, 1e-6);
  EXPECT_NEAR(config.travel_speed_z_mm_s, 10, 1e-6);
  EXPECT_NEAR(config.perimeter_speed_mm_s, 30, 1e-6);
  EXPECT_NEAR(config.solid_infill_speed.value, 60, 1e-6);
  EXPECT_NEAR(config.layer_height_mm, 0.3, 1e-6);
  EXPECT_NEAR(config.first_layer_height_mm, 0.3, 1e-6);
  // Cura's roads are rectangles of 0.4 mm; rounded at their sides they are as much wider.
  EXPECT_NEAR(config.external_perimeter_extrusion_width.value, 0.4 + 0.3 * (1 - std::numbers::pi / 4), 0.011);
  EXPECT_FALSE(config.external_perimeters_first);
  ASSERT_EQ(config.extruders.size(), 2u);
  for (const Extruder& e : config.extruders) {
    EXPECT_NEAR(e.retract_length_mm, 0.5, 1e-6);
    EXPECT_NEAR(e.retract_length_toolchange_mm, 1, 1e-6);
    EXPECT_NEAR(e.retract_speed_mm_s, 25, 1e-6);
    EXPECT_EQ(e.retract_lift_mm, 0);
  }
  for (const Vec2 corner : config.bed_shape_mm) EXPECT_GE(std::abs(corner.x), 20);
}

TEST(ReplanCura, TakesTheBedOfThePrinterWhereOneIsNamed) {
  const GcodePrint print = read_gcode(cura_bar(), "");
  Config printer;
  printer.bed_shape_mm = {{-50, -50}, {50, -50}, {50, 50}, {-50, 50}};
  EXPECT_EQ(cura_config(print, audit_machine(print, apart()), &printer).bed_shape_mm, printer.bed_shape_mm);
}

TEST(ReplanCura, WarnsThatTheBedIsTakenForGranted) {
  Warned warned;
  cura_replanned(cura_bar(), {}, warned.progress);
  ASSERT_FALSE(warned.warnings.empty());
  EXPECT_NE(warned.warnings.front().find("--printer"), std::string::npos);
}

TEST(ReplanCura, DoesNotWarnOfTheBedWhereNoRampartIsAdded) {
  Warned warned;
  cura_replanned(cura_tower(), {.protection = ReplanProtection::none}, warned.progress);
  EXPECT_TRUE(warned.warnings.empty());
}

TEST(ReplanCura, KeepsFilamentAndRoadsOfEachTool) {
  const GcodePrint before = read_gcode(cura_bar(), ""), after = read_gcode(cura_bar_replanned(), "");
  const auto old_mm = part_filament(before), new_mm = part_filament(after);
  ASSERT_EQ(old_mm.size(), new_mm.size());
  for (const auto& [what, mm] : old_mm) EXPECT_NEAR(new_mm.at(what), mm, 1e-4 * mm) << role_name(what.second);
  double missing_mm = 0, added_mm = 0;
  int missing = 0;
  const auto old_roads = part_roads(before), new_roads = part_roads(after);
  for (const auto& [road, times] : old_roads) {
    const auto found = new_roads.find(road);
    const int there = found == new_roads.end() ? 0 : found->second;
    EXPECT_LE(there, times);
    if (there < times) ++missing, missing_mm += length_mm(road);
  }
  for (const auto& [road, times] : new_roads)
    if (!old_roads.contains(road)) added_mm += length_mm(road);
  // Two walls of two colours, and the loop around their skins, in six layers: each cut once.
  EXPECT_LE(missing, 3 * 2 * 6);
  EXPECT_NEAR(added_mm, missing_mm, 0.01 * 3 * 2 * 6);
}

TEST(ReplanCura, WithOrderAndTravelKeptMakesTheSameMoves) {
  const auto before = ways_of(cura_bar()), after = ways_of(cura_replanned(cura_bar(), {.keeps_order = true}).text);
  const auto [old_way, new_way] = std::ranges::mismatch(before, after);
  EXPECT_TRUE(old_way == before.end() && new_way == after.end())
      << "after " << old_way - before.begin() << " ways of " << before.size();
}

/// Place, filament in 1e-5 mm and tool of each move that drives or feeds.
std::vector<std::tuple<std::int64_t, std::int64_t, std::int64_t, int>> moves_of(const std::string& text) {
  const GcodePrint print = read_gcode(text, "");
  std::vector<std::tuple<std::int64_t, std::int64_t, std::int64_t, int>> moves;
  Vec2 at;
  for (const GcodeMove& m : print.moves) {
    const std::int64_t filament = std::llround(m.filament_mm * 1e5);
    if (const Vec2 to{m.to_mm.x, m.to_mm.y}; filament != 0 || std::exchange(at, to) != to)
      moves.emplace_back(std::llround(m.to_mm.x * 1e3), std::llround(m.to_mm.y * 1e3), filament, int(m.feeds));
  }
  return moves;
}

TEST(ReplanCura, WithOrderAndTravelKeptFeedsInAsManyPartsAsTheFile) {
  std::mt19937 draw(7);
  for (int round = 0; round < 20; ++round) {
    std::istringstream lines(cura_bar());
    std::string text;
    for (std::string line; std::getline(lines, line);) {
      const bool on_the_spot = line.starts_with("G1 F1500 E") && !text.ends_with("G92 E0\n");
      const double e = on_the_spot ? std::stod(line.substr(10)) : 0;
      const int kind = on_the_spot && text.find(";LAYER:0") != text.npos ? int(draw() % 4) : 0;
      const auto feed_to = [&](double to) { text += fmt::format("G1 F1500 E{:.5f}\n", to); };
      if (kind == 1) feed_to(e - 0.3), feed_to(e - 0.1);  // in three parts
      text += line + "\n";
      if (kind == 2) feed_to(e - 0.2), feed_to(e);  // and once more
    }
    SCOPED_TRACE(round);
    ASSERT_NE(text, cura_bar());
    const auto before = moves_of(text), after = moves_of(cura_replanned(text, {.keeps_order = true}).text);
    const auto [old_move, new_move] = std::ranges::mismatch(before, after);
    ASSERT_TRUE(old_move == before.end() && new_move == after.end())
        << "after " << old_move - before.begin() << " moves of " << before.size();
  }
}

TEST(ReplanCura, PlannedAgainChangesNothing) {
  const Replanned again = cura_replanned(cura_bar_replanned());
  EXPECT_FALSE(again.changed);
  EXPECT_EQ(again.text, cura_bar_replanned());
}

TEST(ReplanCura, IsTheSameForAnyNumberOfThreads) {
  EXPECT_EQ(cura_bar_replanned(), cura_replanned(cura_bar(), {.threads = 3}).text);
}

TEST(ReplanCura, SmearsAnEighthOfIt) {
  const Cleanness before = cleanness(cura_bar(), apart()), after = cleanness(cura_bar_replanned(), apart());
  ASSERT_GT(before.smear_mm3, 1);
  EXPECT_LE(after.smear_mm3, std::max(0.2, before.smear_mm3 / 8));
}

TEST(ReplanCura, SpeaksAsCuraDoes) {
  const std::string& out = cura_bar_replanned();
  EXPECT_NE(out.find(";TYPE:SKIRT\n;MESH:NONMESH\n;RAMPART_WALL"), out.npos);
  EXPECT_NE(out.find("\nG0 X"), out.npos);
  EXPECT_EQ(out.find(";WIDTH:"), out.npos);
  EXPECT_EQ(out.find(";TYPE:Skirt/Brim"), out.npos);
  const std::size_t layers = out.find(";LAYER:0"), first = cura_bar().find(";LAYER:0");
  const std::size_t ours = out.find('\n', out.find("; replanned by")) + 1, line = cura_bar().find('\n') + 1;
  EXPECT_EQ(out.substr(ours, layers - ours), cura_bar().substr(line, first - line));
  EXPECT_TRUE(out.ends_with(cura_bar().substr(cura_bar().rfind("\nM140 S0\nM104 S0 T0"))));
}

TEST(ReplanCura, TellsTheTimeSoFarAnew) {
  const Replanned result = cura_replanned(replaced(cura_bar(), ";TIME:6666", ";TIME:310"));
  std::vector<double> told;
  for (std::size_t at = result.text.find(";TIME_ELAPSED:"); at != result.text.npos;
       at = result.text.find(";TIME_ELAPSED:", at + 1))
    told.push_back(std::atof(result.text.c_str() + at + 14));
  EXPECT_EQ(told.size(), 6u);
  EXPECT_TRUE(std::ranges::is_sorted(told));
  const double longer = result.time_s / result.old_time_s, before_s = read_gcode(cura_bar(), "").facts.told_time_s;
  EXPECT_NEAR(told.back() / before_s, longer, 0.01);
  EXPECT_NEAR(std::atof(result.text.c_str() + result.text.find(";TIME:") + 6), 310 * longer, 1);
  // The engine alone writes the same number each time.
  EXPECT_NE(cura_bar_replanned().find(";TIME:6666\n"), std::string::npos);
}

/// Lines that set temperatures in the layers, with the tool in use before each.
std::vector<std::string> heater_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text.substr(text.find(";LAYER:0")));
  for (std::string line; std::getline(in, line) && line != "M140 S0";)
    if (line.starts_with("M104") || line.starts_with("M109") || (line[0] == 'T' && line.size() == 2))
      lines.push_back(line);
  return lines;
}

TEST(ReplanCura, SwitchesAToolOffAfterItsLastUse) {
  const std::vector<std::string> lines = heater_lines(cura_bar_replanned());
  ASSERT_GE(lines.size(), 2u);
  EXPECT_TRUE(lines.back() == "M104 T1 S0" || lines.back() == "M104 T0 S0") << lines.back();
  EXPECT_NE(lines[lines.size() - 2], fmt::format("T{}", lines.back()[6]));
  EXPECT_EQ(std::ranges::count_if(lines, [](const std::string& l) { return l[0] == 'M'; }), 1);
}

/// The bar with T1 cooled down while T0 prints, and heated up again some lines before it is used.
std::string with_standby() {
  std::string text = replaced(cura_bar(), "M109 T1 S230", "M109 T1 S175"), out;
  std::istringstream in(text);
  int layer = -1, until_hot = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(";LAYER:")) ++layer;
    out += line + "\n";
    if (layer < 0) continue;
    if (line == "T1") out += "G92 E0\nM105\nM109 S230\n";
    if (line == "T0" && layer < 5) out += "M104 T1 S175\n", until_hot = 60;
    if (until_hot > 0 && --until_hot == 0) out += "M104 T1 S230\n";
  }
  return out;
}

TEST(ReplanCura, CoolsAndHeatsIdleToolsAsTheFileDoes) {
  const std::vector<std::string> lines = heater_lines(cura_replanned(with_standby()).text);
  // Of T1: told to be hot before it is used, hot when it is, cool after it was; off in the end.
  int waits = 0, cooled = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i] == "M109 S230") {
      ++waits;
      ASSERT_GT(i, 0u);
      EXPECT_EQ(lines[i - 1], "T1");
      EXPECT_TRUE(i >= 2 && lines[i - 2] == "M104 T1 S230");
    }
    if (lines[i] != "M104 T1 S175") continue;
    ++cooled;
    EXPECT_EQ(lines[i - 1], "T0");
  }
  EXPECT_GE(waits, 2);
  EXPECT_GE(waits, cooled);
  EXPECT_GE(cooled, 1);
}

TEST(ReplanCura, PrintsWithOffsetsInTheFirmwareAlike) {
  std::string text;
  std::istringstream in(cura_bar());
  int tool = 0;
  bool begun = false;
  for (std::string line; std::getline(in, line);) {
    begun = begun || line.starts_with(";LAYER:");
    if (line == "T0" || line == "T1") tool = line[1] - '0';
    const std::size_t x = line.find(" X");
    if (begun && tool == 1 && line[0] == 'G' && x != line.npos) {
      std::size_t length = 0;
      const double at = std::stod(line.substr(x + 2), &length);
      line.replace(x + 2, length, fmt::format("{:.3f}", at + 33));
    }
    text += line + "\n";
  }
  const Replanned result = replanned_text(text, {}, {}, apart(OffsetsIn::firmware));
  const Cleanness slicer = cleanness(cura_bar_replanned(), apart()),
                  firmware = cleanness(result.text, apart(OffsetsIn::firmware));
  EXPECT_NEAR(firmware.smear_mm3, slicer.smear_mm3, 0.1);
  EXPECT_NEAR(firmware.time_s, slicer.time_s, 0.05 * slicer.time_s);
}

TEST(ReplanCura, ChangesToolsByM135AsTheFileDoes) {
  std::string text;
  std::istringstream in(cura_bar());
  bool begun = false;
  for (std::string line; std::getline(in, line);) {
    begun = begun || line.starts_with(";LAYER:");
    if (begun && line[0] == 'T') line = "M135 " + line;
    text += line + "\n";
    if (line.starts_with("M135")) text += "G92 E0\nM104 S230\nM116\n";
  }
  const std::string out = cura_replanned(text).text;
  EXPECT_NE(out.find("G92 E0\nM135 T1\nG92 E0\nM116\n"), out.npos);
  EXPECT_EQ(out.find("\nT1\n"), out.npos);
  const auto before = part_filament(read_gcode(cura_bar(), "")), after = part_filament(read_gcode(out, ""));
  for (const auto& [what, mm] : before) EXPECT_NEAR(after.at(what), mm, 1e-4 * mm);
}

/// Of each layer: tools in their order, and whether the tower is what each of them prints first.
std::vector<std::vector<std::pair<int, bool>>> tools_of(const std::string& text) {
  const GcodePrint print = read_gcode(text, "");
  std::vector<std::vector<std::pair<int, bool>>> layers(print.layers.size());
  int tool = -1;
  std::uint32_t layer = 0;
  for (std::size_t i = 0; i < print.moves.size(); ++i) {
    const GcodeMove& move = print.moves[i];
    if (!lays_plastic(print, i)) continue;
    if (move.tool != tool || layer != move.layer)
      layers[move.layer].emplace_back(move.tool, move.tool != tool && move.role == Role::wipe_tower);
    tool = move.tool, layer = move.layer;
  }
  return layers;
}

TEST(ReplanCura, KeepsShieldAndTowerWhereTheyAre) {
  const std::string out = cura_replanned(cura_tower()).text;
  EXPECT_EQ(out.find(";RAMPART_WALL"), out.npos);
  EXPECT_EQ(tools_of(cura_tower()), tools_of(out));
  const auto before = kept_filament(read_gcode(cura_tower(), "")), after = kept_filament(read_gcode(out, ""));
  ASSERT_EQ(before.size(), after.size());
  EXPECT_TRUE(before.contains({1, Role::wipe_tower}));
  for (const auto& [what, mm] : before) EXPECT_NEAR(after.at(what), mm, 1e-4 * mm + 1e-3) << role_name(what.second);
}

TEST(ReplanCura, ShieldAndTowerAreRemovedOnRequest) {
  const Replanned result = cura_replanned(cura_tower(), {.removes_shield = true, .removes_tower = true});
  EXPECT_NE(result.text.find(";RAMPART_WALL"), result.text.npos);
  EXPECT_EQ(result.text.find(";TYPE:PRIME-TOWER"), result.text.npos);
  EXPECT_GT(result.removed_mm3, 1);
  const auto before = part_filament(read_gcode(cura_tower(), "")), after = part_filament(read_gcode(result.text, ""));
  ASSERT_EQ(before.size(), after.size());
  for (const auto& [what, mm] : before) EXPECT_NEAR(after.at(what), mm, 1e-4 * mm);
}

TEST(ReplanCura, WithShieldAndTowerKeptMakesTheSameMoves) {
  const auto before = ways_of(cura_tower()), after = ways_of(cura_replanned(cura_tower(), {.keeps_order = true}).text);
  const auto [old_way, new_way] = std::ranges::mismatch(before, after);
  EXPECT_TRUE(old_way == before.end() && new_way == after.end())
      << "after " << old_way - before.begin() << " ways of " << before.size();
}

/// Its last layer has nothing but the tower.
std::string with_tower_above() {
  std::string text = cura_tower();
  for (std::size_t at = text.find(";LAYER:5"); (at = text.find(";TYPE:", at)) != text.npos; ++at)
    text.replace(at, text.find('\n', at) - at, ";TYPE:PRIME-TOWER");
  return text;
}

TEST(ReplanCura, RemovesNoTowerThatGoesOnAboveThePart) {
  EXPECT_ERROR(cura_replanned(with_tower_above(), {.removes_tower = true}), "above the part");
}

TEST(ReplanCura, LeavesLayersOfTheTowerAloneAboveThePartAsTheyAre) {
  const std::string text = with_tower_above();
  const std::size_t top = text.find(";LAYER:5");
  const std::string out = cura_replanned(text).text;
  const auto before = kept_filament(read_gcode(text, "")), after = kept_filament(read_gcode(out, ""));
  for (const auto& [what, mm] : before) EXPECT_NEAR(after.at(what), mm, 1e-4 * mm + 1e-3) << role_name(what.second);
  const std::size_t from = text.find('\n', text.find(";TYPE:", top)), to = text.rfind("\nG92 E0");
  EXPECT_NE(out.find(text.substr(from, std::min(to, text.find(";TIME_ELAPSED", top)) - from)), out.npos);
}

TEST(ReplanCura, TellsABrimFromTheWallsBesideIt) {
  const std::string text = replaced(cura_bar(), ";TYPE:WALL-INNER", ";TYPE:SKIRT");
  const std::string out = cura_replanned(text).text;
  const auto before = kept_filament(read_gcode(text, "")), after = kept_filament(read_gcode(out, ""));
  const ToolRole brim{0, Role::skirt_brim};
  ASSERT_TRUE(before.contains(brim));
  EXPECT_GE(after.at(brim), before.at(brim) - 1e-3);
  EXPECT_NE(out.find(";RAMPART_WALL"), out.npos);
}

/// Lines left out, said twice, swapped or with another letter: whatever comes in is refused, or planned whole.
TEST(ReplanCura, RefusesDamagedFilesOrPlansThemWhole) {
  const auto replan = [](const std::string& text) { return cura_replanned(text); };
  EXPECT_GT(planned_of_damaged(cura_bar(), 60, 0, replan), 5);
}

TEST(ReplanCura, RefusesWithLineAndReasonWhatItDoesNotKnowForSure) {
  const std::size_t layers = cura_bar().find(";LAYER:1");
  const auto among = [&](const std::string& line) { return with_line(cura_bar(), line, ";TYPE:", layers); };
  EXPECT_ERROR(cura_replanned(among("M600")), "M600");
  EXPECT_ERROR(cura_replanned(among("M600")), "in.gcode:");
  EXPECT_ERROR(cura_replanned(among("PAUSE_HERE")), "PAUSE_HERE");
  EXPECT_ERROR(cura_replanned(among("G10")), "firmware");
  EXPECT_ERROR(cura_replanned(among("G28 X")), "G28");
  EXPECT_ERROR(cura_replanned(replaced(cura_bar(), ";FLAVOR:Marlin", ";FLAVOR:UltiGCode")), "mm3");
}

TEST(ReplanCura, AsksHowThickTheFilamentIsWhereWallsWouldBeTooThin) {
  std::string text;
  std::istringstream in(cura_bar());
  for (std::string line; std::getline(in, line);) {
    const std::size_t e = line.find(" E");
    if (line[0] == 'G' && e != line.npos) {
      std::size_t length = 0;
      const double told = std::stod(line.substr(e + 2), &length);
      line.replace(e + 2, length, fmt::format("{:.5f}", told * 1.75 * 1.75 / 2.85 / 2.85));
    }
    text += line + "\n";
  }
  EXPECT_ERROR(cura_replanned(text), "filament_diameter = 2.85");
  const std::string told = with_line(text, "; filament_diameter = 2.85", ";TIME:");
  EXPECT_NE(cura_replanned(told).text.find(";RAMPART_WALL"), std::string::npos);
}

/// The models of the paper through CuraEngine itself, where it and they are at hand.
TEST(ReplanCura, ModelsOfThePaperComeOutClean) {
  const std::string shared = CLEANCOLOR_SHARED, script = shared + "/peers/slice-cura.sh";
  if (!std::filesystem::exists(script) || std::system("command -v CuraEngine > /dev/null") != 0)
    GTEST_SKIP() << "needs CuraEngine and " << script;
  if (sanitized) GTEST_SKIP() << "takes minutes under sanitizers";
  const TestFolder folder;
  const std::string out = folder.path("sliced.gcode");
  const std::string command = fmt::format(
      "OFFSET=33,0 '{0}' '{1}/models/paper/two-color-world-50mm_ocean.stl' "
      "'{1}/models/paper/two-color-world-50mm_land.stl' '{2}' plain > /dev/null 2>&1",
      script, shared, out);
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string text = file_text(out), after = cura_replanned(text, {.threads = 2}).text;
  const Cleanness sliced = cleanness(text, apart()), clean = cleanness(after, apart());
  EXPECT_LE(clean.smear_mm3, std::max(0.2, sliced.smear_mm3 / 8));
  EXPECT_LE(clean.hole_mm3, sliced.hole_mm3 / 4);
  EXPECT_LE(clean.time_s, 1.3 * sliced.time_s);
}

}  // namespace
}  // namespace cleancolor
