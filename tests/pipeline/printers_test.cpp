// Every printer that may print does so in its own dialect, and the programs that feed such printers read it.

#include <gtest/gtest.h>

#include <cstdio>

#include "model/profile.hpp"
#include "model/settings.hpp"
#include "program.hpp"
#include "replay.hpp"
#include "slicing.hpp"

namespace cleancolor {
namespace {

using namespace test;

struct Answer {
  int status = -1;
  std::string text;
};

Answer asked(const std::string& command) {
  Answer answer;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return answer;
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) answer.text.append(buffer, n);
  answer.status = ::pclose(pipe);
  return answer;
}

std::vector<std::filesystem::path> bundled_pair() {
  const std::filesystem::path folder = std::filesystem::path(CLEANCOLOR_ROOT) / "models";
  return {folder / "4-cones_black.stl", folder / "4-cones_white.stl"};
}

Sliced sliced_pair(const TestFolder& folder, const Config& config) {
  SliceRequest request = request_for(bundled_pair(), config, folder.path("out.gcode"));
  if (config.extruders.size() == 1)
    for (ModelFile& file : request.files) file.extruder = 0;
  return sliced(request);
}

std::vector<std::string> printers(bool audit_only) {
  std::vector<std::string> names;
  for (const BuiltInProfile& p : builtin_profiles())
    if (p.group == OptionGroup::printer && config_of({.printer = std::string(p.name)}).audit_only == audit_only)
      names.emplace_back(p.name);
  return names;
}

std::string identifier(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// Words that only G-code of the flavour has.
std::string tool_word(Flavour flavour) {
  return flavour == Flavour::sailfish ? "\nM108 T1\n" : "\nT1";
}

class PrinterToPrintWith : public testing::TestWithParam<std::string> {};

TEST_P(PrinterToPrintWith, SlicesTheBundledPairWithinItsBed) {
  const TestFolder folder;
  const Config config = config_of({.printer = GetParam(), .set = {"layer_height=0.3", "first_layer_height=0.3"}});
  const Sliced result = sliced_pair(folder, config);
  EXPECT_EQ(result.warnings, "");
  const Printed printed = replayed(result.text, config);
  EXPECT_EQ(printed.broken, std::vector<std::string>{});
  Box<Vec2> bed;
  for (const Vec2 p : config.bed_shape_mm) bed.add(p);
  for (const PrintedRoad& road : printed.roads)
    ASSERT_TRUE(road.to.x >= bed.min.x && road.to.x <= bed.max.x && road.to.y >= bed.min.y && road.to.y <= bed.max.y);
  if (config.extruders.size() == 1) return;
  EXPECT_GT(result.summary.tool_changes, 50);
  for (std::size_t e = 0; e < 2; ++e) EXPECT_GT(printed.filament_mm[e], 300);
  EXPECT_TRUE(says(result.text, tool_word(config.gcode_flavor)));
}

TEST_P(PrinterToPrintWith, HasTheTimeAndFilamentOfTheSummaryInItsComments) {
  const TestFolder folder;
  const Config config = config_of({.printer = GetParam(), .set = {"layer_height=0.3", "first_layer_height=0.3"}});
  const Sliced result = sliced_pair(folder, config);
  for (const char* name : {"filament used [mm]", "filament used [g]", "total toolchanges", "total layers count"})
    EXPECT_FALSE(footer_numbers(result.text, name).empty()) << name;
  EXPECT_EQ(footer_numbers(result.text, "total layers count"), std::vector{double(result.summary.layers)});
  EXPECT_EQ(footer_numbers(result.text, "total toolchanges"), std::vector{double(result.summary.tool_changes)});
  // Eight minutes of plastic at the least, and no more than an hour for four small cones.
  EXPECT_GT(result.summary.time_s, 480);
  EXPECT_LT(result.summary.time_s, 3600);
}

INSTANTIATE_TEST_SUITE_P(Profiles, PrinterToPrintWith, testing::ValuesIn(printers(false)),
                         [](const auto& of) { return identifier(of.param); });

class PrinterToAudit : public testing::TestWithParam<std::string> {};

TEST_P(PrinterToAudit, IsRefusedWithAMessageThatSaysWhatElseThereIs) {
  const TestFolder folder;
  const Outcome outcome = run(folder, {"slice", "--quiet", "--printer", GetParam(), "-o", "out.gcode",
                                       bundled_pair()[0].string(), bundled_pair()[1].string()});
  EXPECT_EQ(outcome.exit_code, exit_wrong_input);
  for (const char* words : {GetParam().c_str(), "only to audit", "replicator-dual"})
    EXPECT_TRUE(says(outcome.err, words));
  EXPECT_EQ(files_in(folder), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Profiles, PrinterToAudit, testing::ValuesIn(printers(true)),
                         [](const auto& of) { return identifier(of.param); });

TEST(Clients, GpxConvertsTheSailfishPrintersFilesWithoutAWarning) {
  if (asked("command -v gpx").status != 0) GTEST_SKIP() << "gpx is not installed";
  for (const auto& [printer, machine] :
       {std::pair{"replicator-dual", "r1d"}, std::pair{"flashforge-creator-pro", "fcp"}}) {
    SCOPED_TRACE(printer);
    const TestFolder folder;
    sliced_pair(folder, config_of({.printer = printer}));
    const std::string job = folder.path("out.gcode");
    const Answer a = asked("gpx -v -I -r -m " + std::string(machine) + " '" + job + "' '" + job + ".x3g'");
    EXPECT_EQ(a.status, 0) << a.text;
    for (const char* bad : {" warning", " error", "overflow"}) EXPECT_EQ(a.text.find(bad), std::string::npos) << a.text;
    EXPECT_GT(std::filesystem::file_size(job + ".x3g"), 10'000U);
  }
}

TEST(Clients, PrintrunSeesLayersAndFilamentOfTheMarlinPrintersFile) {
  // Debian's package is seen by Debian's python only.
  std::string python = "/usr/bin/python3";
  if (asked(python + " -c 'import printrun.gcoder'").status != 0) python = "python3";
  if (asked(python + " -c 'import printrun.gcoder'").status != 0) GTEST_SKIP() << "printrun is not installed";
  const TestFolder folder;
  const Sliced result = sliced_pair(folder, config_of({.printer = "generic-dual-marlin"}));
  const Answer a =
      asked(python +
            " -W ignore -c \"import logging; logging.disable(); from printrun import gcoder; g = gcoder.GCode(open('" +
            folder.path("out.gcode") + "')); print(g.layers_count, *g.filament_length_multi[:2])\"");
  ASSERT_EQ(a.status, 0) << a.text;
  int layers = 0;
  double fed[2] = {0, 0};
  ASSERT_EQ(std::sscanf(a.text.c_str(), "%d %lf %lf", &layers, &fed[0], &fed[1]), 3) << a.text;
  EXPECT_NEAR(layers, result.summary.layers, 15);  // the cones' tips are too thin to print
  // It counts what is drawn back at the end; we do not.
  for (std::size_t e = 0; e < 2; ++e) EXPECT_NEAR(fed[e], result.summary.extruders[e].filament_mm, 3) << a.text;
}

}  // namespace
}  // namespace cleancolor
