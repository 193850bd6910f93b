// The models and the bad input of the shared folder: each file is accepted, mended or refused as this table says.
#include <gtest/gtest.h>

#include <filesystem>

#include "meshes.hpp"
#include "model/assign.hpp"
#include "model/check.hpp"
#include "model/placement.hpp"
#include "model/read.hpp"

namespace cleancolor {
namespace {

enum class Outcome { accepted, mended, refused };  // mended: with a warning

struct Row {
  const char* file;
  Outcome outcome;
  const char* word = "";   // in the warning or the refusal
  double volume_mm3 = -1;  // of all parts together; -1: not looked at
};

std::filesystem::path shared(const std::string& file) {
  return std::filesystem::path(CLEANCOLOR_SHARED) / "models" / file;
}

/// Everything up to the slicer, on a Replicator-like bed with two nozzles unless the bed is said to be larger.
std::vector<Part> prepared(const std::vector<std::string>& files, const Progress& progress, double bed_mm = 225) {
  std::vector<std::vector<Part>> parts_of_file;
  for (const std::string& file : files) parts_of_file.push_back(read_model(shared(file), progress));
  assign_extruders(parts_of_file, {{}, {}, 3});
  std::vector<Part> parts;
  for (auto& of_file : parts_of_file)
    for (Part& part : of_file) {
      part.mesh = checked(std::move(part.mesh), part.name, progress);
      parts.push_back(std::move(part));
    }
  Config config;
  config.bed_shape_mm = {{0, 0}, {bed_mm, 0}, {bed_mm, bed_mm}, {0, bed_mm}};
  config.max_print_height_mm = bed_mm;
  config.extruders.resize(3);
  place(parts, config, {}, progress);
  return parts;
}

double total_volume(const std::vector<Part>& parts) {
  double sum = 0;
  for (const Part& part : parts) sum += volume_mm3(part.mesh);
  return sum;
}

void expect(const std::vector<std::string>& files, const Row& row, double bed_mm = 225) {
  SCOPED_TRACE(row.file);
  Warnings warnings;
  std::vector<Part> parts;
  const std::string refused = refusal([&] { parts = prepared(files, warnings.progress, bed_mm); });
  if (row.outcome == Outcome::refused) {
    ASSERT_FALSE(refused.empty()) << "accepted, with: " << warnings.all();
    EXPECT_TRUE(says(refused, row.word));
    EXPECT_TRUE(says(refused, "; ")) << "says what to do";
    return;
  }
  ASSERT_EQ(refused, "");
  EXPECT_EQ(warnings.texts.empty(), row.outcome == Outcome::accepted) << warnings.all();
  EXPECT_TRUE(says(warnings.all(), row.word));
  if (row.volume_mm3 >= 0) {
    EXPECT_NEAR(total_volume(parts), row.volume_mm3, 1.2 + 1e-5 * row.volume_mm3);
  }
}

class Corpus : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(shared("bad"))) GTEST_SKIP() << "needs the models of " << CLEANCOLOR_SHARED;
  }
};

