// Outlines of the pairs of ../shared/models/paper, layer by layer.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/check.hpp"
#include "model/placement.hpp"
#include "model/read.hpp"
#include "slice/slices.hpp"

namespace cleancolor {

inline std::vector<PackedPolygons> paper_outlines(const std::string& name, const char* first, const char* second,
                                                  double layer_mm) {
  const auto folder = std::filesystem::path(CLEANCOLOR_SHARED) / "models" / "paper";
  std::vector<Part> parts;
  for (const char* colour : {first, second})
    for (Part& part : read_model(folder / (name + "_" + colour + ".stl"))) {
      part.mesh = checked(std::move(part.mesh), part.name);
      part.extruder = int(parts.size());
      parts.push_back(std::move(part));
    }
  Config config;
  config.extruders.resize(2);
  place(parts, config, {});
  const SliceOptions options{.extruders = 2, .first_layer_height_mm = layer_mm, .layer_height_mm = layer_mm};
  return slices(parts, options).outlines;
}

}  // namespace cleancolor
