// tests/pipeline/slicing.hpp
//
// Whole runs of the program in one call, and the models of the shared folder.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "model/mesh.hpp"
#include "model/meshes.hpp"
#include "pipeline.hpp"
#include "support_errors.hpp"

namespace cleancolor::test {

/// A model of the shared folder, and what it needs.
struct Model {
  const char* name;
  std::vector<std::string> files;  // below shared/models
  const char* refusal = "";        // words of the message; empty: it slices
  bool needs_big_bed = false;      // 400 mm in X, Y and Z, four nozzles
  double layer_mm = 0.3;           // coarse for large ones: the tests run under sanitizers, too
};

inline void PrintTo(const Model& model, std::ostream* out) {
  *out << model.name;
}

/// All models of shared/models/paper and thirdparty.
const std::vector<Model>& models();
/// Requires: there is one of that name.
const Model& model_named(const std::string& name);

std::filesystem::path shared_model(const std::string& file);
bool shared_models_are_there();

/// The config with which the model is sliced in these tests: Replicator Dual, or four nozzles over a 400 mm bed.
Config config_for(const Model& model);

/// The model's parts, mended and placed as the pipeline does.
std::vector<Part> placed_parts(const Model& model, const Config& config);

SliceRequest request_for(const std::vector<std::filesystem::path>& files, const Config& config,
                         const std::filesystem::path& output);
SliceRequest request_for(const Model& model, const Config& config, const std::filesystem::path& output);

struct Sliced {
  Summary summary;
  std::string text;      // of the G-code file
  std::string warnings;  // one a line
};

/// Slices and reads the file back.
Sliced sliced(const SliceRequest& request);

/// One mesh per extruder, written as STL into the folder, sliced.
Sliced sliced(const TestFolder& folder, const std::vector<Mesh>& meshes, const Config& config);

/// Writes a binary STL and returns its path.
std::filesystem::path stl_file(const TestFolder& folder, const std::string& name, const Mesh& mesh);

}  // namespace cleancolor::test