TEST_F(Corpus, BadInputIsAcceptedMendedOrRefusedAsListed) {
  using enum Outcome;
  const Row rows[] = {
      {"stl/truncated_binary.stl", refused, "2374 triangles are promised, 1423 are there"},
      {"stl/truncated_binary_header.stl", refused, "too few"},
      {"stl/truncated_ascii.stl", refused, "cut short"},
      {"stl/empty_file.stl", refused, "empty"},
      {"stl/zero_triangles_binary.stl", refused, "no triangles"},
      {"stl/zero_triangles_ascii.stl", refused, "no triangles"},
      {"stl/count_too_small.stl", refused, "promises 4 triangles, but 12 are there"},
      {"stl/trailing_garbage.stl", mended, "37 stray bytes", 8000},
      {"stl/random_noise.stl", refused, "no STL file"},
      {"stl/png_renamed.stl", refused, "PNG picture"},
      {"stl/no_newlines_1MB.stl", refused, "no triangles"},
      {"stl/nan_ascii.stl", refused, "finite"},
      {"stl/nan_binary.stl", refused, "finite"},
      {"stl/inf_binary.stl", refused, "finite"},
      {"stl/inf_ascii.stl", refused, "finite"},
      {"stl/text_for_number_ascii.stl", refused, "'twenty'"},
      {"accept/solid_header_binary.stl", accepted, "", 8000},
      {"accept/ascii_crlf.stl", accepted, "", 8000},
      {"accept/ascii_leading_space_upper.stl", accepted, "", 8000},
      {"accept/ascii_two_solids.stl", accepted, "", 9000},
      {"accept/ascii_unicode_name.stl", accepted, "", 8000},
      {"accept/zero_normals.stl", accepted, "", 8000},
      {"accept/prusa_20mmbox-CR.stl", accepted, "", 8000},
      {"accept/prusa_20mmbox-CRLF.stl", accepted, "", 8000},
      {"accept/prusa_20mmbox-LF.stl", accepted, "", 8000},
      {"accept/prusa_20mmbox-nonstandard.stl", accepted, "", 8000},
      {"accept/prusa_20mmbox-čřšřěá.stl", accepted, "", 8000},
      {"geometry/open_cube_missing_face.stl", mended, "1 hole closed", 8000},
      {"geometry/open_cube_missing_triangle.stl", mended, "1 hole closed", 8000},
      {"geometry/single_triangle.stl", refused, "flat"},
      {"geometry/plane.stl", refused, "flat"},
      {"geometry/inverted_normals.stl", mended, "1 shell was inside out", 8000},
      {"geometry/mixed_winding.stl", mended, "3 triangles were facing the wrong way", 8000},
      {"geometry/edge_with_4_faces.stl", mended, "1 edge is shared", 2000},
      {"geometry/vertex_touch.stl", mended, "touch in 1 vertex", 2000},
      {"geometry/duplicate_faces.stl", mended, "12 triangles were present twice", 8000},
      {"geometry/interpenetrating_cubes_one_mesh.stl", mended, "united"},
      {"geometry/cavity_ok.stl", accepted, "", 7488},
      {"geometry/all_degenerate.stl", refused, "flat"},
      {"geometry/some_degenerate.stl", mended, "2 triangles without area", 8000},
      {"geometry/vertices_not_welded_1e-5.stl", mended, "joined", 8000},
      {"placement/huge_1e6mm.stl", refused, "1000000.0 x 1000000.0"},
      {"placement/out_of_bed_xy.stl", mended, "outside the bed", 8000},
      {"placement/larger_than_bed.stl", refused, "400.0 x 20.0 x 20.0 mm"},
      {"placement/below_plate.stl", mended, "5.00 mm below", 8000},
      {"placement/floating.stl", mended, "10.00 mm above", 8000},
      {"3mf/ok_two_cubes.3mf", accepted, "", 16000},
      {"3mf/units_inch.3mf", accepted, "", 2 * 25.4 * 25.4 * 25.4},
      {"3mf/units_centimeter.3mf", accepted, "", 16000},
      {"3mf/units_unknown.3mf", refused, "'furlong' is no unit"},
      {"3mf/zip_truncated.3mf", refused, "damaged or cut short"},
      {"3mf/zip_corrupt_data.3mf", refused, "damaged"},
      {"3mf/not_a_zip.3mf", refused, "no zip archive"},
      {"3mf/stl_renamed.3mf", accepted, "", 8000},
      {"3mf/empty_file.3mf", refused, "empty"},
      {"3mf/empty_zip.3mf", refused, "empty"},
      {"3mf/missing_model_part.3mf", refused, "not in the package"},
      {"3mf/missing_rels.3mf", mended, "_rels/.rels is missing", 16000},
      {"3mf/missing_content_types.3mf", mended, "[Content_Types].xml is missing", 16000},
      {"3mf/model_elsewhere.3mf", accepted, "", 16000},
      {"3mf/xml_truncated.3mf", refused, "not well-formed"},
      {"3mf/xml_mismatched_tags.3mf", refused, "not well-formed"},
      {"3mf/index_out_of_range.3mf", refused, "vertex 8000 does not exist; there are 8"},
      {"3mf/index_missing.3mf", refused, "missing"},
      {"3mf/vertex_nan.3mf", refused, "NaN"},
      {"3mf/vertex_text.3mf", refused, "abc"},
      {"3mf/build_unknown_object.3mf", refused, "object 77 does not exist"},
      {"3mf/component_cycle.3mf", refused, "contains itself"},
      {"3mf/duplicate_ids.3mf", refused, "two resources have the id 2"},
      {"3mf/transform_singular.3mf", refused, "flattens"},
      {"3mf/transform_11_numbers.3mf", refused, "11 numbers"},
      {"3mf/transform_scale_rot.3mf", accepted, "", 72000},
      {"3mf/unknown_required_extension.3mf", refused, "extension 'zz'"},
      {"3mf/pindex_out_of_range.3mf", refused, "colour 12 of group 1 does not exist"},
      {"3mf/one_colour.3mf", accepted, "", 8000},
      {"3mf/zip_slip_names.3mf", accepted, "", 16000},
      {"3mf/zip_bomb_10MB.3mf", refused, "not trusted"},
      {"obj/ok_cube.obj", accepted, "", 8000},
      {"obj/index_out_of_range.obj", refused, "vertex 99 does not exist"},
      {"obj/index_zero.obj", refused, "start at 1"},
      {"obj/index_negative_ok.obj", accepted, "", 8000},
      {"obj/face_two_vertices.obj", refused, "2 corners"},
      {"obj/no_faces.obj", refused, "no faces"},
      {"obj/truncated.obj", refused, "0 corners"},
  };
  for (const Row& row : rows) expect({std::string("bad/") + row.file}, row);
}

