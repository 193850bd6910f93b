// What the page draws, of hand-written prints.
#include "viewer/moves.hpp"

#include "../audit/drawn.hpp"
#include "array_reader.hpp"
#include "support_errors.hpp"
#include "viewer/places.hpp"
#include "viewer/summary.hpp"

namespace cleancolor {
namespace {

using Bytes8 = std::vector<std::uint8_t>;
using Words32 = std::vector<std::uint32_t>;

// Two nozzles, the second 10 mm to the right; offsets in the file.
Drawing two_colours() {
  Drawing d(drawn_machine({{0, 0}, {10, 0}}));
  d.layer(0).wall().go({20, 20}).lay({30, 20}).dwell(2);
  d.tool(1).go({40, 20}).lay({40, 30});
  d.skirt().go({60, 60}).lay({60, 61});
  return d;
}

TEST(Moves, AreWhereTheFileSays) {
  const Drawing drawing = two_colours();
  const GcodePrint print = drawing.print();
  const Timeline time = timeline(print, drawing.machine());
  const ArrayReader read(moves_file(move_arrays(print, drawing.machine(), time)));

  // Z; to 20,20; road; T1 to 40,20; road; to the skirt; skirt.
  ASSERT_EQ(print.moves.size(), 7u);
  const auto position = read.array<float>("position", 3);
  EXPECT_EQ(std::vector<float>(position.begin() + 3, position.end()),
            (std::vector<float>{20, 20, 0.2F, 30, 20, 0.2F, 40, 20, 0.2F, 40, 30, 0.2F, 60, 60, 0.2F, 60, 61, 0.2F}));
  const auto carriage = read.array<float>("carriage", 2);
  EXPECT_EQ(std::vector<float>(carriage.begin() + 2, carriage.end()),
            (std::vector<float>{20, 20, 30, 20, 30, 20, 30, 30, 50, 60, 50, 61}));
  EXPECT_EQ(read.array<std::uint8_t>("tool"), (Bytes8{0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(read.array<std::uint32_t>("layer"), Words32(7, 0));
  EXPECT_EQ(read.array<std::uint8_t>("width"), (Bytes8{0, 0, 40, 0, 40, 0, 40}));
  EXPECT_EQ(read.array<std::uint8_t>("height"), (Bytes8{0, 0, 20, 0, 20, 0, 20}));
  EXPECT_EQ(read.array<std::uint32_t>("tool_change_move"), (Words32{3}));
  EXPECT_EQ(read.array<float>("layer_z"), (std::vector<float>{0.2F}));
  EXPECT_EQ(read.array<float>("layer_height"), (std::vector<float>{0.2F}));

  const auto speed = read.array<std::uint16_t>("speed");
  EXPECT_EQ(speed[1], 1000);
  EXPECT_EQ(speed[2], 100);
  const auto pushed = read.array<float>("pushed");
  EXPECT_EQ(pushed[1], 0);
  EXPECT_NEAR(pushed[2], 10 * drawn_area_mm2, 1e-3);
  const auto role = read.array<std::uint8_t>("role");
  EXPECT_EQ(role_word(Role(role[2])), "external_perimeter");
  EXPECT_EQ(role_word(Role(role[6])), "skirt_brim");
}

TEST(Moves, TellWhatTheyLayAndWhatCanBeSeen) {
  const Drawing drawing = two_colours();
  const GcodePrint print = drawing.print();
  const auto flags = move_arrays(print, drawing.machine(), timeline(print, drawing.machine())).flags;
  using namespace move_flag;
  EXPECT_EQ(flags[2], lays | known_start | outermost);
  EXPECT_EQ(flags[3] & (lays | tool_changed), tool_changed);
  EXPECT_EQ(flags[4], lays | known_start | outermost);
  EXPECT_EQ(flags[6], lays | known_start | outermost | auxiliary);
}

TEST(Moves, EndWhenTheTimelineSaysWithDwells) {
  const Drawing drawing = two_colours();
  const GcodePrint print = drawing.print();
  const Timeline time = timeline(print, drawing.machine());
  const auto end_s = move_arrays(print, drawing.machine(), time).end_s;
  EXPECT_NEAR(end_s.back(), time.print_time_s, 1e-3);
  EXPECT_NEAR(end_s[2] - end_s[1], 1, 1e-3);  // 10 mm at 10 mm/s
  EXPECT_NEAR(end_s[3] - end_s[2], 2, 1e-3);  // the carriage stands already where T1 is to be
}

TEST(Moves, OfInfillBehindWallsCannotBeSeen) {
  Drawing d(drawn_machine({{0, 0}}));
  for (int layer = 0; layer < 3; ++layer) {
    d.layer(layer).wall().go({0, 0}).lay({10, 0}).lay({10, 3}).lay({0, 3}).lay({0, 0}).infill();
    for (double y = 0.4; y < 2.8; y += 0.4) d.go({0.4, y}).lay({9.6, y});
  }
  const GcodePrint print = d.print();
  const auto flags = move_arrays(print, d.machine(), timeline(print, d.machine())).flags;
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (!(flags[i] & move_flag::lays)) continue;
    if (print.moves[i].role == Role::external_perimeter) {
      EXPECT_TRUE(flags[i] & move_flag::outermost) << i;
    } else if (!(flags[i] & move_flag::outermost)) {
      ++hidden;
    }
    EXPECT_TRUE(print.moves[i].layer < 2 || flags[i] & move_flag::outermost) << i;  // the top
  }
  EXPECT_EQ(hidden, 12u);  // 6 lines in each of the two layers below the top
}

TEST(Moves, AreTheSameForAnyNumberOfThreads) {
  const GcodePrint print = read_gcode_file(CLEANCOLOR_ROOT "/tests/reader/samples/prusaslicer.gcode");
  const AuditMachine machine = drawn_machine({{0, 0}, {33, 0}});
  const Timeline time = timeline(print, machine);
  EXPECT_EQ(moves_file(move_arrays(print, machine, time, 1)), moves_file(move_arrays(print, machine, time, 4)));
}

TEST(Summary, CountsWhatTheAuditCounts) {
  for (const auto& entry : std::filesystem::directory_iterator(CLEANCOLOR_ROOT "/tests/reader/samples")) {
    if (entry.path().extension() != ".gcode") continue;
    SCOPED_TRACE(entry.path().filename().string());
    const GcodePrint print = read_gcode_file(entry.path());
    const AuditMachine machine =
        audit_machine(print, {.nozzle_offset_mm = std::vector<Vec2>(std::size_t(print.tools))});
    const Timeline time = timeline(print, machine);
    const MoveArrays moves = move_arrays(print, machine, time);
    const auto summary = print_summary({.print = &print, .machine = &machine, .time = &time, .moves = &moves});
    const AuditResult result = audit(print, machine);
    EXPECT_EQ(summary["moves"], print.moves.size());
    EXPECT_EQ(summary["layers"], result.layers);
    EXPECT_EQ(summary["tool_changes"], result.tool_changes);
    EXPECT_NEAR(summary["print_time_s"].get<double>(), result.print_time_s, 1e-6);
    ASSERT_EQ(summary["nozzles"].size(), result.nozzles.size());
    for (std::size_t n = 0; n < result.nozzles.size(); ++n) {
      EXPECT_NEAR(summary["nozzles"][n]["part_g"].get<double>(), result.nozzles[n].part_g, 1e-6);
      EXPECT_NEAR(summary["nozzles"][n]["auxiliary_g"].get<double>(), result.nozzles[n].auxiliary_g, 1e-6);
    }
  }
}

TEST(Summary, KnowsBoxBedAndRoles) {
  const Drawing drawing = two_colours();
  const GcodePrint print = drawing.print();
  const Timeline time = timeline(print, drawing.machine());
  const MoveArrays moves = move_arrays(print, drawing.machine(), time);
  const Config printer;
  const auto summary = print_summary(
      {.print = &print, .machine = &drawing.machine(), .time = &time, .moves = &moves, .printer = &printer});
  EXPECT_NEAR(summary["part_box_mm"][0][0].get<double>(), 19.8, 1e-6);
  EXPECT_NEAR(summary["part_box_mm"][1][1].get<double>(), 30.2, 1e-6);
  EXPECT_NEAR(summary["box_mm"][1][1].get<double>(), 61.2, 1e-6);
  EXPECT_EQ(summary["bed_mm"].size(), 4u);
  EXPECT_EQ(summary["roles"].size(), std::size_t(role_count));
  EXPECT_EQ(summary["dialect"], "prusaslicer");
  EXPECT_TRUE(summary["azimuth"].is_null());
}

// Nozzle 1 idles over the wall of nozzle 0, which was printed first.
TEST(Places, AreThoseOfTheAudit) {
  Drawing d(drawn_machine({{0, 0}, {10, 0}}));
  d.layer(0).wall().road({20, 20}, {40, 20});
  d.tool(1).wall().road({40, 40}, {40, 41}).dwell(30);
  d.tool(0).wall().road({10, 20}, {30, 20.0});
  const GcodePrint print = d.print();
  const AuditResult result = audit(print, d.machine(), only_worst());
  const ScenarioResult& worst = result.scenarios.front();
  Scenario scenario = scenarios().front();
  scenario.ooze = {{.volume_mm3 = 1.5, .time_s = 30}};
  const ArrayReader read(places_file(place_arrays(print, d.machine(), result), worst.total, scenario, d.machine()));
  ASSERT_FALSE(worst.places.empty());
  EXPECT_EQ(read.array<float>("place_mm3").size(), worst.places.size());
  EXPECT_EQ(read.array<std::uint8_t>("visibility").size(), print.moves.size());
  EXPECT_EQ(read.array<float>("layer_smear"), (std::vector<float>{float(worst.total.smear_volume())}));
  EXPECT_EQ(read.header().at("figures").at("smear_volume"), worst.total.smear_volume());
  const nlohmann::json ooze = {{"volume_mm3", 1.5}, {"time_s", 30}};
  EXPECT_EQ(read.header().at("ooze"), nlohmann::json({ooze, ooze}));
  EXPECT_EQ(read.header().at("worst").size(), worst_places(worst, ~std::size_t(0)).size());
  const auto from = read.array<float>("place_from", 3);
  const auto layer = read.array<std::uint32_t>("place_layer"), move = read.array<std::uint32_t>("place_move");
  for (std::size_t i = 0; i < worst.places.size(); ++i) {
    EXPECT_EQ(from[3 * i], float(worst.places[i].at_mm.x));
    EXPECT_EQ(from[3 * i + 2], 0.2F);
    ASSERT_LT(move[i], print.moves.size());
    EXPECT_EQ(print.moves[move[i]].layer, layer[i]);
  }
  // Nozzle 1 smears the wall while nozzle 0 prints its last road.
  const std::vector<std::size_t> listed = read.header().at("worst");
  EXPECT_TRUE(std::ranges::any_of(listed, [&](std::size_t i) {
    const Place& p = worst.places[i];
    return p.kind == Place::Kind::smear && p.nozzle == 1 && move[i] == print.moves.size() - 1;
  }));
}

}  // namespace
}  // namespace cleancolor
