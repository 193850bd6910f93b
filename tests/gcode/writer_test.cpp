// Promises of the writer, checked by reading what it wrote with a reader that shares nothing with it (jobs.hpp).

#include "gcode/writer.hpp"

#include <gtest/gtest.h>

#include <random>

#include "base/error.hpp"
#include "gcode/jobs.hpp"

using namespace cleancolor;
using namespace cleancolor::test;

namespace {

/// A printer that obeys, and what it did. Breaks of the rules are failures of the test.
struct Replay {
  double x = 0, y = 0, z = 0, count[2] = {0, 0}, drawn_back[2] = {0, 0}, fed[2] = {0, 0};
  int tool = 0;
  bool relative = false;       // of E
  bool relative_axes = false;  // of X, Y and Z
  struct Road {
    int tool;
    Vec2 from, to;  // as in the file
    double z, filament, feed;
  };
  std::vector<Road> roads;
  std::vector<double> travels;  // length of each
  std::vector<int> tools;       // as selected
};

Replay replayed(const std::string& text, const Config& c) {
  Replay r;
  double feed = 0, travel = 0;
  bool drawn_back_at_start = false;
  for (const Line& l : parsed(text)) {
    if (l.code == "M83") r.relative = true;
    if (l.code == "G90" || l.code == "G91") r.relative = r.relative_axes = l.code == "G91";  // Marlin: E, too
    if (l.code == "G92") r.count[0] = r.count[1] = 0;
    const bool by_word = l.code == "T0" || l.code == "T1";
    if (by_word || (l.code == "M108" && l.has('T'))) {
      r.tool = by_word ? l.code[1] - '0' : int(l.words.at('T'));
      r.tools.push_back(r.tool);
    }
    if (l.code != "G1") continue;
    if (l.has('F')) feed = l.words.at('F');
    const Vec2 from{r.x, r.y};
    const double z = r.z;
    for (const auto& [axis, at] : {std::pair{'X', &r.x}, {'Y', &r.y}, {'Z', &r.z}})
      if (l.has(axis)) *at = l.words.at(axis) + (r.relative_axes ? *at : 0);
    const auto t = std::size_t(r.tool);
    double e = 0;
    for (const char axis : {'E', 'A', 'B'})
      if (l.has(axis)) {
        EXPECT_TRUE(axis == 'E' || axis == 'A' + r.tool) << "the filament of the other tool is moved";
        e = r.relative ? l.words.at(axis) : l.words.at(axis) - r.count[t];
        r.count[t] += e;
      }
    const double moved = distance(from, {r.x, r.y});
    if (moved == 0) {
      EXPECT_FALSE(e > 0 && r.z != z) << "extrudes while going up or down";
      r.drawn_back[t] -= e;
      EXPECT_LT(r.drawn_back[t],
                std::max(c.extruders[t].retract_length_mm, c.extruders[t].retract_length_toolchange_mm) + 1e-6);
      continue;
    }
    if (e > 0) {
      EXPECT_NEAR(r.drawn_back[t], 0, 1e-9) << "extrudes with the filament drawn back";
      EXPECT_TRUE(drawn_back_at_start || travel < c.extruders[t].retract_before_travel_mm) << "travel of " << travel;
      travel = 0;
      r.fed[t] += e;
      r.roads.push_back({r.tool, from, {r.x, r.y}, r.z, e, feed});
    } else {
      EXPECT_EQ(e, 0);
      if (travel == 0) drawn_back_at_start = r.drawn_back[t] > 0;
      travel += moved;
      r.travels.push_back(moved);
    }
  }
  return r;
}

class WriterTest : public testing::TestWithParam<Flavour> {
 protected:
  Config config = two_extruders(GetParam(), GetParam() == Flavour::klipper ? OffsetsIn::slicer : OffsetsIn::firmware);
};

}  // namespace

TEST_P(WriterTest, EveryTravelIsDrivenWithTheFilamentDrawnBackAndNothingElseIs) {
  for (const bool relative : {false, true})
    for (const bool stacked : {false, true}) {
      SCOPED_TRACE(relative * 2 + stacked);
      config.use_relative_e_distances = relative;
      const Replay r = replayed(written(config, two_cubes(10, stacked)).text, config);
      EXPECT_GT(r.roads.size(), 100u);
      EXPECT_GT(r.travels.size(), 10u);
    }
}

