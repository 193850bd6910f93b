#include "audit/audit.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "drawn.hpp"
#include "reader/read.hpp"
#include "sanitized.hpp"
#include "support_errors.hpp"

using namespace cleancolor;

namespace {

const std::vector<Vec2> two{{0, 0}, {10, 0}};

/// Towers of both colours side by side, 6 x 12 mm; T1 hangs 4 mm to the right of T0, so that each nozzle often passes
/// over the other's.
Drawing towers(int layers) {
  Drawing d(drawn_machine({{0, 0}, {4, 0}}));
  for (int layer = 0; layer < layers; ++layer) {
    d.layer(layer);
    for (const int tool : layer % 2 ? std::array{1, 0} : std::array{0, 1}) {
      const double x = 8.0 * tool;
      d.tool(tool).wall().go({x, 0}).lay({x + 6, 0}).lay({x + 6, 12}).lay({x, 12}).lay({x, 0}).feed(-1);
      d.go({x + 1, 1}).feed(1).infill();
      for (int i = 0; i < 8; ++i) d.lay({x + (i % 2 ? 1 : 5), 1 + 1.2 * i});
    }
  }
  return d;
}

void expect_equal(const AuditResult& a, const AuditResult& b) {
  ASSERT_EQ(a.scenarios.size(), b.scenarios.size());
  for (std::size_t s = 0; s < a.scenarios.size(); ++s) {
    const ScenarioResult &x = a.scenarios[s], &y = b.scenarios[s];
    for (const FigureInfo& f : figure_table()) EXPECT_EQ(f.of(x.total), f.of(y.total)) << x.name << " " << f.name;
    ASSERT_EQ(x.places.size(), y.places.size());
    for (std::size_t i = 0; i < x.places.size(); ++i) {
      EXPECT_EQ(x.places[i].mm3, y.places[i].mm3);
      EXPECT_EQ(x.places[i].at_mm, y.places[i].at_mm);
    }
  }
  EXPECT_EQ(a.print_time_s, b.print_time_s);
}

AuditOptions with_threads(int threads) {
  AuditOptions options;
  options.scenarios = scenarios(true);
  options.threads = threads;
  return options;
}

const ScenarioResult& scenario(const AuditResult& result, const std::string& name) {
  for (const ScenarioResult& s : result.scenarios)
    if (s.name == name) return s;
  throw Error("no scenario " + name);
}

}  // namespace

TEST(Audit, HasTheSameFiguresForAnyNumberOfThreads) {
  const Drawing d = towers(40);
  const AuditResult one = audited(d, with_threads(1));
  EXPECT_GT(one.scenarios[0].total.smear_volume(), 1);
  for (const int threads : {2, 3, 8}) expect_equal(one, audited(d, with_threads(threads)));
}

TEST(Audit, PairsAndLayersAddUpToTheTotal) {
  const AuditResult result = audited(towers(20), with_threads(2));
  for (const ScenarioResult& s : result.scenarios) {
    SCOPED_TRACE(s.name);
    Figures pairs, layers;
    for (const PairFigures& p : s.pairs) pairs += p.figures;
    for (const Figures& f : s.layers) layers += f;
    EXPECT_EQ(s.layers.size(), 20u);
    for (const FigureInfo& f : figure_table()) EXPECT_NEAR(f.of(layers), f.of(s.total), 1e-9) << f.name;
    EXPECT_NEAR(pairs.smear_volume(), s.total.smear_volume(), 1e-9);
    EXPECT_NEAR(pairs.inner_volume(), s.total.inner_volume(), 1e-9);
    EXPECT_NEAR(pairs.smear_exposure_print, s.total.smear_exposure_print, 1e-9);
  }
}

TEST(Audit, PlacesHoldWhatTheFiguresCount) {
  const ScenarioResult worst_case = audited(towers(20)).scenarios[0];
  double smear = 0, hole = 0, zippers = 0;
  EXPECT_GT(worst_case.total.smear_volume(), 1);
  for (const Place& p : worst_case.places) {
    if (p.kind == Place::Kind::smear) smear += double(p.mm3);
    if (p.kind == Place::Kind::hole) hole += double(p.mm3);
    zippers += p.kind == Place::Kind::zipper;
    EXPECT_TRUE(p.kind == Place::Kind::zipper || p.mm3 >= 0.001f);
  }
  // Places of less than 0.001 mm3 are left out.
  EXPECT_NEAR(smear, worst_case.total.smear_volume(), 0.1 * smear);
  EXPECT_LE(smear, worst_case.total.smear_volume() + 1e-6);
  EXPECT_NEAR(hole, worst_case.total.hole_volume, 0.1 * hole + 0.01);
  EXPECT_EQ(zippers, worst_case.total.zippers);
}

