// PrusaSlicer with what it has against ooze, and for other printers: two bars of two colours, 16 x 4 mm each, side by
// side in 6 layers, by PrusaSlicer 2.5.0.

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "replanning.hpp"

namespace cleancolor {
namespace {

using namespace test;

std::string variant(const std::string& name) {
  return fixture("prusaslicer-" + name + ".gcode");
}

std::vector<std::string> lines_that(const std::string& text, const std::vector<std::string>& begin_so) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (std::ranges::any_of(begin_so, [&](const std::string& begin) { return line.starts_with(begin); }))
      lines.push_back(line);
  return lines;
}

/// Where the carriage stands at each change of tools among the layers, as the file tells places.
std::vector<std::pair<double, double>> stands(const GcodePrint& print) {
  std::vector<std::pair<double, double>> places;
  const std::size_t layers = print.text->find(";LAYER_CHANGE");
  for (const GcodeEvent& e : print.events)
    if (e.kind == GcodeEvent::Kind::tool_change && e.offset > layers) {
      const Vec3 at = print.moves[e.before_move - 1].to_mm;
      places.emplace_back(at.x, at.y);
    }
  return places;
}

double skirt_mm3(const GcodePrint& print) {
  const AuditMachine machine = audit_machine(print, {});
  double sum = 0;
  for (const auto& [what, mm] : kept_filament(print))
    if (what.second == Role::skirt_brim) sum += mm * filament_area_mm2(machine, what.first);
  return sum;
}

class ReplanAgainstOoze : public testing::TestWithParam<const char*> {};

TEST_P(ReplanAgainstOoze, SmearsNoMore) {
  const std::string text = variant(GetParam());
  EXPECT_LE(cleanness(replanned_text(text).text).smear_mm3, cleanness(text).smear_mm3 + 0.005);
}

INSTANTIATE_TEST_SUITE_P(All, ReplanAgainstOoze,
                         testing::Values("shield", "ooze", "tower", "wipe", "sailfish", "makerware"),
                         [](const testing::TestParamInfo<const char*>& of) { return std::string(of.param); });

TEST(ReplanShield, IsKeptAndPrintedFirstWhereARampartCostsMore) {
  const GcodePrint print = read_gcode(replanned_text(variant("shield")).text, "");
  EXPECT_EQ(print.text->find(";RAMPART_WALL"), std::string::npos);
  std::map<std::uint32_t, Role> first;  // of each layer
  for (std::size_t i = 0; i < print.moves.size(); ++i)
    if (lays_plastic(print, i)) first.try_emplace(print.moves[i].layer, print.moves[i].role);
  ASSERT_EQ(first.size(), 6u);
  for (const auto& [layer, role] : first) EXPECT_EQ(role, Role::skirt_brim) << layer;
}

TEST(ReplanShield, StandsInsideTheRampart) {
  const std::string out = replanned_text(variant("shield"), {.protection = ReplanProtection::rampart}).text;
  const GcodePrint print = read_gcode(out, "");
  Box<Vec2> shield, rampart;
  for (std::size_t i = 1; i < print.moves.size(); ++i) {
    if (!lays_plastic(print, i) || print.moves[i].layer > 4) continue;
    const Role role = print.moves[i].role;
    const Vec3 at = print.moves[i].to_mm;
    if (role == Role::skirt_brim) shield.add({at.x, at.y});
    if (role == Role::rampart) rampart.add({at.x, at.y});
  }
  ASSERT_FALSE(rampart.empty());
  EXPECT_LT(rampart.min.y, shield.min.y);
  EXPECT_GT(rampart.max.y, shield.max.y);
}

TEST(ReplanShield, IsRemovedOnRequestAndItsPlasticTold) {
  const std::string text = variant("shield");
  const Replanned result = replanned_text(text, {.protection = ReplanProtection::rampart, .removes_shield = true});
  EXPECT_NE(result.text.find(";RAMPART_WALL"), result.text.npos);
  EXPECT_NEAR(result.removed_mm3, skirt_mm3(read_gcode(text, "")), 0.01);
  EXPECT_EQ(skirt_mm3(read_gcode(result.text, "")), 0);
  EXPECT_GT(result.removed_mm3, 10);
}

TEST(ReplanShield, OfNoPrintIsNotRemoved) {
  EXPECT_EQ(replanned_text(variant("wipe"), {.removes_shield = true}).removed_mm3, 0);
}

TEST(ReplanStandby, HeatsAndCoolsAsInTheFile) {
  const std::string text = variant("ooze");
  const std::vector<std::string> heating = {"M104", "M109", "T0", "T1"};
  EXPECT_EQ(lines_that(text, heating), lines_that(replanned_text(text).text, heating));
}

TEST(ReplanStandby, WaitsWhereTheFileDoes) {
  const std::string text = variant("ooze");
  const auto before = stands(read_gcode(text, "")), after = stands(read_gcode(replanned_text(text).text, ""));
  ASSERT_EQ(before.size(), 6u);
  EXPECT_EQ(before, after);
}

TEST(ReplanStandby, WaitsThereWithoutCodeOfTheFilamentToo) {
  std::string text = variant("ooze");
  for (std::size_t at; (at = text.find(";END gcode for filament\n")) != text.npos;)
    text.erase(at, text.find('\n', at) + 1 - at);
  EXPECT_EQ(stands(read_gcode(text, "")), stands(read_gcode(replanned_text(text).text, "")));
}

TEST(ReplanStandby, WithoutItsShieldGetsARampart) {
  const std::string text = variant("ooze");
  const std::string out = replanned_text(text, {.protection = ReplanProtection::rampart, .removes_shield = true}).text;
  EXPECT_NE(out.find(";RAMPART_WALL"), out.npos);
  EXPECT_EQ(stands(read_gcode(text, "")), stands(read_gcode(out, "")));
  EXPECT_NE(out.find("order and travel plain, rampart added"), out.npos);
  EXPECT_EQ(replanned_text(text).text.find("rampart added"), out.npos);
}

TEST(ReplanTower, StaysToTheLetter) {
  const std::string text = variant("tower");
  const auto tower = [](const std::string& all) {
    const GcodePrint print = read_gcode(all, "");
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < print.moves.size(); ++i)
      if (lays_plastic(print, i) && print.moves[i].role == Role::wipe_tower)
        lines.emplace_back(line_at(*print.text, print.moves[i].offset));
    return lines;
  };
  const std::string out = replanned_text(text).text;
  ASSERT_GT(tower(text).size(), 50u);
  EXPECT_EQ(tower(text), tower(out));
  for (const char* line : {"T", "M220", "G4 "}) EXPECT_EQ(lines_that(text, {line}), lines_that(out, {line}));
  EXPECT_GE(lines_that(out, {"M900"}).size(), lines_that(text, {"M900"}).size());  // told anew for the tool taken
  EXPECT_EQ(out.find(";RAMPART_WALL"), out.npos);
}

