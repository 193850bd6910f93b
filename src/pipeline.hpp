// pipeline.hpp
//
// The whole program, top to bottom: model files -> parts -> layers -> paths -> order -> G-code.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "model/config.hpp"
#include "model/placement.hpp"
#include "orient/azimuth.hpp"
#include "slice/slices.hpp"

namespace cleancolor {

struct ModelFile {
  std::filesystem::path path;
  std::optional<int> extruder;  // 0-based; of all its parts
};

struct SliceRequest {
  std::vector<ModelFile> files;                  // at least one
  std::map<std::uint32_t, int> extruder_of_rgb;  // --map-colour: 0xRRGGBB -> extruder, 0-based
  Config config;
  Placement placement;
  std::optional<double> azimuth_deg;  // turned by so much beside placement; empty: the best where idle nozzles hover
  Overlap overlap = Overlap::refuse;
  std::filesystem::path output;   // written aside and renamed
  std::filesystem::path preview;  // a PNG picture of the coloured parts; empty: none
  int threads = 0;                // 0: as many as the machine has
};

struct ExtruderUse {
  double filament_mm = 0;
  double filament_g = 0;
  double cost = 0;
};

/// What was done against ooze.
struct Protection {
  double azimuth_deg = 0;
  std::optional<Azimuths> azimuths;  // where they were looked at
  RampartShape rampart = RampartShape::off;
  double rampart_g = 0;
};

struct Summary {
  int layers = 0;
  int tool_changes = 0;
  double time_s = 0;                   // heating not included
  std::vector<ExtruderUse> extruders;  // one for each extruder of the config
  Protection protection;
};

/// Slices the files and writes one G-code file.
///
/// Throws Error where input or options cannot be used (no output is left), SystemError where writing fails.
/// The same request gives the same bytes for any number of threads.
Summary slice(const SliceRequest& request, const Progress& progress = {});

/// The curves by which slice() turns the parts of the request, output and preview aside. Throws as slice() does.
Azimuths azimuths(const SliceRequest& request, const Progress& progress = {});

}  // namespace cleancolor
