// cleancolor audit: what its words mean, and the program as a person starts it.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/command_line.hpp"
#include "outcome.hpp"
#include "viewer/page.hpp"

namespace cleancolor {
namespace {

using Words = std::vector<std::string>;

AuditCommand audit_of(Words words) {
  words.insert(words.begin(), "audit");
  return std::get<AuditCommand>(parse_command_line(words));
}

TEST(AuditArguments, HaveDefaults) {
  const AuditCommand command = audit_of({"a.gcode"});
  EXPECT_EQ(command.files, (std::vector<std::filesystem::path>{"a.gcode"}));
  EXPECT_TRUE(command.nozzle_offset_mm.empty());
  EXPECT_FALSE(command.offsets_in || command.idle_nozzle || command.layer);
  ASSERT_EQ(command.scenarios.size(), 2u);
  EXPECT_EQ(command.scenarios[command.scenario].name, "worst");
  EXPECT_EQ(command.places, 10u);
}

TEST(AuditArguments, SayWhereTheNozzlesAre) {
  const AuditCommand command = audit_of(
      {"a.gcode", "--nozzle-offset", "0x0,33x0,-1.5x.25", "--offsets-in", "firmware", "--idle-nozzle", "docked"});
  EXPECT_EQ(command.nozzle_offset_mm, (std::vector<Vec2>{{0, 0}, {33, 0}, {-1.5, 0.25}}));
  EXPECT_EQ(command.offsets_in, OffsetsIn::firmware);
  EXPECT_EQ(command.idle_nozzle, IdleNozzle::docked);
}

TEST(AuditArguments, SetOozeByNozzleAndScenario) {
  const AuditCommand command = audit_of({"a.gcode", "--sensitivity", "--ooze", "volume=2,3", "--ooze", "time=7",
                                         "--ooze", "model.elastic_time=0.4", "--ooze", "touch_height=inf"});
  for (const Scenario& s : command.scenarios) {
    SCOPED_TRACE(s.name);
    if (s.name == "model") {
      ASSERT_EQ(s.ooze.size(), 1u);
      EXPECT_EQ(s.ooze[0].elastic_time_s, 0.4);
      EXPECT_EQ(s.ooze[0].time_s, model_ooze().time_s);
      EXPECT_TRUE(s.help.ends_with("; here with elastic_time=0.4")) << s.help;
    } else {  // worst and its variants, which differ in rules alone
      ASSERT_EQ(s.ooze.size(), 2u);
      EXPECT_EQ(s.ooze[0].volume_mm3, 2);
      EXPECT_EQ(s.ooze[1].volume_mm3, 3);
      EXPECT_EQ(s.ooze[0].time_s, 7);
      EXPECT_EQ(s.ooze[1].time_s, 7);
      EXPECT_TRUE(std::isinf(s.ooze[1].touch_height_mm));
    }
  }
}

TEST(AuditArguments, LimitFiguresOfAnyScenario) {
  const AuditCommand command =
      audit_of({"a.gcode", "--scenario", "model", "--fail-over", "smear_volume=5", "--fail-over", "worst.zippers=100"});
  ASSERT_EQ(command.limits.size(), 2u);
  EXPECT_EQ(command.scenarios[command.limits[0].scenario].name, "model");
  EXPECT_EQ(command.limits[0].figure->name, "smear_volume");
  EXPECT_EQ(command.limits[0].most, 5);
  EXPECT_EQ(command.scenarios[command.limits[1].scenario].name, "worst");
  EXPECT_EQ(command.limits[1].figure->name, "zippers");
}

TEST(AuditArguments, CountLayersFromOne) {
  EXPECT_EQ(audit_of({"a.gcode", "--layer", "37", "--svg", "l.svg"}).layer, 36u);
}

TEST(AuditArguments, AreRefusedWithWhatToDo) {
  struct Case {
    Words words;
    const char* message;
  };
  const Case cases[] = {
      {{}, "name at least one G-code file"},
      {{"a", "--nozzle-offset", "33"}, "'33' is not like 33x0"},
      {{"a", "--nozzle-offset", "0x0,nanx0"}, "'nanx0' is not like 33x0"},
      {{"a", "--nozzle-offset", "0x0,"}, "'' is not like 33x0"},
      {{"a", "--nozzle-offset", "1x0,33x0"}, "the first nozzle is at 0x0"},
      {{"a", "--offsets-in", "printer"}, "'printer' is none of slicer, firmware"},
      {{"a", "--idle-nozzle", "gone"}, "none of same_height, lifted, parked, docked"},
      {{"a", "--scenario", "best"}, "there is no scenario 'best'; there are worst, model, and more with --sensitivity"},
      {{"a", "--ooze", "volume"}, "'volume' has no '='"},
      {{"a", "--ooze", "volum=2"}, "there is no key 'volum'; known are volume, time"},
      {{"a", "--ooze", "best.volume=2"}, "there is no scenario 'best'"},
      {{"a", "--ooze", "volume=x"}, "'x' is not a number"},
      {{"a", "--ooze", "volume=nan"}, "'nan' is not a number"},
      {{"a", "--ooze", "volume=-1"}, "-1 is out of range; it is 0 or more"},
      {{"a", "--ooze", "volume=inf"}, "inf is out of range"},
      {{"a", "--ooze", "time=0"}, "0 is out of range; it is more than 0"},
      {{"a", "--ooze", "missing_is_spent=2"}, "it is 0 or 1"},
      {{"a", "--ooze", "volume=1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1"}, "17 values; at most 16 nozzles"},
      {{"a", "--fail-over", "smears=5"}, "there is no figure 'smears'; known are smear_volume"},
      {{"a", "--fail-over", "smear_volume=much"}, "'much' is not a number"},
      {{"a", "--fail-over", "smear_volume=-1"}, "'-1' is not a number of 0 or more"},
      {{"a", "--fail-over", "tireless.smear_volume=1"}, "there is no scenario 'tireless'"},
      {{"a", "--compare"}, "name at least two files"},
      {{"a", "--layer", "37"}, "say where to draw it"},
      {{"a", "--no-scene"}, "write one by -o FILE.html"},
      {{"a", "--layer", "0", "--svg", "a.svg"}, "numbered from 1"},
      {{"a", "--layer", "-1", "--svg", "a.svg"}, "numbered from 1"},
      {{"a", "--svg", "a.png"}, "must end in .svg; a PNG is written by --png"},
      {{"a", "--png", "a.svg"}, "must end in .png; an SVG is written by --svg"},
      {{"a", "b", "--svg", "a.svg"}, "a layer of one file"},
      {{"a", "-o", "a.json"}, "must end in .html; JSON is written by --json"},
      {{"a", "--json", "a.gcode"}, "must end in .json; - prints it"},
      {{"a", "--places", "many"}, "'many' is not a number"},
      {{"a", "--threads", "-1"}, "--threads: -1 is not between 0 and"},
      {{"a", "--nonesuch"}, "see cleancolor audit --help"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(fmt::format("{}", fmt::join(c.words, " ")));
    EXPECT_ERROR(audit_of(c.words), c.message);
  }
}

TEST(AuditArguments, AreHelpedWithEveryFigureAndKey) {
  const std::string help = std::get<TextCommand>(parse_command_line({"audit", "--help"})).text;
  for (const FigureInfo& f : figure_table()) EXPECT_NE(help.find(fmt::format("\n  {} ", f.name)), help.npos) << f.name;
  for (const char* part : {"Predicts how clean", "--fail-over", "\n  elastic_time ", "Exit codes", "Examples"})
    EXPECT_NE(help.find(part), help.npos) << part;
}

Outcome audit_run(const TestFolder& folder, const std::string& arguments, const std::string& before = "") {
  return run(folder, "audit " + arguments, before);
}

/// Two walls 40 mm long, 0.4 mm beside each other, one of each colour. The nozzles are 33 mm apart, so the tip of the
/// idle one passes over the end of its neighbour's wall while that is printed. X and Y are positions of the carriage.
std::string two_walls(int layers = 3) {
  std::string text = "; generated by PrusaSlicer 2.5.0 on 2022-01-01\nG21\nG90\nM83\n";
  for (int i = 0; i < layers; ++i) {
    const double z = 0.2 * (i + 1);
    text += fmt::format(";LAYER_CHANGE\n;Z:{0:.2f}\n;HEIGHT:0.2\n;WIDTH:0.4\nG1 Z{0:.2f} F600\n", z);
    text += "T0\nG1 X50 Y50 F6000\n;TYPE:External perimeter\nG1 X90 Y50 E1.2 F600\n";
    text += "T1\nG1 X17 Y50.4 F6000\n;TYPE:External perimeter\nG1 X57 Y50.4 E1.2 F600\n";
  }
  return text + "M12345\n";
}

constexpr const char* offsets = " --nozzle-offset 0x0,33x0 --offsets-in slicer ";

TEST(AuditProgram, PrintsFiguresAndTheVerdict) {
  const TestFolder folder;
  folder.file("a.gcode", two_walls());
  const Outcome r = audit_run(folder, std::string("a.gcode") + offsets);
  EXPECT_EQ(r.exit_code, exit_done) << r.err;
  for (const char* part : {"PrusaSlicer 2.5.0", "smear_volume  ", "worst places", "unknown commands: M12345 (1)",
                           "\nworst: smears: ", "T1 at 33,0 mm, by --nozzle-offset"})
    EXPECT_NE(r.out.find(part), r.out.npos) << part << "\n" << r.out;
}

TEST(AuditProgram, PrintsJsonAloneWhereAskedFor) {
  const TestFolder folder;
  folder.file("a.gcode", two_walls());
  const Outcome r = audit_run(folder, std::string("a.gcode --quiet --json -") + offsets);
  ASSERT_EQ(r.exit_code, exit_done) << r.err;
  const auto json = nlohmann::json::parse(r.out);
  EXPECT_EQ(json["schema"], 1);
  EXPECT_EQ(json["files"][0]["name"], "a.gcode");
  EXPECT_EQ(json["files"][0]["print"]["layers"], 3);
  EXPECT_GT(json["files"][0]["scenarios"]["worst"]["figures"]["smear_volume"], 0);
  EXPECT_EQ(r.err, "");
}

TEST(AuditProgram, WritesEveryOutputTheSameForAnyNumberOfThreads) {
  const TestFolder folder;
  folder.file("a.gcode", two_walls(40));
  for (const int threads : {1, 2, 5}) {
    const Outcome r =
        audit_run(folder, fmt::format("a.gcode --quiet --threads {0} -o {0}.html --json {0}.json --layer 2 --svg "
                                      "{0}.svg --png {0}.png {1}",
                                      threads, offsets));
    ASSERT_EQ(r.exit_code, exit_done) << r.err;
    EXPECT_EQ(r.out + r.err, "");
    for (const char* ending : {"html", "json", "svg", "png"}) {
      const std::string text = file_text(folder.path(fmt::format("{}.{}", threads, ending)));
      EXPECT_GT(text.size(), 1000u) << ending;
      EXPECT_TRUE(text == file_text(folder.path(fmt::format("1.{}", ending)))) << ending;
    }
  }
}

TEST(AuditProgram, WritesTheSceneIntoTheReportWhereItHasThePageAndNobodyForbidsIt) {
  const TestFolder folder;
  folder.file("a.gcode", two_walls());
  const bool built = std::ranges::count(page_files(), "/report.js", &PageFile::path) == 1;
  ASSERT_EQ(audit_run(folder, std::string("a.gcode a.gcode --quiet -o with.html") + offsets).exit_code, exit_done);
  ASSERT_EQ(audit_run(folder, std::string("a.gcode a.gcode --quiet -o without.html --no-scene") + offsets).exit_code,
            exit_done);
  const std::string with = file_text(folder.path("with.html")), without = file_text(folder.path("without.html"));
  EXPECT_EQ(with.find("id=\"cleancolor-1-audit\"") != with.npos, built);
  EXPECT_EQ(with.find("data-names=\"a.gcode&#10;a.gcode\"") != with.npos, built);
  EXPECT_EQ(without.find("<script"), without.npos);
}

TEST(AuditProgram, ExitsWith1WhereAFigureIsOverItsLimit) {
  const TestFolder folder;
  folder.file("a.gcode", two_walls());
  const Outcome over = audit_run(folder, std::string("a.gcode --quiet --json a.json --fail-over wipes=0 --fail-over "
                                                     "smear_volume=0.001 --fail-over model.zippers=1") +
                                             offsets);
  EXPECT_EQ(over.exit_code, exit_exceeded);
  EXPECT_NE(over.err.find("cleancolor: a.gcode: worst.smear_volume is "), over.err.npos) << over.err;
  EXPECT_NE(over.err.find(" mm3, more than the 0.001 mm3 allowed\n"), over.err.npos) << over.err;
  EXPECT_NE(over.err.find("a.gcode: model.zippers is 12, more than the 1 allowed\n"), over.err.npos) << over.err;
  EXPECT_EQ(over.err.find("wipes"), over.err.npos) << over.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path("a.json"))) << "reports are written all the same";
  const Outcome under = audit_run(folder, std::string("a.gcode --quiet --fail-over smear_volume=1000") + offsets);
  EXPECT_EQ(under.exit_code, exit_done) << under.err;
}

TEST(AuditProgram, ComparesFiles) {
  const TestFolder folder;
  folder.file("a.gcode", two_walls(3));
  folder.file("b.gcode", two_walls(4));
  const Outcome same = audit_run(folder, std::string("a.gcode a.gcode --compare") + offsets);
  EXPECT_EQ(same.exit_code, exit_done) << same.err;
  EXPECT_NE(same.out.find("The files print the same part"), same.out.npos) << same.out;
  const Outcome other = audit_run(folder, std::string("a.gcode b.gcode --compare -o ab.html") + offsets);
  EXPECT_NE(other.out.find("The files do not print the same part: its plastic differs by 33.3 %"), other.out.npos)
      << other.out;
  EXPECT_NE(file_text(folder.path("ab.html")).find("<h1>b.gcode</h1>"), std::string::npos);
}

TEST(AuditProgram, ShowsVariantsOfTheAssumptions) {
  const TestFolder folder;
  folder.file("a.gcode", two_walls());
  const Outcome r = audit_run(folder, std::string("a.gcode --sensitivity") + offsets);
  EXPECT_EQ(r.exit_code, exit_done) << r.err;
  for (const char* name : {"tireless", "printed_only", "own_does_not_empty", "touch_2mm"})
    EXPECT_NE(r.out.find(fmt::format("\n{} ", name)), r.out.npos) << name;
}

TEST(AuditProgram, KnowsPrintersByNameAndFile) {
  const TestFolder folder;
  folder.file("a.gcode", two_walls());
  folder.file("mine.toml", "inherits = \"replicator-dual\"\n");
  for (const char* printer : {"replicator-dual", "mine.toml"}) {
    const Outcome r = audit_run(folder, fmt::format("a.gcode --offsets-in slicer --printer {}", printer));
    EXPECT_EQ(r.exit_code, exit_done) << r.err;
    EXPECT_NE(r.out.find("T1 at 33,0 mm, by printer"), r.out.npos) << r.out;
  }
}

TEST(AuditProgram, RefusesWhatItCannotReadWithCode2AndTheLine) {
  struct Case {
    const char* arguments;
    const char* message;
  };
  const Case cases[] = {
      {"absent.gcode", "absent.gcode"},
      {"empty.gcode", "empty.gcode"},
      {"nan.gcode --nozzle-offset 0x0,33x0", "nan.gcode:5: "},
      {"binary.bgcode", "binary.bgcode: "},
      {"a.gcode --printer nonesuch", "there is no printer 'nonesuch'"},
      {"a.gcode --nozzle-offset 0x0 --offsets-in slicer", "a.gcode: "},
      {"a.gcode --nozzle-offset 0x0,33x0 --offsets-in slicer --layer 4 --svg l.svg",
       "a.gcode: there is no layer 4; it has 3, numbered from 1"},
  };
  const TestFolder folder;
  folder.file("a.gcode", two_walls());
  folder.file("empty.gcode", "");
  folder.file("nan.gcode", "G21\nG90\nM83\nG1 X1 Y1 F600\nG1 XY1..2 E1\n");
  folder.file("binary.bgcode", std::string("GCDE\1\0\0\0", 8));
  for (const Case& c : cases) {
    SCOPED_TRACE(c.arguments);
    const Outcome r = audit_run(folder, std::string(c.arguments) + " --json out.json");
    EXPECT_EQ(r.exit_code, exit_wrong_input);
    EXPECT_NE(r.err.find("cleancolor: "), r.err.npos);
    EXPECT_NE(r.err.find(c.message), r.err.npos) << r.err;
    EXPECT_EQ(r.out, "");
    EXPECT_FALSE(std::filesystem::exists(folder.path("out.json")));
  }
}

TEST(AuditProgram, NeverOverwritesWhatItReads) {
  struct Case {
    const char* arguments;
    const char* message;
  };
  const Case cases[] = {
      {"./in.html -o in.html", "input and output are the same file"},
      {"in.html -o link.html", "input and output are the same file"},
      {"in.html --json in.json in.json", "input and --json are the same file"},
  };
  const TestFolder folder;
  const std::string text = two_walls();
  folder.file("in.html", text);
  folder.file("in.json", text);
  std::filesystem::create_symlink("in.html", folder.path("link.html"));
  for (const Case& c : cases) {
    SCOPED_TRACE(c.arguments);
    const Outcome r = audit_run(folder, std::string(c.arguments) + offsets);
    EXPECT_EQ(r.exit_code, exit_wrong_input);
    EXPECT_NE(r.err.find(c.message), r.err.npos) << r.err;
    EXPECT_EQ(file_text(folder.path("in.html")), text);
    EXPECT_EQ(file_text(folder.path("in.json")), text);
  }
}

TEST(AuditProgram, ReportsWhatItCannotWriteWithCode3) {
  const TestFolder folder;
  folder.file("a.gcode", two_walls());
  for (const char* output : {"-o absent/a.html", "--json absent/a.json", "--svg absent/a.svg", "--png absent/a.png"}) {
    const Outcome r = audit_run(folder, std::string("a.gcode ") + output + offsets);
    EXPECT_EQ(r.exit_code, exit_system) << output;
    EXPECT_NE(r.err.find("absent"), r.err.npos) << r.err;
  }
}

TEST(AuditProgram, InterruptedLeavesNoFileAndCode130) {
  const TestFolder folder;
  folder.file("a.gcode", two_walls(45'000));
  const Outcome r = audit_run(folder, std::string("a.gcode --quiet --json a.json") + offsets,
                              "timeout --foreground --preserve-status -s INT 0.1");
  EXPECT_EQ(r.exit_code, exit_interrupted) << r.out << r.err;
  EXPECT_NE(r.err.find("interrupted"), r.err.npos);
  EXPECT_FALSE(std::filesystem::exists(folder.path("a.json")));
}

}  // namespace
}  // namespace cleancolor
