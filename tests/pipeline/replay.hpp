// tests/pipeline/replay.hpp
//
// What a printer would do with a G-code file of ours, read back by code that shares nothing with the writer.
//
//   text, offsets of the nozzles  ->  roads and travels in model coordinates, rules that were broken
//
// Everything between the first ;LAYER_CHANGE and the closing ;TYPE:Custom counts; start and end code are the profile's.
// Files have some 100 000 lines and are read under sanitizers too, hence no streams and no maps per line.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.hpp"
#include "model/config.hpp"

namespace cleancolor::test {

/// One straight piece of extrusion.
struct PrintedRoad {
  int tool = 0;
  std::string_view role;  // of ;TYPE:, such as "External perimeter"; lives for ever
  Vec2 from, to;          // where the nozzle is, model coordinates, mm
  double z = 0;           // mm
  double width_mm = 0;    // of ;WIDTH:
  double filament_mm = 0;
  int layer = 0;  // 0-based
};

struct PrintedTravel {
  int tool = 0;
  Vec2 to;
  double z = 0;
  std::size_t before_road = 0;  // index of the road that follows
};

struct Printed {
  std::vector<PrintedRoad> roads;
  std::vector<PrintedTravel> travels;
  std::vector<int> tools;           // as selected one after the other, the first included
  std::vector<double> filament_mm;  // fed by each tool while moving, at least as many as nozzles
  std::vector<double> layer_z_mm;   // of ;Z:
  std::vector<int> percents;        // of M73, in the whole file
  bool roads_after_100_percent = false;
  std::vector<std::string> broken;  // rules of retraction, height, heat and movement, each in words, at most 10
};

Printed replayed(std::string_view text, const Config& config);

/// The list behind "; name = 1.00, 2.00" in the comments at the end; empty where there is none.
std::vector<double> footer_numbers(std::string_view text, std::string_view name);

/// Roads that follow each other without a travel: one loop, or one line of infill.
struct PrintedPath {
  int tool = 0;
  std::string_view role;  // of its first road
  int layer = 0;
  double z = 0;
  std::vector<Vec2> points;
  double length_mm = 0;
};
std::vector<PrintedPath> paths_of(const Printed& printed);

/// Roles that are part of the model.
inline bool is_of_the_model(std::string_view role) {
  return role != "Skirt/Brim" && role != "Custom";
}

}  // namespace cleancolor::test