TEST(Audit, NoOozeIsLostOrMadeUp) {
  // T1 idles all the time after its first road; all that flows out is left somewhere, carried, or still to come: V.
  Drawing d(drawn_machine(two));
  d.layer(0).tool(1).wall().road({100, 0}, {105, 0}).tool(0);
  for (int i = 0; i < 30; ++i) d.road({0, 0.5 * i}, {40, 0.5 * i});
  const Figures f = worst(d);
  EXPECT_GT(f.smear_exposure_print, 100);
  EXPECT_NEAR(f.smear_volume() + f.inner_volume(), 2, 0.02) << "after 120 s";
}

TEST(Audit, FilamentIsCountedByRoleAndNetOfRetractions) {
  Drawing d(drawn_machine(two));
  d.layer(0).tool(0).skirt().road({-20, 0}, {-10, 0}).wall().go({0, 0}).feed(-2).feed(2).lay({30, 0}).feed(-2);
  d.tool(1).go({40, 0}).feed(0.5).lay({45, 0});
  const AuditResult result = audited(d);
  const double mm3_per_mm = drawn_area_mm2;
  ASSERT_EQ(result.nozzles.size(), 2u);
  EXPECT_NEAR(result.nozzles[0].auxiliary_mm3, 10 * mm3_per_mm, 1e-4);
  EXPECT_NEAR(result.nozzles[0].part_mm3, 30 * mm3_per_mm, 1e-4);
  EXPECT_NEAR(result.nozzles[0].part_filament_mm, 30 * mm3_per_mm / drawn_filament_mm2, 1e-4);
  EXPECT_NEAR(result.nozzles[0].part_g, 30 * mm3_per_mm * 1.24e-3, 1e-6);
  EXPECT_NEAR(result.nozzles[1].part_mm3, 5 * mm3_per_mm, 1e-4);
  EXPECT_NEAR(result.nozzles[1].auxiliary_filament_mm, 0.5, 1e-4) << "pushed in place";
}

TEST(Audit, ALayerThatIsVisitedAgainAndAgainIsOneLayer) {
  // Two objects of two layers, printed one after the other: T1's tip crosses the first while the second is printed.
  const auto object = [](Drawing& d, double y) {
    for (const int layer : {0, 1})
      d.layer(layer).tool(0).wall().road({20, y}, {20, y + 10}).road({5, y + 5}, {14, y + 5});
  };
  Drawing sequential(drawn_machine(two));
  object(sequential, 0);
  object(sequential, 40);
  sequential.tool(1).road({60, 80}, {60, 85});
  const AuditResult result = audited(sequential);
  EXPECT_EQ(result.layers, 2);
  EXPECT_NEAR(result.scenarios[0].total.smear_exposure_print, 4 * 0.4, 0.002);
  // The chord of each straight way from the upright wall to the other, and the ways from object to object meet none.
  EXPECT_NEAR(result.scenarios[0].layers[0].smear_exposure_print, 0.8, 0.001);
}

TEST(Audit, AFileWithoutCommentsIsJudgedByItsGeometry) {
  const Drawing d = towers(10);
  std::string text = d.text(), bare;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    if (text[at] != ';') bare += text.substr(at, end + 1 - at);
    at = end + 1;
  }
  const AuditResult labelled = audited(d), blank = audit(read_gcode(bare, "bare.gcode"), d.machine(), only_worst());
  const Figures &a = labelled.scenarios[0].total, &b = blank.scenarios[0].total;
  EXPECT_GT(a.smear_volume(), 1);
  EXPECT_NEAR(b.smear_volume(), a.smear_volume(), 0.1 * a.smear_volume());
  EXPECT_NEAR(b.smear_exposure_print, a.smear_exposure_print, 0.1 * a.smear_exposure_print);
  EXPECT_EQ(blank.nozzles[0].auxiliary_mm3, 0);
}

TEST(Audit, RefillsAreCountedByPass) {
  Drawing d(drawn_machine(two));
  d.layer(0).tool(0).wall().road({0, 0}, {10, 0});
  GcodePrint print = d.road({20, 0}, {30, 0}).lay({30, 1}).road({40, 0}, {50, 0}).print();
  // The reader knows refill by our own dialect; here it is said by hand: the second and third road.
  for (std::size_t i = 3; i < print.moves.size(); ++i) print.moves[i].role = i < 6 ? Role::refill : Role::perimeter;
  const Figures f = audit(print, d.machine(), only_worst()).scenarios[0].total;
  EXPECT_EQ(f.refills, 1);
  EXPECT_NEAR(f.refill_volume, 11 * drawn_area_mm2, 1e-4);
}

