// Every file of the shared folder's bad input through the real program: it refuses with one clear line and no file, or
// slices, with a warning where something was mended.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "model/settings.hpp"
#include "program.hpp"
#include "replay.hpp"
#include "sanitized.hpp"
#include "slicing.hpp"

namespace cleancolor {
namespace {

using namespace test;

enum class Expected { accepted, warned, refused };

struct Row {
  const char* file;  // below shared/models/bad; a folder of V0.stl and V1.stl where it has no extension
  Expected outcome;
  const char* words = "";  // in the warning or the message
};

using enum Expected;

// What exactly readers and checks say is the matter of tests/model/corpus_test.cpp; here stands one word of it.
const Row rows[] = {
    {"stl/truncated_binary.stl", refused, "promised"},
    {"stl/truncated_binary_header.stl", refused, "too few"},
    {"stl/truncated_ascii.stl", refused, "cut short"},
    {"stl/empty_file.stl", refused, "empty"},
    {"stl/zero_triangles_binary.stl", refused, "no triangles"},
    {"stl/zero_triangles_ascii.stl", refused, "no triangles"},
    {"stl/count_too_small.stl", refused, "12 are there"},
    {"stl/trailing_garbage.stl", warned, "37 stray bytes"},
    {"stl/random_noise.stl", refused, "no STL file"},
    {"stl/png_renamed.stl", refused, "PNG"},
    {"stl/no_newlines_1MB.stl", refused, "no triangles"},
    {"stl/nan_ascii.stl", refused, "finite"},
    {"stl/nan_binary.stl", refused, "finite"},
    {"stl/inf_binary.stl", refused, "finite"},
    {"stl/inf_ascii.stl", refused, "finite"},
    {"stl/text_for_number_ascii.stl", refused, "twenty"},
    {"accept/solid_header_binary.stl", accepted},
    {"accept/ascii_crlf.stl", accepted},
    {"accept/ascii_leading_space_upper.stl", accepted},
    {"accept/ascii_two_solids.stl", accepted},
    {"accept/ascii_unicode_name.stl", accepted},
    {"accept/zero_normals.stl", accepted},
    {"accept/prusa_20mmbox-CR.stl", accepted},
    {"accept/prusa_20mmbox-CRLF.stl", accepted},
    {"accept/prusa_20mmbox-LF.stl", accepted},
    {"accept/prusa_20mmbox-nonstandard.stl", accepted},
    {"accept/prusa_20mmbox-čřšřěá.stl", accepted},
    {"geometry/open_cube_missing_face.stl", warned, "hole closed"},
    {"geometry/open_cube_missing_triangle.stl", warned, "hole closed"},
    {"geometry/single_triangle.stl", refused, "flat"},
    {"geometry/plane.stl", refused, "flat"},
    {"geometry/inverted_normals.stl", warned, "inside out"},
    {"geometry/mixed_winding.stl", warned, "wrong way"},
    {"geometry/edge_with_4_faces.stl", warned, "shared"},
    {"geometry/vertex_touch.stl", warned, "touch"},
    {"geometry/duplicate_faces.stl", warned, "twice"},
    {"geometry/interpenetrating_cubes_one_mesh.stl", warned, "united"},
    {"geometry/cavity_ok.stl", accepted},
    {"geometry/all_degenerate.stl", refused, "flat"},
    {"geometry/some_degenerate.stl", warned, "without area"},
    {"geometry/vertices_not_welded_1e-5.stl", warned, "joined"},
    {"placement/huge_1e6mm.stl", refused, "too large"},
    {"placement/out_of_bed_xy.stl", warned, "moved"},
    {"placement/larger_than_bed.stl", refused, "too large"},
    {"placement/below_plate.stl", warned, "below"},
    {"placement/floating.stl", warned, "above"},
    {"placement/flatter_than_layer.stl", refused, "0.050 mm high"},
    {"placement/thinner_than_nozzle.stl", warned, "thinner than its nozzle"},
    {"pairs/overlap_5mm", refused, "overlap"},
    {"pairs/identical", refused, "overlap"},
    {"pairs/gap_1um", accepted},
    {"pairs/shared_face", accepted},
    {"pairs/far_apart", refused, "too large"},
    {"pairs/V1_missing_volume", refused, "flat"},
    {"pairs/V1_floating", warned, "mid-air"},
    {"3mf/ok_two_cubes.3mf", accepted},
    {"3mf/units_inch.3mf", accepted},
    {"3mf/units_centimeter.3mf", accepted},
    {"3mf/units_unknown.3mf", refused, "furlong"},
    {"3mf/zip_truncated.3mf", refused, "damaged"},
    {"3mf/zip_corrupt_data.3mf", refused, "damaged"},
    {"3mf/not_a_zip.3mf", refused, "no zip archive"},
    {"3mf/stl_renamed.3mf", accepted},
    {"3mf/empty_file.3mf", refused, "empty"},
    {"3mf/empty_zip.3mf", refused, "empty"},
    {"3mf/missing_model_part.3mf", refused, "not in the package"},
    {"3mf/missing_rels.3mf", warned, "missing"},
    {"3mf/missing_content_types.3mf", warned, "missing"},
    {"3mf/model_elsewhere.3mf", accepted},
    {"3mf/xml_truncated.3mf", refused, "not well-formed"},
    {"3mf/xml_mismatched_tags.3mf", refused, "not well-formed"},
    {"3mf/index_out_of_range.3mf", refused, "8000"},
    {"3mf/index_missing.3mf", refused, "missing"},
    {"3mf/vertex_nan.3mf", refused, "NaN"},
    {"3mf/vertex_text.3mf", refused, "abc"},
    {"3mf/build_unknown_object.3mf", refused, "does not exist"},
    {"3mf/component_cycle.3mf", refused, "contains itself"},
    {"3mf/duplicate_ids.3mf", refused, "id 2"},
    {"3mf/transform_singular.3mf", refused, "flattens"},
    {"3mf/transform_11_numbers.3mf", refused, "11 numbers"},
    {"3mf/transform_scale_rot.3mf", accepted},
    {"3mf/overlapping_objects.3mf", refused, "overlap"},
    {"3mf/unknown_required_extension.3mf", refused, "extension"},
    {"3mf/pindex_out_of_range.3mf", refused, "does not exist"},
    {"3mf/one_colour.3mf", accepted},
    {"3mf/zip_slip_names.3mf", accepted},
    {"3mf/zip_bomb_10MB.3mf", refused, "not trusted"},
    {"obj/ok_cube.obj", accepted},
    {"obj/index_out_of_range.obj", refused, "99"},
    {"obj/index_zero.obj", refused, "start at 1"},
    {"obj/index_negative_ok.obj", accepted},
    {"obj/face_two_vertices.obj", refused, "2 corners"},
    {"obj/no_faces.obj", refused, "no faces"},
    {"obj/truncated.obj", refused, "corners"},
};

std::filesystem::path bad(const std::string& file) {
  return shared_model("bad/" + file);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

void expect_refusal(const Outcome& outcome, const Row& row, const TestFolder& folder) {
  EXPECT_EQ(outcome.exit_code, exit_wrong_input) << outcome.err;
  const std::vector<std::string> lines = lines_of(outcome.err);
  ASSERT_FALSE(lines.empty());
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) EXPECT_TRUE(lines[i].starts_with("warning: ")) << lines[i];
  const std::string& message = lines.back();
  EXPECT_TRUE(message.starts_with("cleancolor: ")) << message;
  EXPECT_TRUE(says(message, row.words));
  const bool is_pair = std::filesystem::is_directory(bad(row.file));
  const std::string name = std::filesystem::path(row.file).filename().string();
  EXPECT_TRUE(is_pair ? says(message, "V1.stl") || says(message, "V0.stl") : says(message, name));
  EXPECT_EQ(files_in(folder), std::vector<std::string>{});
}

void expect_printable(const Outcome& outcome, const Row& row, const TestFolder& folder, const Config& config) {
  ASSERT_EQ(outcome.exit_code, exit_done) << outcome.err;
  EXPECT_EQ(outcome.err.empty(), row.outcome == accepted) << outcome.err;
  EXPECT_TRUE(says(outcome.err, row.words));
  ASSERT_EQ(files_in(folder), std::vector<std::string>{"out.gcode"});
  const Printed printed = replayed(file_text(folder.path("out.gcode")), config);
  EXPECT_EQ(printed.broken, std::vector<std::string>{});
  double filament = 0;
  for (const double mm : printed.filament_mm) filament += mm;
  EXPECT_GT(filament, 10);
  for (const PrintedRoad& road : printed.roads)
    ASSERT_TRUE(std::abs(road.to.x) <= 112.5 && std::abs(road.to.y) <= 72.5 && road.z <= 150) << road.role;
}

class BadInput : public testing::TestWithParam<const char*> {};

TEST_P(BadInput, IsRefusedMendedOrAcceptedAsListed) {
  if (!std::filesystem::exists(bad(""))) GTEST_SKIP() << "needs the models of " << CLEANCOLOR_SHARED;
  const Config config = config_of({.printer = "replicator-dual"});
  int count = 0;
  for (const Row& row : rows) {
    if (!std::string(row.file).starts_with(std::string(GetParam()) + "/")) continue;
    SCOPED_TRACE(row.file);
    ++count;
    const TestFolder folder;
    std::vector<std::string> arguments = {"slice", "--quiet", "--printer", "replicator-dual", "-o", "out.gcode"};
    if (std::filesystem::is_directory(bad(row.file))) {
      for (const char* part : {"/V0.stl", "/V1.stl"}) arguments.push_back(bad(row.file + std::string(part)).string());
    } else {
      arguments.push_back(bad(row.file).string());
    }
    const Outcome outcome = run(folder, arguments);
    EXPECT_EQ(outcome.out, "");
    EXPECT_LT(outcome.cpu_seconds, sanitized ? 60 : 10);
    if (!sanitized) {
      EXPECT_LT(outcome.peak_mb, 1000);
    }
    if (row.outcome == refused)
      expect_refusal(outcome, row, folder);
    else
      expect_printable(outcome, row, folder, config);
  }
  EXPECT_GT(count, 5);
}

INSTANTIATE_TEST_SUITE_P(Folders, BadInput,
                         testing::Values("stl", "accept", "geometry", "placement", "pairs", "3mf", "obj"),
                         [](const auto& of) { return "of_" + std::string(of.param); });

TEST(BadInputTable, NamesEveryFileOfTheFolder) {
  if (!std::filesystem::exists(bad(""))) GTEST_SKIP() << "needs the models of " << CLEANCOLOR_SHARED;
  std::set<std::filesystem::path> listed;
  for (const Row& row : rows) listed.insert(bad(row.file));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(bad("")))
    if (entry.is_regular_file()) {
      EXPECT_TRUE(listed.contains(entry.path()) || listed.contains(entry.path().parent_path())) << entry.path();
    }
}

}  // namespace
}  // namespace cleancolor
