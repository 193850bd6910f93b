// gcode/writer.hpp
//
// GcodeWriter: layers of paths become one G-code file.
//
//   config, what is known of the whole print, layers in order  ->  bytes
//
// Comments, configuration block and thumbnails are in PrusaSlicer's dialect, so its viewers and tools read the file.
// Everything is written as it comes: only the remaining times (M73) are filled in at the end, in place.
//
//   header        who wrote it, nozzle offsets and who makes up for them, thumbnails
//   start         temperatures that the start code does not set, start code, units, first tool
//   each layer    ;LAYER_CHANGE ;Z: ;HEIGHT:, templates, then its paths:
//                   tool change, draw back, lift, travel by way of Path::travel, lower, push forward,
//                   ;TYPE: ;WIDTH: ;HEIGHT: fan and acceleration where they change, segments
//   end           end code, filament and time, configuration block
//
// A path's points are simplified by gcode_resolution; a closed path ends seam_gap_distance before its start. Only
// extruders that print are heated; one that has printed its last path is turned off (heater_off_after_last_use).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gcode/text.hpp"
#include "model/config.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

class OutputFile;

struct Thumbnail {
  int width_px = 0;
  int height_px = 0;
  std::string png;  // the bytes of the file
};

/// What must be known before the first layer is written.
struct PrintInfo {
  std::string name;  // of what is printed; may be empty
  int layer_count = 0;
  double max_z_mm = 0;
  int initial_extruder = 0;                    // of the first path
  int bed_extruder = 0;                        // whose material says how hot the bed must be
  std::vector<std::optional<int>> last_layer;  // Layer::index, for each extruder of the config; nullopt: prints nothing
  Box<Vec2> first_layer_box_mm;                // of all paths in the first layer
  std::vector<Thumbnail> thumbnails;
};

struct FilamentUse {
  double length_mm = 0;  // what is drawn back at the end does not count
  double volume_mm3 = 0;
  double weight_g = 0;
  double cost = 0;
};

struct PrintFigures {
  int layers = 0;
  int tool_changes = 0;
  double time_s = 0;  // heating not included
  double first_layer_time_s = 0;
  std::vector<FilamentUse> extruders;  // one for each extruder of the config
};

class GcodeWriter {
 public:
  /// config and sink are used until finish(). Requires: the config is valid (model/validate.hpp).
  GcodeWriter(const Config& config, PrintInfo info, Sink sink);
  ~GcodeWriter();

  /// Layers in ascending order of print_z_mm. Throws Error where a template cannot be filled in.
  /// Requires: every path has at least two points (three where closed) and an extruder that info.last_layer names.
  /// Cost: about 0.3 us a segment.
  void layer(const Layer& layer);

  /// Writes the end of the file. Nothing may be written after.
  PrintFigures finish();

 private:
  class Print;
  std::unique_ptr<Print> print_;
};

/// A sink into a file; both must live as long as the writer.
Sink to_file(OutputFile& file);

}  // namespace cleancolor