TEST(ReplanTower, StandsBesideTheRampartWithItsChangesOfToolsAlone) {
  const std::string text = variant("tower");
  for (const auto protection : {ReplanProtection::rampart, ReplanProtection::none}) {
    const std::string out = replanned_text(text, {.protection = protection}).text;
    EXPECT_EQ(lines_that(text, {"T0", "T1"}), lines_that(out, {"T0", "T1"}));
    EXPECT_EQ(out.find(";RAMPART_WALL") != out.npos, protection == ReplanProtection::rampart);
  }
}

TEST(ReplanTower, IsRemovedOnRequestAndItsPlasticTold) {
  const std::string text = variant("tower");
  const Replanned result = replanned_text(text, {.protection = ReplanProtection::rampart, .removes_tower = true});
  const GcodePrint before = read_gcode(text, ""), after = read_gcode(result.text, "");
  double tower_mm = 0;
  for (const auto& [what, mm] : kept_filament(before))
    if (what.second == Role::wipe_tower) tower_mm += mm;
  EXPECT_GT(tower_mm, 10);
  EXPECT_NEAR(result.removed_mm3, tower_mm * filament_area_mm2(audit_machine(before, {}), 0), 0.01);
  EXPECT_NE(result.text.find(";RAMPART_WALL"), result.text.npos);
  EXPECT_EQ(part_filament(before).size(), part_filament(after).size());
  for (const auto& [what, mm] : part_filament(before)) EXPECT_NEAR(part_filament(after).at(what), mm, 1e-4 * mm);
  // What stands behind the last road stays as it is.
  std::size_t last = 0;
  for (std::size_t i = 0; i < after.moves.size(); ++i)
    if (lays_plastic(after, i)) last = after.moves[i].offset;
  EXPECT_TRUE(lines_that(result.text.substr(0, last), {";TYPE:Wipe tower", "M220"}).empty());
  EXPECT_EQ(lines_that(text, {";END gcode"}).size(), lines_that(result.text, {";END gcode"}).size());
}

