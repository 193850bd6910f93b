// Supports, raft, ironing, arcs, objects of several layer heights, by PrusaSlicer 2.5.0 and CuraEngine 4.13.0: two
// brackets of two colours side by side, 7 x 7 mm with an arm of 8 mm at 1.5 mm; "heights" has them twice, in layers of
// 0.3 and 0.2 mm; "arcs" is a round and a half round disc, with roads on a circle made arcs.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "replan/cura.hpp"
#include "replanning.hpp"

namespace cleancolor {
namespace {

using namespace test;

struct Sliced {
  const char* name;  // of the fixture
  bool has_supports = true;
};

MachineRequest two_nozzles(const std::string& text) {
  if (!text.starts_with(";FLAVOR")) return {};
  return {.nozzle_offset_mm = {{0, 0}, {33, 0}}, .offsets_in = OffsetsIn::slicer};
}
Replanned replanned_fixture(const std::string& text, const ReplanRequest& request = {}) {
  return replanned_text(text, request, {}, two_nozzles(text));
}

/// With ironing of Cura told.
GcodePrint read(const std::string& text) {
  GcodePrint print = read_gcode(text, "in.gcode");
  if (print.facts.dialect != Dialect::cura) return print;
  return with_ironing(print).value_or(print);
}

bool is_support(Role role) {
  return role == Role::support || role == Role::support_interface;
}
bool is_ours(Role role) {
  return role == Role::rampart || role == Role::refill || role == Role::skirt_brim;
}

using Place = std::pair<int, std::int64_t>;  // tool, height in micrometres

/// Where the tool prints supports after the part.
std::set<Place> late_supports(const GcodePrint& print) {
  std::set<Place> with_part, late;
  for (std::size_t i = 1; i < print.moves.size(); ++i) {
    const GcodeMove& m = print.moves[i];
    if (!lays_plastic(print, i) || is_ours(m.role)) continue;
    const Place place{m.tool, std::llround(m.to_mm.z * 1e3)};
    if (!is_support(m.role))
      with_part.insert(place);
    else if (with_part.contains(place))
      late.insert(place);
  }
  return late;
}

/// Ironing as it is walked, with all of the part that follows it as one end.
std::map<Place, std::vector<std::array<std::int64_t, 4>>> ironed(const GcodePrint& print) {
  std::map<Place, std::vector<std::array<std::int64_t, 4>>> all;
  const auto um = [](double mm) { return std::int64_t(std::llround(mm * 1e3)); };
  for (std::size_t i = 1; i < print.moves.size(); ++i) {
    const GcodeMove& m = print.moves[i];
    if (!lays_plastic(print, i) || is_ours(m.role) || is_support(m.role)) continue;
    const Vec3 from = print.moves[i - 1].to_mm;
    const Place place{m.tool, um(m.to_mm.z)};
    if (m.role == Role::ironing)
      all[place].push_back({um(from.x), um(from.y), um(m.to_mm.x), um(m.to_mm.y)});
    else if (all.contains(place))
      all[place].push_back({});
  }
  return all;
}

class ReplanSupports : public testing::TestWithParam<Sliced> {
 protected:
  std::string text() const { return fixture(std::string(GetParam().name) + ".gcode"); }
};

TEST_P(ReplanSupports, KeepsFilamentOfEachToolAndRole) {
  const auto before = kept_filament(read(text())), after = kept_filament(read(replanned_fixture(text()).text));
  ASSERT_EQ(before.size(), after.size());
  for (const auto& [what, mm] : before) {
    SCOPED_TRACE(role_name(what.second));
    EXPECT_NEAR(after.at(what), mm, 1e-4 * mm + 0.001);
  }
}

TEST_P(ReplanSupports, PrintsSupportsBeforeThePartWhereTheFileDoes) {
  const GcodePrint before = read(text()), after = read(replanned_fixture(text()).text);
  EXPECT_EQ(std::ranges::any_of(before.moves, [](const GcodeMove& m) { return is_support(m.role); }),
            GetParam().has_supports);
  const std::set<Place> allowed = late_supports(before);
  for (const Place& place : late_supports(after)) EXPECT_TRUE(allowed.contains(place)) << place.second;
}

TEST_P(ReplanSupports, ComesOutCleanerWhateverIsKept) {
  const Cleanness before = cleanness(text(), two_nozzles(text()));
  const Replanned result = replanned_fixture(text());
  EXPECT_TRUE(result.changed);
  const Cleanness after = cleanness(result.text, two_nozzles(text()));
  EXPECT_LE(after.smear_mm3, std::max(0.2, before.smear_mm3 / 8));
  EXPECT_LE(after.smear_mm3 + after.hole_mm3, before.smear_mm3 + before.hole_mm3 + 0.005);
}

TEST_P(ReplanSupports, WithOrderAndTravelKeptPrintsTheSameRoadsInTheirOrder) {
  const GcodePrint before = read(text()), after = read(replanned_fixture(text(), {.keeps_order = true}).text);
  const auto roads = [](const GcodePrint& print) {
    std::vector<std::pair<Vec3, Role>> all;
    for (std::size_t i = 1; i < print.moves.size(); ++i)
      if (lays_plastic(print, i)) all.emplace_back(print.moves[i].to_mm, print.moves[i].role);
    return all;
  };
  EXPECT_EQ(roads(before), roads(after));
}

INSTANTIATE_TEST_SUITE_P(All, ReplanSupports,
                         testing::Values(Sliced{"prusaslicer-support"}, Sliced{"prusaslicer-soluble"},
                                         Sliced{"prusaslicer-raft"}, Sliced{"prusaslicer-ironing", false},
                                         Sliced{"prusaslicer-heights", false}, Sliced{"prusaslicer-arcs", false},
                                         Sliced{"cura-support"}, Sliced{"cura-ironing", false}),
                         [](const testing::TestParamInfo<Sliced>& of) {
                           std::string name = of.param.name;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(ReplanIroning, ComesLastInItsOrderAndDirection) {
  for (const char* name : {"prusaslicer-ironing.gcode", "cura-ironing.gcode"}) {
    SCOPED_TRACE(name);
    const std::string text = fixture(name);
    const auto before = ironed(read(text)), after = ironed(read(replanned_fixture(text).text));
    EXPECT_EQ(before.size(), 2U);  // one top of each colour
    for (const auto& [place, roads] : before) {
      ASSERT_TRUE(after.contains(place));
      EXPECT_EQ(after.at(place), roads);
    }
  }
}

/// How much of each circle is printed, mm: by tool, height, and centre in micrometres.
std::map<std::tuple<int, std::int64_t, std::int64_t, std::int64_t>, double> circles(const std::string& text) {
  const GcodePrint print = read_gcode(text, "");
  std::map<std::tuple<int, std::int64_t, std::int64_t, std::int64_t>, double> all;
  const auto um = [](double mm) { return std::int64_t(std::llround(mm * 1e3)); };
  Vec2 center;
  for (std::size_t i = 1; i < print.moves.size(); ++i) {
    const Vec3 from = print.moves[i - 1].to_mm, to = print.moves[i].to_mm;
    if (!print.moves[i].arc) continue;
    if (print.moves[i].offset != print.moves[i - 1].offset) {
      const std::string line(line_at(text, print.moves[i].offset));
      center = {from.x + std::stod(line.substr(line.find(" I") + 2)),
                from.y + std::stod(line.substr(line.find(" J") + 2))};
    }
    all[{print.moves[i].tool, um(to.z), um(center.x), um(center.y)}] += std::hypot(to.x - from.x, to.y - from.y);
  }
  return all;
}

TEST(ReplanArcs, StayArcsAboutTheSameCentres) {
  const std::string text = fixture("prusaslicer-arcs.gcode"), out = replanned_fixture(text).text;
  const auto before = circles(text), after = circles(out);
  EXPECT_EQ(before.size(), after.size());
  EXPECT_GT(before.size(), 40U);
  for (const auto& [place, mm] : before) {
    ASSERT_TRUE(after.contains(place));
    EXPECT_NEAR(after.at(place), mm, 0.12 + 0.001 * mm);  // a gap, a short piece that is straight, chords
  }
}

TEST(ReplanArcs, OfDamagedFilesAreRefusedOrPlannedWhole) {
  EXPECT_GT(planned_of_damaged(fixture("prusaslicer-arcs.gcode"), 40), 5);
}

TEST(ReplanArcs, AreRefusedWhereTheyAreWholeCirclesOrHaveNoCentre) {
  const std::string text = fixture("prusaslicer-arcs.gcode");
  const std::size_t at = text.find("\nG3 ") + 1, end = text.find('\n', at);
  const std::string arc = text.substr(at, end - at);
  EXPECT_ERROR(replanned_fixture(replaced(text, arc, arc.substr(0, arc.find(" I")) + " R5.5 E.1")), "centre");
  EXPECT_ERROR(replanned_fixture(replaced(text, arc, "G3 I-5 J0 E1\n" + arc)), "whole circle");
}

/// The label that holds while each road of the part is printed: by tool, height and end.
std::map<std::tuple<int, double, double, double>, std::string> labels(const std::string& text) {
  const GcodePrint print = read_gcode(text, "");
  std::map<std::tuple<int, double, double, double>, std::string> all;
  std::istringstream in(text);
  std::string label;
  std::size_t offset = 0, i = 0;
  for (std::string line; std::getline(in, line); offset += line.size() + 1) {
    if (line.starts_with("; printing object ")) label = line.substr(18);
    if (line.starts_with("; stop printing object ")) {
      EXPECT_EQ(std::exchange(label, ""), line.substr(23));
    }
    for (; i < print.moves.size() && print.moves[i].offset == offset; ++i)
      if (lays_plastic(print, i) && !is_auxiliary(print.moves[i].role)) {
        const Vec3 to = print.moves[i].to_mm;
        all[{print.moves[i].tool, to.z, to.x, to.y}] = label;
      }
  }
  return all;
}

TEST(ReplanLabels, StayAroundTheRoadsOfTheirObject) {
  const std::string text = fixture("prusaslicer-heights.gcode");
  const auto before = labels(text), after = labels(replanned_fixture(text).text);
  std::set<std::string> names;
  std::size_t same_places = 0;
  for (const auto& [place, label] : before) {
    names.insert(label);
    const auto found = after.find(place);
    if (found == after.end()) continue;
    ++same_places;
    EXPECT_EQ(found->second, label);
  }
  EXPECT_EQ(names.size(), 2U);
  EXPECT_GT(same_places, before.size() * 9 / 10);
}

}  // namespace
}  // namespace cleancolor
