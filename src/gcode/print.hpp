// gcode/print.hpp
//
// What GcodeWriter hides: one print while it is written. Layers: writer.cpp; start and end of the file: print_ends.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gcode/clock.hpp"
#include "gcode/expression.hpp"
#include "gcode/machine.hpp"
#include "gcode/placeholder.hpp"
#include "gcode/polyline.hpp"
#include "gcode/text.hpp"
#include "gcode/writer.hpp"

namespace cleancolor {

double filament_area_mm2(const Extruder& extruder);

class GcodeWriter::Print {
 public:
  Print(const Config& config, PrintInfo info, Sink sink);
  void layer(const Layer& layer);
  PrintFigures finish();

 private:
  // writer.cpp
  void draw_back();
  void path(const Layer& layer, const Path& path);
  void travel(const Path& path);
  Machine::Feed begin_road(const Layer& layer, const Extruder& extruder, const Road& road);
  void change_tool(const Layer& layer, std::size_t first_path);
  void turn_off_finished(const Layer& layer, std::size_t from_path);
  void later_temperatures();
  void custom(std::string_view code, std::string_view option_name);

  // print_ends.cpp
  void header();
  void thumbnails();
  void start(const Layer& first);
  void set_print_placeholders(const Layer& first);
  void set_tools(int previous, int next);
  bool selects(std::string_view code, int tool) const;
  void first_tool(std::string_view start_code);
  void progress_line();
  void progress_mark();
  void fill_in_progress();
  PrintFigures figures();
  void statistics(const PrintFigures& figures);
  void config_comments();

  struct ProgressLine {
    Clock::Mark mark;
    std::uint64_t offset;
  };

  const Config& config;
  PrintInfo info;
  Text text;
  Clock clock;
  Machine machine;
  Placeholders placeholders;
  Polyline polyline;  // of the path being written; its memory is used again
  std::vector<ProgressLine> progress;
  double last_progress_s = 0;

  bool started = false;
  std::vector<bool> heated;  // of each extruder: on until told otherwise
  int layers_written = 0;
  int tool_changes = 0;
  Clock::Mark first_layer_end = 0;
  std::optional<Role> role;  // as last told in a comment
  double width_mm = 0;
  double height_mm = 0;
};

}  // namespace cleancolor
