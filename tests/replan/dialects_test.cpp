// What holds for the files of every dialect.

#include <gtest/gtest.h>

#include <cmath>

#include "replanning.hpp"

namespace cleancolor {
namespace {

using namespace test;

class ReplanDialects : public testing::TestWithParam<const char*> {};

TEST_P(ReplanDialects, KeepTheFilamentOfEachToolAndRole) {
  const std::string text = fixture(std::string(GetParam()) + ".gcode");
  const auto before = kept_filament(read_gcode(text, "")),
             after = kept_filament(read_gcode(replanned_text(text).text, ""));
  ASSERT_EQ(before.size(), after.size());
  for (const auto& [what, mm] : before) {
    SCOPED_TRACE(role_name(what.second));
    EXPECT_NEAR(after.at(what), mm, 1e-4 * mm);
  }
}

TEST_P(ReplanDialects, DrawBackAsMuchAsTheyPushForwardAgain) {
  const GcodePrint print = read_gcode(replanned_text(fixture(std::string(GetParam()) + ".gcode")).text, "");
  std::map<int, double> back_mm;
  for (std::size_t i = 0; i < print.moves.size(); ++i) {
    const GcodeMove& move = print.moves[i];
    if (lays_plastic(print, i)) {
      EXPECT_NEAR(back_mm[move.feeds], 0, 1e-4) << line_at(*print.text, move.offset);
    } else {
      back_mm[move.feeds] -= move.filament_mm;
      EXPECT_GT(back_mm[move.feeds], -1e-4) << line_at(*print.text, move.offset);
      EXPECT_LT(back_mm[move.feeds], 1.001) << line_at(*print.text, move.offset);
    }
  }
}

TEST_P(ReplanDialects, WithOrderAndTravelKeptMakeTheSameMoves) {
  const std::string text = fixture(std::string(GetParam()) + ".gcode");
  const auto moving = [](const std::string& all) {
    std::vector<std::tuple<Vec3, double, int>> moves;
    for (const GcodeMove& m : read_gcode(all, "").moves) {
      const bool moves_at_all = moves.empty() || m.to_mm != std::get<0>(moves.back()) || std::abs(m.filament_mm) > 1e-9;
      if (moves_at_all) moves.emplace_back(m.to_mm, std::round(m.filament_mm * 1e5), m.feeds);
    }
    return moves;
  };
  EXPECT_EQ(moving(text), moving(replanned_text(text, {.keeps_order = true}).text));
}

TEST_P(ReplanDialects, KeepTheLineEndsOfWindows) {
  const auto for_windows = [](const std::string& text) {
    std::string ended;
    for (const char c : text) ended += c == '\n' ? std::string("\r\n") : std::string(1, c);
    return ended;
  };
  const std::string text = fixture(std::string(GetParam()) + ".gcode");
  EXPECT_EQ(replanned_text(for_windows(text)).text, for_windows(replanned_text(text).text));
}

TEST_P(ReplanDialects, PlannedAgainStayAsTheyAre) {
  const std::string once = replanned_text(fixture(std::string(GetParam()) + ".gcode")).text;
  const Replanned again = replanned_text(once);
  EXPECT_FALSE(again.changed);
  EXPECT_EQ(again.text, once);
}

TEST_P(ReplanDialects, AreTheSameForAnyNumberOfThreads) {
  const std::string text = fixture(std::string(GetParam()) + ".gcode");
  EXPECT_EQ(replanned_text(text).text, replanned_text(text, {.threads = 3}).text);
}

TEST_P(ReplanDialects, InPlainOrderKeepTheirPlasticToo) {
  const std::string text = fixture(std::string(GetParam()) + ".gcode");
  EXPECT_NO_THROW(replanned_text(text, {.protection = ReplanProtection::none}));
  EXPECT_NO_THROW(replanned_text(text, {.protection = ReplanProtection::rampart}));
}

TEST_P(ReplanDialects, DamagedAreRefusedOrPlannedWhole) {
  EXPECT_GT(planned_of_damaged(fixture(std::string(GetParam()) + ".gcode"), 15), 0);
}

INSTANTIATE_TEST_SUITE_P(All, ReplanDialects,
                         testing::Values("prusaslicer", "prusaslicer-shield", "prusaslicer-ooze", "prusaslicer-tower",
                                         "prusaslicer-tower-wipe", "prusaslicer-wipe", "prusaslicer-sailfish",
                                         "prusaslicer-makerware", "slic3r-plain", "slic3r-ooze", "slic3r-verbose",
                                         "orcaslicer", "orcaslicer-klipper", "orcaslicer-tower", "bambustudio",
                                         "superslicer"),
                         [](const testing::TestParamInfo<const char*>& of) {
                           std::string name = of.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace cleancolor