TEST_P(WriterTest, PositionInTheFileIsPositionInTheModelMinusTheOffsetThatTheSlicerTakesOff) {
  const auto layers = two_cubes(4, false);
  const Replay r = replayed(written(config, layers).text, config);
  std::size_t next = 0;
  for (const Layer& layer : layers)
    for (const Path& p : layer.paths)
      for (std::size_t i = 0; i < p.segments(); ++i) {
        ASSERT_LT(next, r.roads.size());
        const Replay::Road& road = r.roads[next++];
        const double shift = GetParam() == Flavour::klipper && p.extruder == 1 ? 33 : 0;
        EXPECT_EQ(road.tool, p.extruder);
        EXPECT_NEAR(distance(road.from + Vec2{shift, 0}, p.points[i]), 0, 1e-3);
        EXPECT_NEAR(distance(road.to + Vec2{shift, 0}, p.points[(i + 1) % p.points.size()]), 0, 1e-3);
        EXPECT_NEAR(road.z, layer.print_z_mm, 1e-9);
      }
  EXPECT_EQ(next, r.roads.size());
}

TEST_P(WriterTest, FilamentIsAreaTimesLengthAndAgreesWithTheFigures) {
  config.extruders[1].extrusion_multiplier = 0.9;
  config.extruders[1].filament_diameter_mm = 2.85;
  config.extruders[1].filament_density_g_cm3 = 1.04;
  const auto layers = two_cubes(10, false);
  const Written w = written(config, layers);
  const Replay r = replayed(w.text, config);
  double expected_mm3[2] = {0, 0};
  for (const Layer& l : layers)
    for (const Path& p : l.paths) expected_mm3[p.extruder] += volume_mm3(p) * (p.extruder == 1 ? 0.9 : 1);
  for (std::size_t t = 0; t < 2; ++t) {
    const double area = M_PI / 4 * std::pow(config.extruders[t].filament_diameter_mm, 2);
    EXPECT_NEAR(r.fed[t] * area, expected_mm3[t], 1e-3);
    EXPECT_NEAR(w.figures.extruders[t].length_mm, r.fed[t], 1e-6);
    EXPECT_NEAR(w.figures.extruders[t].volume_mm3, expected_mm3[t], 1e-3);
  }
  EXPECT_NEAR(w.figures.extruders[1].weight_g, expected_mm3[1] * 1.04e-3, 1e-6);
}

TEST_P(WriterTest, StackedCubesChangeTheToolOnceAndNeitherPrintsInTheOther) {
  const Written w = written(config, two_cubes(20, true));
  const Replay r = replayed(w.text, config);
  EXPECT_EQ(w.figures.tool_changes, 1);
  EXPECT_EQ(r.tools, (std::vector<int>{0, 1}));
  for (const Replay::Road& road : r.roads) EXPECT_EQ(road.tool == 1, road.z > 3.01);
}

TEST_P(WriterTest, LiftedNozzleNeverExtrudes) {
  for (Extruder& e : config.extruders) e.retract_lift_mm = 0.4;
  const Replay r = replayed(written(config, two_cubes(6, false)).text, config);
  for (const Replay::Road& road : r.roads) {
    const double layers = road.z / 0.3;
    EXPECT_NEAR(layers, std::round(layers), 1e-6) << "at z " << road.z;
  }
}

TEST_P(WriterTest, CodeOfTheUserThatMovesTheCarriageNeverMovesThePrint) {
  for (std::string Config::* code : {&Config::toolchange_gcode, &Config::before_layer_gcode, &Config::layer_gcode})
    for (const char* text : {"G91\nG1 Z5 F600\nG90", "G1 X7 Y-3 Z0.1 F600"})
      for (const double lift_mm : {0.0, 0.4}) {
        SCOPED_TRACE(text);
        Config c = config;
        c.*code = text;
        c.use_relative_e_distances = lift_mm > 0;
        for (Extruder& e : c.extruders) e.retract_lift_mm = lift_mm, e.retract_before_travel_mm = 1e6;
        const auto layers = two_cubes(4, false);
        const Written w = written(c, layers);
        const Replay r = replayed(w.text, c);
        for (std::size_t t = 0; t < 2; ++t) EXPECT_NEAR(r.fed[t], w.figures.extruders[t].length_mm, 1e-6);
        std::size_t next = 0;
        for (const Layer& layer : layers)
          for (const Path& p : layer.paths)
            for (std::size_t i = 0; i < p.segments(); ++i) {
              ASSERT_LT(next, r.roads.size());
              EXPECT_NEAR(r.roads[next].z, layer.print_z_mm, 1e-9);
              EXPECT_NEAR(distance(r.roads[next].from, r.roads[next].to),
                          distance(p.points[i], p.points[(i + 1) % p.points.size()]), 2e-3);
              ++next;
            }
        EXPECT_EQ(next, r.roads.size());
      }
}