TEST(Audit, ModelKnowsZHopsAndTemperatures) {
  // The tip of T1 passes over W on the way to A, and while T0 lays A; lifted by 1 mm on its way it touches nothing, on
  // the model's account.
  const auto print = [](double hop_mm, const std::string& waiting) {
    Drawing d(drawn_machine(two));
    d.line("M109 S200 T0\nM109 S200 T1").layer(0).tool(0).wall().road({20, 0}, {20, 10}).line(waiting);
    d.line(fmt::format("G1 Z{:.2f} F60000", 0.2 + hop_mm)).go({5, 5}).line("G1 Z0.2 F60000").lay({14, 5});
    return d.line("M109 S200 T1").tool(1).wall().road({60, 0}, {60, 5});
  };
  const auto exposure = [&](double hop_mm, std::size_t s) {
    return audited(print(hop_mm, ""), with_threads(1)).scenarios[s].total.smear_exposure_travel;
  };
  EXPECT_GT(exposure(0.5, 1), 0.4);
  EXPECT_EQ(exposure(1, 1), 0);
  EXPECT_GT(exposure(1, 0), 0.4) << "worst does not trust hops";

  const auto left = [&](const std::string& waiting, std::size_t s) {
    const Figures f = audited(print(0, waiting), with_threads(1)).scenarios[s].total;
    return f.smear_volume() + f.inner_volume();
  };
  // 60 degrees cooler within 30 s: 2^-6 = a 64th as fast. Flowing like hot: for 30 (1 - 1/64) / (6 ln 2) = 7.1 s on the
  // way down, and 30 / 64 = 0.5 s at the end, instead of 60 s.
  const double hot = left("G4 S60", 1), cool = left("M104 S140 T1\nG4 S60", 1);
  EXPECT_NEAR(cool / hot, (1 - std::exp(-(7.57 + 1) / 40)) / (1 - std::exp(-61.0 / 40)), 0.04);
  EXPECT_EQ(left("M104 S140 T1\nG4 S60", 0), left("G4 S60", 0)) << "worst does not trust standby";
}

TEST(Audit, VariantsMoveTheFiguresTheWayTheySay) {
  const AuditResult result = audited(towers(20), with_threads(2));
  const auto smear = [&](const std::string& name) { return scenario(result, name).total.smear_volume(); };
  EXPECT_GT(smear("tireless"), smear("worst"));
  EXPECT_LT(scenario(result, "printed_only").total.smear_exposure_print,
            scenario(result, "worst").total.smear_exposure_print);
  EXPECT_EQ(scenario(result, "own_does_not_empty").total.own_volume, 0);
  EXPECT_GT(smear("own_does_not_empty"), smear("worst"));
  EXPECT_NE(smear("touch_2mm"), smear("worst"));
  EXPECT_EQ(scenario(result, "tireless").total.smear_exposure_print,
            scenario(result, "worst").total.smear_exposure_print);
}

TEST(Audit, EveryScenarioHasAnExplanationAndAName) {
  for (const Scenario& s : scenarios(true)) {
    EXPECT_FALSE(s.help.empty()) << s.name;
    ASSERT_EQ(s.ooze.size(), 1u);
  }
  EXPECT_EQ(scenarios().size(), 2u);
  EXPECT_EQ(scenarios(true).size(), 6u);
}

TEST(Audit, CanBeInterrupted) {
  Progress progress;
  progress.interrupted = [] { return true; };
  const Drawing d = towers(3);
  EXPECT_EQ(error_of([&] { (void)audit(d.print(), d.machine(), {}, progress); }), "interrupted");
}

TEST(Audit, NonsenseOfAnyKindGivesFiniteFigures) {
  int read = 0;
  for (unsigned seed = 0; seed < unsigned(test::trials(200)); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto below = [&](int n) { return int(random() % unsigned(n)); };
    const std::vector<Vec2> six{{0, 0}, {10, 0}, {0, 10}, {5, 5}, {-7, 0}, {1, 1}};
    Drawing d(drawn_machine(six, below(2) ? OffsetsIn::slicer : OffsetsIn::firmware));
    if (below(2)) d.marlin();
    d.layer(0).road({0, 0}, {1, 0});
    const char* odd[] = {"G28",        "T5",           "G92 X0 Y0 E0", "M109 S0 T1", "M104 S900 T9",
                         "G4 S1000",   "G1 Z-5",       "G1 Z90 E5",    "M205 X0 Y0", "M203 X0.001",
                         "M201 X1 Y1", ";TYPE:Custom", "G91",          "G1 F0.001",  "G1 E-500",
                         "G1 E900",    "G90",          ";WIDTH:9999",  ";HEIGHT:0",  "G10"};
    for (int i = 0; i < 60; ++i) {
      const auto point = [&] {
        const double size = seed % 20 == 0 && below(10) == 0 ? 4000 : 20;
        return Vec2{size * below(100) / 100, size * below(100) / 100};
      };
      switch (below(6)) {
        case 0:
          d.line(odd[below(int(std::size(odd)))]);
          break;
        case 1:
          d.tool(below(2));
          break;
        case 2:
          d.layer(below(4));
          break;
        case 3:
          d.go(point());
          break;
        default:
          d.lay(point());
      }
    }
    std::optional<GcodePrint> print;
    if (error_of([&] { print = d.print(); }) != "no error") continue;  // the reader refuses some of it
    ++read;
    const AuditResult result = audit(*print, d.machine(), with_threads(2));
    for (const ScenarioResult& s : result.scenarios)
      for (const FigureInfo& f : figure_table()) {
        EXPECT_TRUE(std::isfinite(f.of(s.total))) << f.name;
        EXPECT_GE(f.of(s.total), -1e-9) << f.name;
      }
  }
  EXPECT_GT(read, test::trials(100));
}