TEST_F(Corpus, BadPairsAreAcceptedMendedOrRefusedAsListed) {
  using enum Outcome;
  const Row rows[] = {{"gap_1um", accepted, "", 16000},
                      {"shared_face", accepted, "", 16000},
                      {"far_apart", refused, "too large: 320.0 x 20.0"},
                      {"V1_missing_volume", refused, "flat"},
                      {"V1_floating", accepted, "", 9000}};
  for (const Row& row : rows) {
    const std::string folder = std::string("bad/pairs/") + row.file;
    expect({folder + "/V0.stl", folder + "/V1.stl"}, row);
  }
}

TEST_F(Corpus, ModelsOfThePaperAreSoundWithTheVolumesListed) {
  using enum Outcome;
  const auto pair_of = [](const char* name, const char* a, const char* b, double volume) {
    const std::string file = std::string("paper/") + name + "_";
    expect({file + a + ".stl", file + b + ".stl"}, {name, accepted, "", volume});
  };
  pair_of("two-color-world-50mm", "ocean", "land", 62143 + 3087);
  pair_of("dragon-heart", "body", "accent", 39193 + 10141);
  pair_of("spot-cow", "light", "dark", 97710 + 5557);
  pair_of("robot-ice", "crust", "robot", 61764 + 7656);
  pair_of("4-cones", "black", "white", 1570 + 1570);
  pair_of("crystal", "black", "white", 6607 + 6592);
  pair_of("rose", "petals", "green", 1265 + 730);
}

