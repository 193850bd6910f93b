// Programs that people really feed with G-code read ours: gpx (Replicator), printrun (Marlin), and the planner of
// shared/peers/tools/gstat.py. Each test is skipped where its program is not installed.

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "base/output_file.hpp"
#include "gcode/jobs.hpp"
#include "model/profile.hpp"

using namespace cleancolor;
using namespace cleancolor::test;

namespace {

struct Answer {
  int status;
  std::string text;
};

Answer asked(const std::string& command) {
  Answer answer{-1, {}};
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return answer;
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) answer.text.append(buffer, n);
  answer.status = pclose(pipe);
  return answer;
}

bool installed(const std::string& program) {
  return asked("command -v " + program).status == 0;
}

class ClientsTest : public testing::Test {
 protected:
  void SetUp() override {
    folder = std::filesystem::path(testing::TempDir()) /
             (std::string("cleancolor-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::string file(const Written& w) const {
    const auto path = folder / "job.gcode";
    write_file(path, w.text);
    return path.string();
  }

  static Config printer(const char* name) {
    Config c = with_profile(Config{}, find_profile(OptionGroup::printer, name));
    c.first_layer_speed = {30, false};
    return c;
  }

  std::filesystem::path folder;
};

}  // namespace

TEST_F(ClientsTest, GpxConvertsOurSailfishWithoutAWarning) {
  if (!installed("gpx")) GTEST_SKIP() << "gpx is not installed";
  const Config c = printer("replicator-dual");
  ASSERT_EQ(c.gcode_flavor, Flavour::sailfish);
  for (const bool stacked : {false, true}) {
    const std::string job = file(written(c, two_cubes(20, stacked)));
    for (const char* dialect : {"-r", "-g"}) {
      const Answer a = asked("gpx -v -I " + std::string(dialect) + " -m r1d '" + job + "' '" + job + ".x3g'");
      EXPECT_EQ(a.status, 0) << a.text;
      for (const char* bad : {" warning", " error", "overflow"})
        EXPECT_EQ(a.text.find(bad), std::string::npos) << a.text;
      EXPECT_GT(std::filesystem::file_size(job + ".x3g"), 10000u);
    }
  }
}

TEST_F(ClientsTest, PrintrunSeesBothExtrudersLayersAndFilamentOfOurMarlin) {
  // Debian's package is seen by Debian's python only.
  std::string python = "/usr/bin/python3";
  if (asked(python + " -c 'import printrun.gcoder'").status != 0) python = "python3";
  if (asked(python + " -c 'import printrun.gcoder'").status != 0) GTEST_SKIP() << "printrun is not installed";
  for (const bool relative : {false, true}) {
    Config c = two_extruders(Flavour::marlin2, OffsetsIn::firmware);
    c.use_relative_e_distances = relative;
    c.remaining_times = true;
    const Written w = written(c, two_cubes(20, false));
    const Answer a = asked(
        python +
        " -W ignore -c \"import logging; logging.disable(); from printrun import gcoder; g = gcoder.GCode(open('" +
        file(w) + "')); print(g.layers_count, *g.filament_length_multi[:2])\"");
    ASSERT_EQ(a.status, 0) << a.text;
    int layers = 0;
    double fed[2] = {0, 0};
    ASSERT_EQ(std::sscanf(a.text.c_str(), "%d %lf %lf", &layers, &fed[0], &fed[1]), 3) << a.text;
    EXPECT_GE(layers, 20);
    // It counts what is drawn back at the end; we do not.
    for (std::size_t t = 0; t < 2; ++t) EXPECT_NEAR(fed[t], w.figures.extruders[t].length_mm, 1.01) << a.text;
  }
}

TEST_F(ClientsTest, AnotherPlannerFindsTheSameTimeWithinOnePercent) {
  const std::filesystem::path gstat = std::filesystem::path(CLEANCOLOR_SHARED) / "peers/tools/gstat.py";
  if (!std::filesystem::exists(gstat) || !installed("python3")) GTEST_SKIP() << "gstat.py or python3 is not there";
  for (const Flavour flavour : {Flavour::marlin2, Flavour::klipper, Flavour::sailfish}) {
    Config c = two_extruders(flavour, flavour == Flavour::klipper ? OffsetsIn::slicer : OffsetsIn::firmware);
    c.machine_max_feedrate_mm_s = {300, 300, 19.5};
    c.machine_max_feedrate_e_mm_s = 26.7;
    c.machine_max_acceleration_mm_s2 = {1000, 1000, 150};
    c.machine_max_acceleration_e_mm_s2 = 2000;
    c.machine_max_acceleration_extruding_mm_s2 = c.machine_max_acceleration_travel_mm_s2 = 1000;
    c.machine_max_acceleration_retracting_mm_s2 = 2000;
    c.machine_max_jerk_mm_s = {8, 8, 1};
    c.machine_max_jerk_e_mm_s = 3;
    const Written w = written(c, two_cubes(40, false));
    const Answer a = asked("python3 '" + gstat.string() + "' --json '" + file(w) + "'");
    const std::size_t at = a.text.find("\"time_s\": ");
    ASSERT_NE(at, std::string::npos) << a.text;
    // A jump of the firmware's origin at a tool change (33 mm) is a move to it, not to us: the travel is as long.
    EXPECT_NEAR(std::strtod(a.text.c_str() + at + 10, nullptr), w.figures.time_s, 0.01 * w.figures.time_s);
    EXPECT_NE(a.text.find("\"tool_changes\": 40"), std::string::npos) << a.text;
  }
}