// 20 000 roads that all cross at one place, in one layer: every way meets every road.
TEST(Audit, APrintThatIsOneKnotEndsSoonAndSaysThatItLeftSomethingOut) {
  Drawing d(drawn_machine({{0, 0}, {1, 0}}));
  d.layer(0).tool(1).road({0, 0}, {20, 20}).tool(0);
  std::mt19937 random(1);
  for (int i = 0; i < 20'000; ++i) {
    const double y = double(random() % 20'000) / 1000;
    d.lay({i % 2 ? 0. : 20., y});
  }
  const AuditResult result = audited(d);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_NE(result.warnings[0].find("left out"), std::string::npos);
}

TEST(Audit, SaysWhereTheFileDoesNotTellWallsFromSkirts) {
  const auto warnings_of = [](const std::string& label) {
    const GcodePrint print = read_gcode("M83\n" + label + "G1 X0 Y0 Z0.2 F1200\nG1 X10 Y0 E1\n", "a.gcode");
    std::vector<std::string> told;
    Progress progress;
    progress.warn = [&](const std::string& warning) { told.push_back(warning); };
    const AuditResult result = audit(print, audit_machine(print, {}), {}, progress);
    EXPECT_EQ(result.warnings.size(), told.size());
    return told;
  };
  EXPECT_TRUE(warnings_of(";TYPE:External perimeter\n").empty());
  ASSERT_EQ(warnings_of("").size(), 1u);
  EXPECT_NE(warnings_of("")[0].find("does not say what is wall"), std::string::npos);
}

TEST(WorstPlaces, JoinsNeighboursOfOneKindAndSortsByAmount) {
  ScenarioResult result;
  const auto add = [&](Place::Kind kind, double x, float mm3, std::uint32_t layer = 0, std::uint8_t over = 1) {
    result.places.push_back(
        {.kind = kind, .nozzle = 0, .over = over, .mm3 = mm3, .layer = layer, .at_mm = {x, 0}, .end_mm = {}});
  };
  using Kind = Place::Kind;
  add(Kind::smear, 0, 0.1f);
  add(Kind::smear, 4, 0.3f);         // joined with the first
  add(Kind::smear, 20, 0.2f);        // too far
  add(Kind::smear, 4, 0.05f, 1);     // another layer
  add(Kind::smear, 4, 0.06f, 0, 2);  // another colour
  add(Kind::hole, 4, 0.25f);
  add(Kind::wipe, 4, 9);
  add(Kind::zipper, 4, 1);
  add(Kind::inner, 4, 9);
  const auto worst = worst_places(result, 10);
  ASSERT_EQ(worst.size(), 5u);
  EXPECT_NEAR(worst[0].mm3, 0.4, 1e-6);
  EXPECT_EQ(worst[0].at_mm, (Vec2{4, 0})) << "where most of it lies";
  EXPECT_EQ(worst[1].kind, Kind::hole);
  EXPECT_NEAR(worst[2].mm3, 0.2, 1e-6);
  EXPECT_EQ(worst_places(result, 2).size(), 2u);
  EXPECT_TRUE(worst_places({}, 3).empty());
}

TEST(Figures, TheTableNamesEveryFigureOnce) {
  std::vector<std::string_view> names;
  for (const FigureInfo& f : figure_table()) {
    EXPECT_EQ(find_figure(f.name), &f) << f.name;
    EXPECT_FALSE(f.help.empty());
    EXPECT_FALSE(f.unit.empty());
  }
  EXPECT_EQ(find_figure("beauty"), nullptr);
  // Each field of the struct is shown by exactly one figure of the table; two more are sums.
  constexpr std::size_t fields = sizeof(Figures) / sizeof(double);
  EXPECT_EQ(figure_table().size(), fields + 2);
  for (std::size_t k = 0; k < fields; ++k) {
    Figures f;
    reinterpret_cast<double*>(&f)[k] = 1;
    int shown = 0;
    for (const FigureInfo& info : figure_table()) shown += info.of(f) == 1;
    EXPECT_TRUE(shown == 1 || shown == 2) << k;
  }
}
