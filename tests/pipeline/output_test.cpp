// The output file is whole or not there, whatever happens on the way.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "model/settings.hpp"
#include "program.hpp"
#include "slicing.hpp"

namespace cleancolor {
namespace {

using namespace test;

SliceRequest cube_request(const TestFolder& folder, const std::string& output) {
  const auto stl = stl_file(folder, "cube.stl", box_mesh({0, 0, 0}, {30, 30, 30}));
  return request_for({stl}, config_of({.printer = "generic"}), output);
}

TEST(Output, OfAnInterruptedRunIsNotThere) {
  const TestFolder folder;
  const SliceRequest request = cube_request(folder, folder.path("out.gcode"));
  // The questions are spread over the whole run: the first ones come before a layer is cut, the last after most are
  // written.
  int asked_in_all = 0;
  Progress counting;
  counting.interrupted = [&] { return ++asked_in_all < 0; };
  slice(request, counting);
  ASSERT_GT(asked_in_all, 50);
  std::filesystem::remove(request.output);
  for (const int after : {0, 1, asked_in_all / 2, asked_in_all - 1}) {
    SCOPED_TRACE(after);
    int asked = 0;
    Progress progress;
    progress.interrupted = [&] { return ++asked > after; };
    EXPECT_ERROR(slice(request, progress), "interrupted");
    EXPECT_EQ(asked, after + 1) << "stops at once";
    EXPECT_EQ(files_in(folder), std::vector<std::string>{"cube.stl"});
  }
}

TEST(Output, ThatWasThereStaysWhenTheRunIsInterrupted) {
  const TestFolder folder;
  const SliceRequest request = cube_request(folder, folder.file("out.gcode", "; what was printed last week\n"));
  int asked = 0;
  Progress progress;
  progress.interrupted = [&] { return ++asked > 40; };
  EXPECT_ERROR(slice(request, progress), "interrupted");
  EXPECT_EQ(file_text(request.output), "; what was printed last week\n");
  EXPECT_EQ(files_in(folder), (std::vector<std::string>{"cube.stl", "out.gcode"}));
}

TEST(Output, ThatWasThereIsReplacedByAWholeOne) {
  const TestFolder folder;
  const SliceRequest request = cube_request(folder, folder.file("out.gcode", "; what was printed last week\n"));
  slice(request);
  EXPECT_TRUE(file_text(request.output).ends_with("; prusaslicer_config = end\n"));
}

TEST(Output, InAFolderThatDoesNotExistIsASystemError) {
  const TestFolder folder;
  const SliceRequest request = cube_request(folder, folder.path("absent/out.gcode"));
  EXPECT_THROW(slice(request), SystemError);
  EXPECT_ERROR(slice(request), "absent/out.gcode");
  EXPECT_EQ(files_in(folder), std::vector<std::string>{"cube.stl"});
}

TEST(Output, WithoutAnythingOfOneColourIsRefused) {
  const TestFolder folder;
  const auto block = stl_file(folder, "block.stl", box_mesh({0, 0, 0}, {20, 20, 10}));
  const auto foil = stl_file(folder, "foil.stl", box_mesh({20, 0, 0}, {20.05, 20, 10}));
  EXPECT_ERROR(
      slice(request_for({block, foil}, config_of({.printer = "generic-dual-marlin"}), folder.path("out.gcode"))),
      "extruder 2 should print is too thin");
}

TEST(Output, HeatsTheBedForTheMaterialThatStandsOnIt) {
  // Extruder 1 prints only high up; the bed is for extruder 2.
  const TestFolder folder;
  const auto high = stl_file(folder, "high.stl", box_mesh({0, 0, 5}, {20, 20, 10}));
  const auto low = stl_file(folder, "low.stl", box_mesh({0, 0, 0}, {20, 20, 5}));
  const Config config = config_of({.printer = "generic-dual-marlin", .set = {"first_layer_bed_temperature=110,60"}});
  const Sliced result = sliced(request_for({high, low}, config, folder.path("out.gcode")));
  EXPECT_NE(result.text.find("M190 S60\n"), std::string::npos);
  EXPECT_EQ(result.text.find("M190 S110\n"), std::string::npos);
}

TEST(Output, OfWallsTooThinToPrintIsNotThereAndTheFileIsNamed) {
  const TestFolder folder;
  for (const double wall_mm : {0.001, 0.02, 0.05}) {  // the first ones are gone before there is a region to print
    SCOPED_TRACE(wall_mm);
    const auto stl = stl_file(folder, "foil.stl", box_mesh({0, 0, 0}, {20, wall_mm, 20}));
    EXPECT_ERROR(slice(request_for({stl}, config_of({.printer = "generic"}), folder.path("out.gcode"))),
                 "foil.stl: every wall that extruder 1 should print is too thin");
    EXPECT_EQ(files_in(folder), std::vector<std::string>{"foil.stl"});
  }
}

TEST(Output, OnAFullDiscIsASystemErrorAndLeavesNothing) {
  const TestFolder folder;
  stl_file(folder, "cube.stl", box_mesh({0, 0, 0}, {30, 30, 30}));
  // A limit on the size of files fails writes as a full disc does.
  const Outcome outcome = run(folder, {"slice", "--quiet", "cube.stl", "-o", "out.gcode"}, [] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100'000, 100'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  });
  EXPECT_EQ(outcome.exit_code, exit_system) << outcome.err;
  EXPECT_TRUE(says(outcome.err, "cleancolor: out.gcode: "));
  EXPECT_EQ(files_in(folder), std::vector<std::string>{"cube.stl"});
}

TEST(Output, OfAKilledProgramNeverBearsTheTargetsName) {
  const TestFolder folder;
  stl_file(folder, "cube.stl", box_mesh({0, 0, 0}, {100, 100, 150}));
  const pid_t child = started(
      folder, {"slice", "cube.stl", "-o", "out.gcode", "--set", "layer_height=0.03", "--set", "fill_density=60%"});
  // Killed as soon as some of the G-code is on the disc.
  bool is_writing = false;
  for (int i = 0; i < 3000 && !is_writing; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    for (const std::string& name : files_in(folder)) {
      std::error_code gone;
      is_writing |= name.ends_with(".part") && std::filesystem::file_size(folder.path(name), gone) > 1'000'000 && !gone;
    }
  }
  ::kill(child, SIGKILL);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(is_writing && WIFSIGNALED(status)) << "it was done before it could be killed";
  EXPECT_FALSE(std::filesystem::exists(folder.path("out.gcode")));
}

}  // namespace
}  // namespace cleancolor
