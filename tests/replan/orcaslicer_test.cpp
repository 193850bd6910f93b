// Files of OrcaSlicer and BambuStudio, in both spellings: the bars of the files of PrusaSlicer in their words
// (bench/orca_dialect.py), lifted by 0.4 mm on the way.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "replanning.hpp"

namespace cleancolor {
namespace {

using namespace test;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string with_option(const std::string& text, const std::string& key, const std::string& value) {
  const std::string before = "; " + key + " = ";
  const std::size_t at = text.find(before), begin = at + before.size();
  if (at == text.npos) return with_line(text, before + value, "; CONFIG_BLOCK_END");
  return std::string(text).replace(begin, text.find('\n', begin) - begin, value);
}

/// Of layers alone: the way to the first road is part of the start.
std::string layers_of(const std::string& text, const std::string& mark) {
  return text.substr(text.find(mark));
}

TEST(ReplanOrcaSlicer, DrivesAndPrintsUnderTheAccelerationsOfTheFile) {
  const std::string out = layers_of(replanned_text(fixture("orcaslicer.gcode")).text, ";LAYER_CHANGE");
  std::string now;
  int ways = 0, roads = 0;
  bool wipes = false;
  for (const std::string& line : lines_of(out)) {
    if (line.starts_with("M204")) now = line;
    if (line.starts_with(";WIPE")) wipes = line == ";WIPE_START";
    const bool across = line.starts_with("G1 ") && (line.find(" X") != line.npos || line.find(" Y") != line.npos);
    if (!across || wipes) continue;
    const bool lays = line.find(" E") != line.npos;
    EXPECT_EQ(now, lays ? "M204 S1000" : "M204 S6000") << line;
    ++(lays ? roads : ways);
  }
  EXPECT_GT(ways, 50);
  EXPECT_GT(roads, 500);
}

TEST(ReplanOrcaSlicer, LiftsOnTheWayAsGentlyAsTheFile) {
  const GcodePrint print = read_gcode(replanned_text(fixture("orcaslicer.gcode")).text, "");
  const double slope = std::tan(3 * std::numbers::pi / 180);  // travel_slope
  const auto way_mm = [&](std::size_t i) {
    const Vec3 a = print.moves[i - 1].to_mm, b = print.moves[i].to_mm;
    return std::hypot(b.x - a.x, b.y - a.y);
  };
  int gentle = 0, hasty = 0;
  for (std::size_t i = 1; i < print.moves.size(); ++i) {
    const double rise = print.moves[i].to_mm.z - print.moves[i - 1].to_mm.z;
    if (rise <= 0 || way_mm(i) < 0.001) continue;
    double whole = 0;  // until the nozzle is lowered again
    for (std::size_t k = i; k < print.moves.size() && print.moves[k].to_mm.z >= print.moves[i].to_mm.z; ++k)
      whole += way_mm(k);
    if (rise / way_mm(i) < slope * 1.01) {
      ++gentle;
    } else {
      EXPECT_LT(whole * slope, 0.4) << line_at(*print.text, print.moves[i].offset);
      ++hasty;
    }
  }
  EXPECT_GE(gentle, 12);
  EXPECT_GE(hasty, 1);
}

TEST(ReplanOrcaSlicer, TakesLiftsInASpiralOnArcsForLifts) {
  std::string text;
  int arcs = 0;
  const std::vector<std::string> lines = lines_of(fixture("orcaslicer.gcode"));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const bool spiral = lines[i] == "G1 F7200" && i + 7 < lines.size() && lines[i + 1].find(" Z") != std::string::npos;
    if (!spiral) {
      text += lines[i] + "\n";
      continue;
    }
    i += 7;
    text += "G17\nG3 " + lines[i].substr(lines[i].find('Z')) + " I1.217 J0 P1 F7200\n";
    ++arcs;
  }
  ASSERT_GE(arcs, 10);
  const Replanned result = replanned_text(text);
  EXPECT_TRUE(result.changed);
  const auto print = [](const std::string& all) { return all.substr(0, all.find("; filament used")); };
  EXPECT_TRUE(print(result.text) == print(replanned_text(fixture("orcaslicer.gcode")).text));
}

TEST(ReplanOrcaSlicer, LeavesItsOwnWallsOutOfObjects) {
  const std::array<std::array<std::string, 3>, 2> all = {
      {{"orcaslicer-klipper.gcode", "EXCLUDE_OBJECT_START", "EXCLUDE_OBJECT_END"},
       {"bambustudio.gcode", "M624", "M625"}}};
  for (const auto& [name, begin, end] : all) {
    SCOPED_TRACE(name);
    bool inside = false;
    int walls = 0, labels = 0;
    for (const std::string& line : lines_of(replanned_text(fixture(name)).text)) {
      const bool begins = line.starts_with(begin), ends = line.starts_with(end), is_wall = line == ";RAMPART_WALL";
      if (begins || is_wall) EXPECT_FALSE(inside);
      if (ends) EXPECT_TRUE(inside);
      inside = begins || (inside && !ends);
      labels += begins;
      walls += is_wall;
    }
    EXPECT_FALSE(inside);
    EXPECT_GT(walls, 0);
    EXPECT_GT(labels, 5);
  }
}

TEST(ReplanOrcaSlicer, WritesEachSpellingAsItIs) {
  const std::string bambu = replanned_text(fixture("bambustudio.gcode")).text,
                    other = replanned_text(fixture("orcaslicer.gcode")).text;
  for (const char* plain : {"\n;TYPE:", "\n;WIDTH:", "\n;HEIGHT:", "\n;WIPE_START", "\n;LAYER_CHANGE"})
    EXPECT_EQ(bambu.find(plain), bambu.npos) << plain;
  for (const char* spelling :
       {"\n; FEATURE:", "\n; LINE_WIDTH:", "\n; LAYER_HEIGHT:", "\n; WIPE_START", "\n; CHANGE_LAYER"})
    EXPECT_EQ(other.find(spelling), other.npos) << spelling;
  EXPECT_NE(bambu.find("; FEATURE: Skirt\n"), bambu.npos);
  EXPECT_NE(other.find(";TYPE:Skirt\n"), other.npos);
  EXPECT_NE(bambu.find("\nM73 L3\nM991 S0 P2 ;notify layer change\n"), bambu.npos);
}

TEST(ReplanOrcaSlicer, TellsTheTimesInTheHeadAnew) {
  const Replanned result = replanned_text(fixture("bambustudio.gcode"));
  const double before = read_gcode(fixture("bambustudio.gcode"), "").facts.told_time_s,
               after = read_gcode(result.text, "").facts.told_time_s;
  EXPECT_NEAR(after / before, result.time_s / result.old_time_s, 0.02);
  const std::size_t at = result.text.find("; model printing time: ");
  EXPECT_EQ(result.text.find("; total estimated time: ", at) < result.text.find('\n', at), true);
}

TEST(ReplanOrcaSlicer, TellsTheFilamentInTheHeadAnew) {
  const auto told_mm = [](const std::string& text) {
    const std::string tag = "; total filament length [mm] : ";
    return std::stod(text.substr(text.find(tag) + tag.size()));
  };
  const std::string before = fixture("bambustudio.gcode");
  EXPECT_GT(told_mm(replanned_text(before).text), 1.2 * told_mm(before));  // the rampart's
}

TEST(ReplanOrcaSlicer, WaitsForEachToolWhereTheFileDoes) {
  const std::vector<std::string> lines =
      lines_of(layers_of(replanned_text(fixture("orcaslicer.gcode")).text, ";LAYER"));
  int changes = 0;
  for (std::size_t i = 0; i + 2 < lines.size(); ++i) {
    if (lines[i] != "T0" && lines[i] != "T1") continue;
    EXPECT_EQ(lines[i + 2], "M109 S230");
    ++changes;
  }
  EXPECT_GE(changes, 6);
}

TEST(ReplanOrcaSlicer, HeatsAToolInTheFirstLayerAsTheFileDoesThere) {
  const std::string own = fixture("orcaslicer.gcode"), text = replaced(own, "\nM109 S230\n", "\nM109 S215\n");
  ASSERT_NE(text, own);
  const Replanned result = replanned_text(text);
  EXPECT_TRUE(result.changed);
  int layer = 0, tool = 0;
  for (const std::string& line : lines_of(layers_of(result.text, ";LAYER_CHANGE"))) {
    if (line == ";LAYER_CHANGE") ++layer;
    if (line.starts_with("T")) tool = line[1] - '0';
    if (line.starts_with("M109")) EXPECT_EQ(line, layer == 1 && tool == 1 ? "M109 S215" : "M109 S230") << layer;
  }
  EXPECT_EQ(layer, 6);
}

TEST(ReplanOrcaSlicer, WithoutItsTowerIsDrivenAsTheFileDrives) {
  const std::string text = fixture("orcaslicer-tower.gcode");
  const std::string fast = with_line(text, "SET_VELOCITY_LIMIT ACCEL=777", "; CP TOOLCHANGE WIPE");
  const std::string again =
      with_line(fast, "SET_VELOCITY_LIMIT ACCEL=1000", "; CP TOOLCHANGE END", fast.find("ACCEL=777"));
  ASSERT_NE(fast, again);
  const std::string out = replanned_text(again, {.removes_tower = true}).text;
  EXPECT_EQ(out.find("ACCEL=777"), out.npos);
  EXPECT_EQ(out.find("; CP TOOLCHANGE WIPE"), out.npos);
}

TEST(ReplanOrcaSlicer, RefusesWhatItDoesNotKnowForSure) {
  const std::string text = fixture("orcaslicer.gcode");
  const std::size_t layers = text.find(";LAYER_CHANGE");
  const auto with = [&](const std::string& line, const std::string& before) {
    return with_line(text, line, before, layers);
  };
  const std::array<std::array<std::string, 2>, 7> all = {{
      {with_option(text, "single_extruder_multi_material", "1"), "in one nozzle"},
      {with_option(text, "spiral_mode", "1"), "vase mode"},
      {with_option(text, "is_infill_first", "1"), "infill before perimeters"},
      {with_option(text, "wall_sequence", "inner-outer-inner wall"), "between inner ones"},
      {with_option(text, "retract_lift_enforce", "Top Only,Top Only"), "some layers only"},
      {with_option(text, "retract_lift_below", "1,1"), "some layers only"},
      {with("M620 S1A", "T1"), "M620"},
  }};
  for (const auto& [changed, reason] : all) EXPECT_ERROR(replanned_text(changed), reason);
  EXPECT_ERROR(replanned_text(with("M104 S200", "; filament end gcode")), "without a tool");
}

TEST(ReplanOrcaSlicer, FilesThatLiftBelowAHeightTheyDoNotReachAreTaken) {
  EXPECT_TRUE(replanned_text(with_option(fixture("orcaslicer.gcode"), "retract_lift_below", "2,2")).changed);
}

}  // namespace
}  // namespace cleancolor