TEST_F(Corpus, ModelsOfOthersAreReadOrRefusedAsListed) {
  using enum Outcome;
  const Row rows[] = {
      {"paper/3mf-variants/rose-volumes-prusaslicer-style.3mf", accepted, "", 1265 + 730},
      {"paper/3mf-variants/spot-colorgroup-per-triangle.3mf", refused, "more than one colour"},
      {"paper/3mf-variants/spot-painted-mmu_segmentation.3mf", refused, "painted"},
      {"thirdparty/union-flag2/Union_flag2.amf", accepted, "", 2024 + 862 + 1265},
      {"thirdparty/3dbenchy/3DBenchy-dualprint-rebuilt.3mf", mended, "four or more", 12904 + 2620},
      {"thirdparty/u1-slicer-bridge/calib-cube-10-dual-colour.3mf", accepted, "", 964 + 964},
      {"thirdparty/3mf-samples/rhombicuboctahedron_color.3mf", refused, "more than one colour"},
      {"thirdparty/3mf-samples/dodeca_chain_loop_color.3mf", refused, "more than one colour"},
      {"thirdparty/3mf-samples/pyramid_vertexcolor.3mf", refused, "more than one colour"},
      {"thirdparty/3mf-samples/sphere_logo.3mf", mended, "texture is ignored", 33382},
      {"thirdparty/3mf-samples/cube_gears.3mf", mended, "without area", 112366},
      {"thirdparty/3mf-samples/cube_gears_prod.3mf", mended, "without area", 112366},
      {"thirdparty/3mf-samples/heartgears.3mf", mended, "without area", 120179},
      {"thirdparty/3mf-samples/multiple_cylinders.3mf", accepted, "", 37189},
      {"thirdparty/lib3mf/materialandcolor2.3mf", mended, "holes closed", 4323 + 791 + 1114 + 67},
      {"thirdparty/lib3mf/Mesh1-two-objects.3mf", accepted, "", 1987 + 28865},
      {"thirdparty/lib3mf/wagon-with-wheels.3mf", accepted, "", 1310744},
      {"thirdparty/lib3mf/detachedmodel-27-instances.3mf", mended, "40.00 mm above", 11250000},
      {"thirdparty/lib3mf/Color_093-legacy.3mf", refused, "more than one colour"},
      {"thirdparty/lib3mf/PyramidWithProperties.3mf", accepted, "", 1000000},
      {"thirdparty/orcaslicer/OrcaCube_v2.3mf", mended, "4 edges are shared", 18388 + 1282},
      {"thirdparty/assimp-amf/test_with_mat.amf", accepted, "", 2731 + 2731},
      {"thirdparty/assimp/production_components.3mf", accepted, "", 167 + 21},
  };
  for (const Row& row : rows) expect({row.file}, row, 400);
  for (int cube = 1; cube <= 4; ++cube) {
    const std::string file = "thirdparty/two-colour-calibration-cubes/cube" + std::to_string(cube);
    expect({file + "_a.stl", file + "_b.stl"},
           {"cubes", accepted, "",
            cube < 3    ? 3992.0
            : cube == 3 ? 3990.0
                        : 3986.0},
           400);
  }
  const std::string flag = "thirdparty/union-flag2/Union_flag2_";
  expect({flag + "Red.stl", flag + "White.stl", flag + "Blue.stl"}, {"flag", accepted, "", 862 + 2024 + 1265}, 400);
  const std::string dual = "thirdparty/matterslice-dual/";
  expect({dual + "Part_A-B_Difference.stl", dual + "Part_B_-_Sphere.stl"},
         {"cube + sphere", mended, "9.95 mm below", 642 + 4113}, 400);
  expect({dual + "Box_Left.stl", dual + "Box_Right.stl"}, {"boxes", accepted, "", 8000}, 400);
}

TEST_F(Corpus, ProjectsAndColoursDecideTheExtruders) {
  const auto extruders = [](const char* file) {
    std::vector<std::vector<Part>> files = {read_model(shared(file))};
    assign_extruders(files, {{}, {}, 4});
    std::vector<int> result;
    for (const Part& part : files[0]) result.push_back(*part.extruder);
    return result;
  };
  EXPECT_EQ(extruders("paper/3mf-variants/rose-volumes-prusaslicer-style.3mf"), (std::vector{0, 1}));
  EXPECT_EQ(extruders("thirdparty/u1-slicer-bridge/calib-cube-10-dual-colour.3mf"), (std::vector{0, 1}));
  EXPECT_EQ(extruders("thirdparty/union-flag2/Union_flag2.amf"), (std::vector{0, 1, 2}));
  EXPECT_EQ(extruders("thirdparty/assimp-amf/test_with_mat.amf"), (std::vector{0, 1}));
  EXPECT_EQ(extruders("thirdparty/3dbenchy/3DBenchy-dualprint-rebuilt.3mf"), (std::vector{0, 1}));
  EXPECT_EQ(extruders("thirdparty/lib3mf/materialandcolor2.3mf"), (std::vector{0, 1, 1, 2}));
  EXPECT_EQ(extruders("thirdparty/lib3mf/Mesh1-two-objects.3mf"), (std::vector{0, 0}));
}

}  // namespace
}  // namespace cleancolor
