// cleancolor explain: what its words mean, and the program as a person starts it.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/command_line.hpp"
#include "outcome.hpp"

namespace cleancolor {
namespace {

using Words = std::vector<std::string>;

ExplainCommand explain_of(Words words) {
  words.insert(words.begin(), "explain");
  return std::get<ExplainCommand>(parse_command_line(words));
}

TEST(ExplainArguments, SayFileLayerAndPrinter) {
  const ExplainCommand command = explain_of({"a.gcode", "--layer", "60", "-o", "l.svg", "--nozzle-offset", "0x0,33x0",
                                             "--offsets-in", "slicer", "--json", "-"});
  EXPECT_EQ(command.file, "a.gcode");
  EXPECT_EQ(command.layer, 59u);
  EXPECT_EQ(command.output, "l.svg");
  EXPECT_EQ(command.nozzle_offset_mm, (std::vector<Vec2>{{0, 0}, {33, 0}}));
  EXPECT_EQ(command.offsets_in, OffsetsIn::slicer);
  EXPECT_TRUE(command.json_on_standard_output);
}

TEST(ExplainArguments, AreRefusedWithWhatToDo) {
  struct Case {
    Words words;
    const char* message;
  };
  const Case cases[] = {
      {{}, "name a G-code file"},
      {{"a"}, "say which layer, from 1: --layer N"},
      {{"a", "--layer", "0"}, "'0' is not a layer; they are numbered from 1"},
      {{"a", "--layer", "-1"}, "numbered from 1"},
      {{"a", "--layer", "99999999999"}, "'99999999999' is not a layer"},
      {{"a", "--layer", "top"}, "'top' is not a layer"},
      {{"a", "--layer", "1", "-o", "l.pdf"}, "must end in .svg; or in .png"},
      {{"a", "--layer", "1", "--json", "l.txt"}, "must end in .json; - prints it"},
      {{"a", "--layer", "1", "--nozzle-offset", "33"}, "'33' is not like 33x0"},
      {{"a", "--layer", "1", "--threads", "-1"}, "--threads: -1 is not between 0 and"},
      {{"a", "b", "--layer", "1"}, "see cleancolor explain --help"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(fmt::format("{}", fmt::join(c.words, " ")));
    EXPECT_ERROR(explain_of(c.words), c.message);
  }
}

TEST(ExplainArguments, AreHelped) {
  const std::string help = std::get<TextCommand>(parse_command_line({"explain", "--help"})).text;
  for (const char* part : {"Draws how one layer", "--layer", "--nozzle-offset", "Exit codes", "Examples"})
    EXPECT_NE(help.find(part), help.npos) << part;
}

/// The bundled globe's cheap stand-in: two boxes sliced for a printer with two nozzles.
std::string box_at(double x) {
  std::string stl = "solid box\n";
  const auto corner = [&](int i) { return Vec3{x + (i & 1 ? 10. : 0.), i & 2 ? 10. : 0., i & 4 ? 4. : 0.}; };
  constexpr int triangles[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (const auto& triangle : triangles) {
    stl += "facet normal 0 0 0\nouter loop\n";
    for (const int i : triangle) stl += fmt::format("vertex {} {} {}\n", corner(i).x, corner(i).y, corner(i).z);
    stl += "endloop\nendfacet\n";
  }
  return stl + "endsolid box\n";
}

void put_sliced_boxes(const TestFolder& folder) {
  folder.file("a.stl", box_at(0));
  folder.file("b.stl", box_at(10));
  ASSERT_EQ(run(folder, "slice --quiet a.stl b.stl -o ab.gcode --printer generic-dual-klipper").exit_code, exit_done);
}

/// Runs of a layer, from 1, counted in the text: relative or absolute E, one command a line, as our writer writes it.
int runs_in_text(const std::string& gcode, int layer) {
  std::istringstream lines(gcode);
  std::string line;
  int at = 0, runs = 0;
  bool absolute = false, lays = false;
  double last = 0;
  while (std::getline(lines, line)) {
    if (line == ";LAYER_CHANGE") ++at, lays = false;
    if (line.starts_with("M82")) absolute = true;
    if (line.starts_with("M83")) absolute = false;
    if (line.starts_with("G92 E")) last = std::stod(line.substr(5));
    if (line.starts_with("T") || line.starts_with("ACTIVATE")) lays = false;
    if (!line.starts_with("G1 ")) continue;
    const bool moves = line.find(" X") != line.npos || line.find(" Y") != line.npos;
    const std::size_t e = line.find(" E");
    double fed = 0;
    if (e != line.npos) {
      const double value = std::stod(line.substr(e + 2));
      fed = absolute ? value - last : value;
      last = value;
    }
    const bool laid = moves && fed > 0;
    if (laid && !lays && at == layer) ++runs;
    if (laid || moves || fed != 0) lays = laid;
  }
  return runs;
}

TEST(ExplainProgram, ShowsAsManyPathsAsThereAreRunsInTheFile) {
  const TestFolder folder;
  put_sliced_boxes(folder);
  const std::string gcode = file_text(folder.path("ab.gcode"));
  for (const int layer : {1, 2, 10, 19, 20}) {
    const Outcome r = run(folder, fmt::format("explain ab.gcode --layer {} --quiet --json -", layer));
    ASSERT_EQ(r.exit_code, exit_done) << r.err;
    const auto json = nlohmann::json::parse(r.out);
    EXPECT_EQ(json["layers"], 20);
    EXPECT_EQ(json["paths"].size(), runs_in_text(gcode, layer)) << layer;
    EXPECT_GT(json["roadmap"]["nodes"], 50);
  }
}

TEST(ExplainProgram, WritesThePictureByItsEnding) {
  const TestFolder folder;
  put_sliced_boxes(folder);
  const Outcome svg = run(folder, "explain ab.gcode --layer 7 -o l.svg --json l.json");
  EXPECT_EQ(svg.exit_code, exit_done) << svg.err;
  EXPECT_NE(svg.out.find("layer 7 of 20"), svg.out.npos);
  EXPECT_NE(file_text(folder.path("l.svg")).find("<svg"), std::string::npos);
  EXPECT_TRUE(nlohmann::json::accept(file_text(folder.path("l.json"))));
  const Outcome png = run(folder, "explain ab.gcode --layer 7 -o l.png --quiet");
  EXPECT_EQ(png.exit_code, exit_done);
  EXPECT_EQ(png.out + png.err, "");
  EXPECT_EQ(file_text(folder.path("l.png")).substr(1, 3), "PNG");
}

TEST(ExplainProgram, RefusesWrongInputAndLeavesNoFile) {
  const TestFolder folder;
  put_sliced_boxes(folder);
  folder.file("bad.gcode", "G1 X0 Y0 Z.2\nG1 X1..2 E1\n");
  struct Case {
    const char* arguments;
    const char* message;
    int code;
  };
  const Case cases[] = {
      {"explain ab.gcode --layer 21 -o l.svg", "ab.gcode: there is no layer 21; it has 20, numbered from 1", 2},
      {"explain ab.gcode --layer 4294967295 -o l.svg", "there is no layer 4294967295; it has 20", 2},
      {"explain bad.gcode --layer 1 -o l.svg", "bad.gcode:2: ", 2},
      {"explain a.stl --layer 1 -o l.svg", "a.stl", 2},
      {"explain ab.gcode --layer 1 -o l.svg --printer nonesuch", "there is no printer 'nonesuch'", 2},
      {"explain ab.gcode --layer 1 --nozzle-offset 0x0 --offsets-in slicer -o l.svg", "ab.gcode: ", 2},
      {"explain absent.gcode --layer 1 -o l.svg", "there is no such file", 2},
      {"explain ab.gcode --layer 1 -o absent/l.svg", "absent", 3},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.arguments);
    const Outcome r = run(folder, c.arguments);
    EXPECT_EQ(r.exit_code, c.code) << r.err;
    EXPECT_NE(r.err.find(c.message), r.err.npos) << r.err;
    EXPECT_EQ(r.out, "");
    EXPECT_FALSE(std::filesystem::exists(folder.path("l.svg")));
  }
}

TEST(ExplainProgram, NeverOverwritesWhatItReads) {
  const TestFolder folder;
  put_sliced_boxes(folder);
  const std::string gcode = file_text(folder.path("ab.gcode"));
  folder.file("ab.svg", gcode);
  const Outcome r = run(folder, "explain ab.svg --layer 1 -o ab.svg");
  EXPECT_EQ(r.exit_code, exit_wrong_input);
  EXPECT_NE(r.err.find("input and output are the same file"), r.err.npos) << r.err;
  EXPECT_EQ(file_text(folder.path("ab.svg")), gcode);
}

}  // namespace
}  // namespace cleancolor