TEST_P(WriterTest, ExtraPlasticAfterATravelAndAToolChangeIsPushedOnTop) {
  config.use_relative_e_distances = true;
  if (GetParam() == Flavour::sailfish) return;  // always absolute
  config.extruders[0].retract_restart_extra_toolchange_mm = 0.7;
  std::vector<Layer> layers = two_cubes(1, false);
  const std::string text = written(config, layers).text;
  EXPECT_NE(text.find("G1 E-1 F1500\n"), std::string::npos);
  EXPECT_EQ(text.find("G1 E1.7 F1500\n"), std::string::npos);  // T0 does not come back after its only change
  layers = two_cubes(4, false);
  EXPECT_NE(written(config, layers).text.find("G1 E1.7 F1500\n"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Flavours, WriterTest,
                         testing::Values(Flavour::marlin2, Flavour::klipper, Flavour::reprapfirmware,
                                         Flavour::sailfish));

TEST(Writer, SameJobGivesTheSameBytes) {
  const Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
  EXPECT_EQ(written(c, two_cubes(30, false)).text, written(c, two_cubes(30, false)).text);
}

TEST(Writer, LongCountsAreSetBackWithoutLosingAnything) {
  Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
  std::vector<Layer> layers = two_cubes(12, true);
  for (Layer& l : layers)
    for (Path& p : l.paths) p.stretches[0].road.area_mm2 = 10;
  const Written w = written(c, layers);
  const Replay r = replayed(w.text, c);
  EXPECT_GT(r.fed[0], 1000);
  EXPECT_NEAR(r.fed[0], w.figures.extruders[0].length_mm, 1e-6);
  for (const Line& l : parsed(w.text)) EXPECT_TRUE(!l.has('E') || l.words.at('E') < 2000);
}

TEST(Writer, TravelGoesByWayOfItsPoints) {
  const Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
  Layer layer{.index = 0, .print_z_mm = 0.3, .height_mm = 0.3, .paths = {}, .fan_by_extruder = {}};
  layer.paths = {square(0, {10, 10}, 10), square(0, {50, 10}, 10)};
  layer.paths[1].travel = {{10, 40}, {50, 40}};
  EXPECT_NE(written(c, {layer}).text.find("G1 Y40 F7200\nG1 X50\nG1 Y10\n"), std::string::npos);
}

TEST(Writer, OneStretchFollowsTheOtherInOnePathWithoutTravel) {
  Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
  Layer layer{.index = 3,
              .print_z_mm = 1.2,
              .height_mm = 0.3,
              .paths = {square(0, {10, 10}, 10)},
              .fan_by_extruder = {0.5, 0.5}};
  Road bridge = road(Role::overhang_perimeter);
  bridge.width_mm = bridge.height_mm = 0.4;
  bridge.speed_mm_s = 20;
  layer.paths[0].stretches.push_back({2, bridge});
  EXPECT_NE(written(c, {layer}).text.find(R"(G1 Y20 E.8315
;TYPE:Overhang perimeter
;HEIGHT:0.4
M106 S255
G1 X10 E1.24726 F1200
)"),
            std::string::npos)
      << written(c, {layer}).text;
}

TEST(Writer, NothingIsMeltedFasterThanTheFilamentAllows) {
  Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
  c.extruders[0].filament_max_volumetric_speed_mm3_s = 2;  // 0.1 mm2 at 30 mm/s would be 3
  c.max_volumetric_speed_mm3_s = 2.5;
  for (const Replay::Road& r : replayed(written(c, two_cubes(2, false)).text, c).roads)
    EXPECT_NEAR(r.feed, r.tool == 0 ? 20 * 60 : 25 * 60, 1e-6);
}

TEST(Writer, AccelerationsFollowTheRoles) {
  Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
  c.default_acceleration_mm_s2 = 1000;
  c.perimeter_acceleration_mm_s2 = 800;
  c.infill_acceleration_mm_s2 = 1200;
  c.first_layer_acceleration_mm_s2 = 500;
  const std::string text = written(c, two_cubes(2, true)).text;
  const std::size_t second = text.find(";Z:0.6");
  EXPECT_EQ(text.find("M204 P800"), text.find("M204 P800", second));
  EXPECT_LT(text.find("M204 P500"), second);
  EXPECT_NE(text.find("M204 P1200", second), std::string::npos);
}

TEST(Writer, AccelerationOfTravelIsToldOnceBeforeThatOfRoadsWhereThereIsOne) {
  for (const Flavour flavour : {Flavour::marlin2, Flavour::reprapfirmware}) {
    Config c = two_extruders(flavour, OffsetsIn::firmware);
    EXPECT_EQ(written(c, two_cubes(2, true)).text.find("M204"), std::string::npos);
    c.perimeter_acceleration_mm_s2 = 800;
    c.machine_max_acceleration_travel_mm_s2 = 2500;
    const std::string text = written(c, two_cubes(2, true)).text;
    EXPECT_EQ(text.find("M204"), text.find("M204 T2500\nM204 P800\n"));
    EXPECT_EQ(text.find("M204 T"), text.rfind("M204 T"));
    c.machine_max_acceleration_travel_mm_s2 = 0;
    EXPECT_EQ(written(c, two_cubes(2, true)).text.find("M204 T"), std::string::npos);
  }
}

TEST(Writer, OnKlipperTravelTakesItsTimeAtTheAccelerationOfTheRoads) {
  Layer layer{.index = 0, .print_z_mm = 0.3, .height_mm = 0.3, .paths = {}, .fan_by_extruder = {}};
  layer.paths = {square(0, {0, 0}, 10), square(0, {150, 0}, 10)};
  const auto time_s = [&](Flavour flavour) {
    Config c = two_extruders(flavour, OffsetsIn::firmware);
    c.default_acceleration_mm_s2 = 50;
    return written(c, {layer}).figures.time_s;
  };
  // 150 mm at 120 mm/s: there is room for ramps of 1500 mm/s2, but at 50 mm/s2 only for half and half.
  const double own_s = 150 / 120.0 + 120 / 1500.0, as_roads_s = 2 * std::sqrt(150 / 50.0);
  EXPECT_NEAR(time_s(Flavour::klipper) - time_s(Flavour::marlin2), as_roads_s - own_s, 0.3);
}

TEST(Writer, AccelerationOf0AlongMovesOfOneKindIsLimitedByTheAxesOnly) {
  const auto layers = two_cubes(2, false);
  for (double Config::* limit :
       {&Config::machine_max_acceleration_extruding_mm_s2, &Config::machine_max_acceleration_travel_mm_s2,
        &Config::machine_max_acceleration_retracting_mm_s2}) {
    Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
    const double limited_s = written(c, layers).figures.time_s;
    c.*limit = 1e9;
    const double unlimited_s = written(c, layers).figures.time_s;
    c.*limit = 0;
    EXPECT_NEAR(written(c, layers).figures.time_s, unlimited_s, 1e-9);
    EXPECT_LT(unlimited_s, limited_s);
    EXPECT_GT(unlimited_s, 0);
  }
}

TEST(Writer, ProgressStaysWithinItsDigitsHoweverLongThePrint) {
  Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
  c.remaining_times = true;
  auto layers = two_cubes(1, true);
  for (const double speed_mm_s : {1e-9, 1e-308}) {  // years, and longer than a double counts
    for (Path& p : layers[0].paths) p.stretches[0].road.speed_mm_s = speed_mm_s;
    for (const Line& l : parsed(written(c, layers).text))
      if (l.code == "M73") {
        EXPECT_TRUE(l.words.at('P') >= 0 && l.words.at('P') <= 100) << l.words.at('P');
        EXPECT_TRUE(l.words.at('R') >= 0 && l.words.at('R') <= 99999) << l.words.at('R');
      }
  }
}

TEST(Writer, OnlyExtrudersThatPrintAreHeated) {
  const Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
  std::vector<Layer> layers = two_cubes(2, true);
  for (Layer& l : layers)
    for (Path& p : l.paths) p.extruder = 1;
  const std::string text = written(c, layers).text;
  EXPECT_EQ(text.find("M104 S215 T0"), std::string::npos);
  EXPECT_NE(text.find("M104 S215 T1"), std::string::npos);
  EXPECT_NE(text.find("T1 S1\n"), std::string::npos);
  EXPECT_EQ(text.find("T0 S1\n"), std::string::npos);
}

TEST(Writer, TemperaturesThatTheStartCodeSetsAreNotSetAgain) {
  Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
  c.start_gcode =
      "M190 S{first_layer_bed_temperature[0]}\nM109 S{first_layer_temperature[0]} T0\nM109 "
      "S[first_layer_temperature_1] T1\nT0";
  const std::string text = written(c, two_cubes(1, false)).text;
  EXPECT_EQ(text.find("M109 S215 T0"), text.rfind("M109 S215 T0"));
  EXPECT_EQ(text.find("M104 S215"), std::string::npos);
  EXPECT_EQ(text.find("M140"), std::string::npos);
  EXPECT_EQ(text.find("T0 S1"), std::string::npos);  // and the tool is selected already
}

TEST(Writer, ToolChangeTemplateThatChangesTheToolReplacesTheWord) {
  Config c = two_extruders(Flavour::klipper, OffsetsIn::slicer);
  const auto with = [&](const char* code) {
    c.toolchange_gcode = code;
    return body(written(c, two_cubes(2, true)).text);
  };
  EXPECT_NE(with("; {previous_extruder} to [next_extruder] at {toolchange_z}").find("; 0 to 1 at 0.6\nT1\n"),
            std::string::npos);
  const std::string own = with("PARK\nT{next_extruder}");
  EXPECT_NE(own.find("PARK\nT1\n"), std::string::npos);
  EXPECT_EQ(own.find("\nT1\n"), own.rfind("\nT1\n"));
}

TEST(Writer, FirstToolIsChosenByTheToolChangeTemplateToo) {
  Config c = two_extruders(Flavour::klipper, OffsetsIn::slicer);
  c.toolchange_gcode =
      "ACTIVATE_EXTRUDER EXTRUDER=extruder{if next_extruder > 0}{next_extruder}{endif} ; {previous_extruder}";
  const std::string text = written(c, two_cubes(2, true)).text;
  EXPECT_LT(text.find("ACTIVATE_EXTRUDER EXTRUDER=extruder ; -1\n"), text.find(";LAYER_CHANGE"));
  EXPECT_NE(text.find("ACTIVATE_EXTRUDER EXTRUDER=extruder1 ; 0\n"), std::string::npos);
  EXPECT_EQ(text.find("\nT"), std::string::npos);
}

TEST(Writer, HeatersGoOffAfterTheLastUseAlsoWhereTheLastLayerHasNothingToPrint) {
  const Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
  std::vector<Layer> layers = two_cubes(6, true);
  PrintInfo info = info_of(c, layers);
  info.last_layer[0] = 4;  // two layers more than it has paths
  std::string text;
  GcodeWriter writer(c, info, to_string(text));
  for (const Layer& l : layers) writer.layer(l);
  writer.finish();
  EXPECT_GT(text.find("M104 S0 T0\n"), text.find(";Z:1.5\n"));
  EXPECT_LT(text.find("M104 S0 T0\n"), text.find(";Z:1.8\n"));
  EXPECT_EQ(text.find("M104 S0 T1\n"), std::string::npos);  // left to the end code
}

TEST(Writer, AfterAToolChangeXAndYAreBothTold) {
  const Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
  Layer layer{.index = 0, .print_z_mm = 0.3, .height_mm = 0.3, .paths = {}, .fan_by_extruder = {}};
  layer.paths = {square(0, {10, 10}, 10), square(1, {43, 10}, 10)};  // the new nozzle already stands there
  const std::string text = written(c, {layer}).text;
  EXPECT_NE(text.find("G1 X43 Y10", text.find("T1 S1")), std::string::npos) << text;
}

TEST(Writer, RemainingTimeFallsToZeroAndProgressEndsAtHundred) {
  Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
  c.remaining_times = true;
  const Written w = written(c, two_cubes(60, false));
  double percent = -1, minutes = 1e9;
  int told = 0;
  bool ended = false;
  for (const Line& l : parsed(w.text)) {
    EXPECT_FALSE(ended && l.code == "G1" && (l.has('X') || l.has('Y'))) << "moves after P100";
    if (l.code != "M73") continue;
    ++told;
    EXPECT_GE(l.words.at('P'), percent);
    EXPECT_LE(l.words.at('R'), minutes);
    percent = l.words.at('P'), minutes = l.words.at('R');
    ended = percent == 100;
  }
  EXPECT_EQ(percent, 100);
  EXPECT_EQ(minutes, 0);
  EXPECT_GT(told, int(w.figures.time_s / 60));
  EXPECT_LT(told, int(w.figures.time_s / 20) + 3);
}

TEST(Writer, ClosingCommentsTellWhatTheFiguresTell) {
  const Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
  const Written w = written(c, two_cubes(60, false));
  char expected[200];
  std::snprintf(expected, sizeof expected, "; filament used [mm] = %.2f, %.2f\n", w.figures.extruders[0].length_mm,
                w.figures.extruders[1].length_mm);
  EXPECT_NE(w.text.find(expected), std::string::npos);
  const long s = std::lround(w.figures.time_s);
  std::snprintf(expected, sizeof expected, "; estimated printing time (normal mode) = %ldm %lds\n", s / 60, s % 60);
  EXPECT_NE(w.text.find(expected), std::string::npos) << expected;
  EXPECT_NE(w.text.find("; total toolchanges = 60\n"), std::string::npos);
  EXPECT_NE(w.text.find("; prusaslicer_config = begin\n; "), std::string::npos);
  EXPECT_TRUE(w.text.ends_with("; prusaslicer_config = end\n"));
  EXPECT_NE(w.text.find("\n; extruder_offset = 0x0,0x0\n"), std::string::npos);
}

TEST(Writer, ThumbnailsStandInTheHeadInPrusaSlicersForm) {
  const Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
  const auto layers = two_cubes(1, false);
  PrintInfo info = info_of(c, layers);
  info.thumbnails = {{16, 16, std::string(90, '\0')}};
  std::string text;
  GcodeWriter writer(c, info, to_string(text));
  writer.layer(layers[0]);
  writer.finish();
  EXPECT_NE(text.find("\n;\n; thumbnail begin 16x16 120\n; " + std::string(78, 'A') + "\n; " + std::string(42, 'A') +
                      "\n; thumbnail end\n;\n"),
            std::string::npos);
}

TEST(Writer, ANameCannotBecomeGcode) {
  const Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
  const auto layers = two_cubes(1, false);
  PrintInfo info = info_of(c, layers);
  info.name = "a\nM104 S300";
  std::string text;
  GcodeWriter writer(c, info, to_string(text));
  writer.layer(layers[0]);
  writer.finish();
  EXPECT_EQ(text.find("\nM104 S300"), std::string::npos);
}

TEST(Writer, AnUnknownPlaceholderNamesItsTemplate) {
  Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
  c.layer_gcode = "M117 [layer_number]";
  try {
    written(c, two_cubes(1, false));
    FAIL() << "accepted";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("layer_gcode"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("layer_number"), std::string::npos);
  }
}

TEST(Writer, RandomJobsKeepAllRules) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Config c = two_extruders(Flavour(seed % 4), seed % 4 == 1 ? OffsetsIn::slicer : OffsetsIn::firmware);
    c.use_relative_e_distances = random() % 2;
    for (Extruder& e : c.extruders) {
      e.retract_length_mm = double(random() % 4) * 0.5;
      e.retract_length_toolchange_mm = double(random() % 4) * 0.5;
      e.retract_before_travel_mm = double(random() % 5);
      if (e.retract_length_mm == 0) e.retract_before_travel_mm = 1e6;
      e.retract_lift_mm = double(random() % 2) * 0.3;
      e.retract_layer_change = random() % 2;
    }
    std::vector<Layer> layers;
    for (int i = 0; i < 12; ++i) {
      Layer l{.index = i, .print_z_mm = 0.3 * (i + 1), .height_mm = 0.3, .paths = {}, .fan_by_extruder = {0, 1}};
      for (unsigned k = i == 0 ? 1 : 0; k < random() % 6; ++k) {
        const Vec2 at{double(random() % 500) / 10, double(random() % 500) / 10};
        l.paths.push_back(random() % 2 ? square(int(random() % 2), at, double(1 + random() % 20))
                                       : zigzag(int(random() % 2), at, 10, 1));
      }
      if (i == 0 && l.paths.empty()) l.paths.push_back(square(0, {1, 1}, 5));
      layers.push_back(std::move(l));
    }
    const Written w = written(c, layers);
    const Replay r = replayed(w.text, c);
    for (std::size_t t = 0; t < 2; ++t) EXPECT_NEAR(r.fed[t], w.figures.extruders[t].length_mm, 1e-6);
    for (const Replay::Road& road : r.roads) EXPECT_NEAR(road.z / 0.3, std::round(road.z / 0.3), 1e-6);
  }
}
