#include "slicing.hpp"

#include <algorithm>
#include <cstring>

#include "model/assign.hpp"
#include "model/check.hpp"
#include "model/read.hpp"
#include "model/settings.hpp"

namespace cleancolor::test {
namespace {

Model pair_of(const char* name, const char* first, const char* second) {
  const std::string stem = std::string("paper/") + name + "_";
  return {name, {stem + first + ".stl", stem + second + ".stl"}};
}

std::vector<Model> listed_models() {
  const std::string cubes = "thirdparty/two-colour-calibration-cubes/cube", flag = "thirdparty/union-flag2/Union_flag2",
                    samples = "thirdparty/3mf-samples/", lib3mf = "thirdparty/lib3mf/",
                    dual = "thirdparty/matterslice-dual/", variants = "paper/3mf-variants/";
  constexpr const char* colours = "more than one colour";
  return {
      pair_of("two-color-world-50mm", "ocean", "land"),
      pair_of("dragon-heart", "body", "accent"),
      pair_of("spot-cow", "light", "dark"),
      pair_of("robot-ice", "crust", "robot"),
      pair_of("4-cones", "black", "white"),
      pair_of("crystal", "black", "white"),
      pair_of("rose", "petals", "green"),
      {"rose-volumes", {variants + "rose-volumes-prusaslicer-style.3mf"}},
      {"spot-colorgroup", {variants + "spot-colorgroup-per-triangle.3mf"}, colours},
      {"spot-painted", {variants + "spot-painted-mmu_segmentation.3mf"}, "painted"},
      {"calibration-cube1", {cubes + "1_a.stl", cubes + "1_b.stl"}},
      {"calibration-cube2", {cubes + "2_a.stl", cubes + "2_b.stl"}},
      {"calibration-cube3", {cubes + "3_a.stl", cubes + "3_b.stl"}},
      {"calibration-cube4", {cubes + "4_a.stl", cubes + "4_b.stl"}},
      {"calibration-cubes", {cubes + "s_a.stl", cubes + "s_b.stl"}},
      {"union-flag", {flag + "_Red.stl", flag + "_White.stl", flag + "_Blue.stl"}, "", true},
      {"union-flag-amf", {flag + ".amf"}, "", true},
      {"benchy", {"thirdparty/3dbenchy/3DBenchy-dualprint-rebuilt.3mf"}, "", false, 0.4},
      {"cube-and-sphere", {dual + "Part_A-B_Difference.stl", dual + "Part_B_-_Sphere.stl"}},
      {"two-boxes", {dual + "Box_Left.stl", dual + "Box_Right.stl"}},
      {"xyz-cube", {"thirdparty/u1-slicer-bridge/calib-cube-10-dual-colour.3mf"}},
      {"rhombicuboctahedron", {samples + "rhombicuboctahedron_color.3mf"}, colours, true},
      {"dodeca-chain", {samples + "dodeca_chain_loop_color.3mf"}, colours, true},
      {"pyramid-vertexcolor", {samples + "pyramid_vertexcolor.3mf"}, colours},
      {"sphere-logo", {samples + "sphere_logo.3mf"}},
      {"cube-gears", {samples + "cube_gears.3mf"}, "", true, 0.6},
      {"cube-gears-prod", {samples + "cube_gears_prod.3mf"}, "", true, 0.6},
      {"heartgears", {samples + "heartgears.3mf"}, "", false, 0.4},
      {"cylinders", {samples + "multiple_cylinders.3mf"}},
      {"materialandcolor2", {lib3mf + "materialandcolor2.3mf"}, "", true},
      {"bulldozer", {lib3mf + "Mesh1-two-objects.3mf"}},
      {"wagon", {lib3mf + "wagon-with-wheels.3mf"}, "", true, 0.8},
      {"detachedmodel", {lib3mf + "detachedmodel-27-instances.3mf"}, "", true, 0.7},
      {"color-093", {lib3mf + "Color_093-legacy.3mf"}, colours, true},
      {"pyramid-properties", {lib3mf + "PyramidWithProperties.3mf"}, "", false, 0.6},
      {"orca-cube", {"thirdparty/orcaslicer/OrcaCube_v2.3mf"}, "", false, 0.4},
      {"amf-with-materials", {"thirdparty/assimp-amf/test_with_mat.amf"}},
      {"production-components", {"thirdparty/assimp/production_components.3mf"}},
  };
}

}  // namespace

const std::vector<Model>& models() {
  static const std::vector<Model> all = listed_models();
  return all;
}

const Model& model_named(const std::string& name) {
  return *std::ranges::find_if(models(), [&](const Model& m) { return name == m.name; });
}

std::filesystem::path shared_model(const std::string& file) {
  return std::filesystem::path(CLEANCOLOR_SHARED) / "models" / file;
}

bool shared_models_are_there() {
  return std::filesystem::exists(shared_model("paper"));
}

Config config_for(const Model& model) {
  std::vector<std::string> set = {"layer_height=" + std::to_string(model.layer_mm),
                                  "first_layer_height=" + std::to_string(model.layer_mm)};
  if (model.layer_mm > 0.3) {
    // A nozzle that lays such layers, and roads as wide as it likes.
    set.push_back("nozzle_diameter=" + std::to_string(1.5 * model.layer_mm));
    for (const char* width :
         {"", "first_layer_", "perimeter_", "external_perimeter_", "infill_", "solid_infill_", "top_infill_"})
      set.push_back(std::string(width) + "extrusion_width=0");
  }
  if (!model.needs_big_bed) return config_of({.printer = "replicator-dual", .set = set});
  set.push_back("bed_shape=0x0,400x0,400x400,0x400");
  set.push_back("max_print_height=400");
  return config_of({.printer = "rrf-toolchanger", .print = "draft", .set = set});
}

std::vector<Part> placed_parts(const Model& model, const Config& config) {
  std::vector<std::vector<Part>> files;
  for (const std::string& file : model.files) files.push_back(read_model(shared_model(file)));
  assign_extruders(files, {.extruder_of_file = {}, .extruder_of_rgb = {}, .extruders = int(config.extruders.size())});
  std::vector<Part> parts;
  for (std::vector<Part>& file : files)
    for (Part& part : file) {
      part.mesh = checked(std::move(part.mesh), part.name);
      parts.push_back(std::move(part));
    }
  place(parts, config, {});
  return parts;
}

SliceRequest request_for(const std::vector<std::filesystem::path>& files, const Config& config,
                         const std::filesystem::path& output) {
  SliceRequest request;
  for (const auto& file : files) request.files.push_back({file, {}});
  request.config = config;
  request.azimuth_deg = 0;  // the tests look for parts where the files put them
  request.output = output;
  request.threads = 1;  // the tests themselves run side by side
  return request;
}

SliceRequest request_for(const Model& model, const Config& config, const std::filesystem::path& output) {
  std::vector<std::filesystem::path> files;
  for (const std::string& file : model.files) files.push_back(shared_model(file));
  return request_for(files, config, output);
}

Sliced sliced(const SliceRequest& request) {
  Warnings warnings;
  Sliced result;
  result.summary = slice(request, warnings.progress);
  result.text = file_text(request.output);
  result.warnings = warnings.all();
  return result;
}

Sliced sliced(const TestFolder& folder, const std::vector<Mesh>& meshes, const Config& config) {
  std::vector<std::filesystem::path> files;
  for (const Mesh& mesh : meshes)
    files.push_back(stl_file(folder, "part" + std::to_string(files.size()) + ".stl", mesh));
  return sliced(request_for(files, config, folder.path("out.gcode")));
}

std::filesystem::path stl_file(const TestFolder& folder, const std::string& name, const Mesh& mesh) {
  std::string bytes(80, ' ');
  const auto append = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  append(std::uint32_t(mesh.triangles.size()));
  for (const Triangle& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) append(0.0F);  // the normal: zeroes mean that the corners tell
    for (const std::uint32_t corner : triangle) {
      const Vec3& p = mesh.vertices[corner];
      for (const double c : {p.x, p.y, p.z}) append(float(c));
    }
    append(std::uint16_t(0));
  }
  return folder.file(name, bytes);
}

}  // namespace cleancolor::test