TEST(ReplanTower, WithACommandThatIsNotKnownIsNotRemoved) {
  const std::string text = variant("tower");
  const std::string other = with_line(text, "MOVE_AWAY", "M220 B", text.find(";TYPE:Wipe tower"));
  EXPECT_ERROR(replanned_text(other, {.removes_tower = true}), "MOVE_AWAY");
  EXPECT_NE(replanned_text(other).text.find("MOVE_AWAY"), std::string::npos);
}

TEST(ReplanTower, WithCountsOfEIsRefused) {
  EXPECT_ERROR(replanned_text(replaced(fixture("prusaslicer.gcode"), ";TYPE:Perimeter", ";TYPE:Wipe tower")),
               "relative E");
}

TEST(ReplanWipe, GoesOverThePathJustPrintedAsLongAsInTheFile) {
  const auto wipes = [](const std::string& all) {  // length and filament of each, 0.1 mm and 1e-5 mm
    const GcodePrint print = read_gcode(all, "");
    std::multimap<long, long> found;
    double length = 0, filament = 0;
    std::vector<Vec3> path;
    for (std::size_t i = 1; i < print.moves.size(); ++i) {
      const GcodeMove& move = print.moves[i];
      const Vec3 from = print.moves[i - 1].to_mm;
      const double way = std::hypot(move.to_mm.x - from.x, move.to_mm.y - from.y);
      if (lays_plastic(print, i)) {
        if (path.empty()) path.push_back(from);
        path.push_back(move.to_mm);
      } else if (way > 0 && move.filament_mm < 0) {
        length += way, filament -= move.filament_mm;
        double off = INFINITY;
        for (std::size_t p = 0; p + 1 < path.size(); ++p) {
          const Vec2 a{path[p].x, path[p].y}, b{path[p + 1].x, path[p + 1].y}, at{move.to_mm.x, move.to_mm.y};
          off = std::min(off, distance(nearest_on_segment(a, b, at), at));
        }
        EXPECT_LT(off, 0.5) << line_at(*print.text, move.offset);
      } else {
        if (length > 0) found.emplace(std::lround(length * 10), std::lround(filament * 1e5)), path.clear();
        if (way > 1) path.clear();
        length = filament = 0;
      }
    }
    return found;
  };
  const auto before = wipes(variant("wipe")), after = wipes(replanned_text(variant("wipe")).text);
  ASSERT_GT(before.size(), 10u);
  EXPECT_GT(after.size(), before.size() / 2);
  for (const auto& [length, filament] : after) {
    const auto [first, last] = before.equal_range(length);
    const bool known =
        std::any_of(first, last, [&](const auto& wipe) { return std::abs(wipe.second - filament) < 10; });
    EXPECT_TRUE(known) << length << " " << filament;
  }
}

TEST(ReplanSailfish, CountsEForEachToolAndSetsItOnceAtTheEnd) {
  const std::string out = replanned_text(variant("sailfish")).text;
  const std::string layers = out.substr(out.find(";LAYER_CHANGE"));
  EXPECT_EQ(lines_that(layers, {"G92"}).size(), 1u);
  EXPECT_GE(lines_that(layers, {"M108 T"}).size(), 6u);
  for (const std::string& line : lines_that(out, {"M73"})) EXPECT_EQ(line.find('R'), line.npos) << line;
}

TEST(ReplanMakerWare, SaysWhenTheExtruderIsOnAndOff) {
  const std::string out = replanned_text(variant("makerware")).text;
  const GcodePrint print = read_gcode(out, "");
  bool on = false;
  std::size_t move = 0;
  for (std::size_t at = out.find(";LAYER_CHANGE"); at < out.size() && at > 0; at = out.find('\n', at) + 1) {
    if (out.compare(at, 4, "M101") == 0) on = true;
    if (out.compare(at, 4, "M103") == 0) on = false;
    while (move < print.moves.size() && print.moves[move].offset < at) ++move;
    if (move == print.moves.size()) break;
    if (print.moves[move].offset == at && lays_plastic(print, move)) {
      EXPECT_TRUE(on) << line_at(out, at);
    }
  }
}

}  // namespace
}  // namespace cleancolor
