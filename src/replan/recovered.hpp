// replan/recovered.hpp
//
// Recovered print: a file of another slicer taken apart into what can be put in another order, and what cannot.
//
//   text and moves  ->  start | layers: header, runs with all that held while they were printed | end; tool changes
//
// A run is what one nozzle extrudes without a break, with the way to it and what follows it. Where the print is planned
// anew, travel, drawing back and tool changes are made anew. Lines that set something until it is set again
// (replan/modal.hpp) become the state that each road is printed under. A tool change is the lines that the file has for
// it, the same each time. All other lines stay: where they cannot be kept in their place for sure, the file is refused.
//
// Places are the file's own, in whole micrometres, and filament in 1e-5 mm, so that nothing drifts.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reader/print.hpp"
#include "replan/modal.hpp"
#include "replan/tool_changes.hpp"

namespace cleancolor {

struct FilePoint {
  std::int64_t x_um = 0, y_um = 0;
  friend bool operator==(const FilePoint&, const FilePoint&) = default;
};
inline std::int64_t um_of(double mm) {
  return std::llround(mm * 1e3);
}
inline FilePoint file_point(Vec2 mm) {
  return {um_of(mm.x), um_of(mm.y)};
}
inline FilePoint file_point(Vec3 mm) {
  return {um_of(mm.x), um_of(mm.y)};
}
inline Vec2 mm_of(FilePoint p) {
  return {double(p.x_um) / 1e3, double(p.y_um) / 1e3};
}

/// Of a road that goes round: G2, G3. Never a whole circle.
struct RoadArc {
  FilePoint center;
  bool clockwise = false;
};

struct RunRoad {
  FilePoint to;
  std::int64_t filament_e5 = 0;
  std::int64_t at_end_e5 = 0;  // of that, by a road too short to be told, where it ends
  double feed_mm_min = 0;
  std::uint32_t state = 0;  // index into RecoveredPrint::states
  std::uint32_t move = 0;   // index into GcodePrint::moves,
  std::uint32_t moves = 1;  // and how many: the chords of an arc
  std::optional<RoadArc> arc = {};
};

/// Filament is drawn back while the nozzle goes back over what it printed.
struct WipeMove {
  FilePoint to;
  std::int64_t filament_e5 = 0;  // > 0: so much is drawn back
  double feed_mm_min = 0;
};

/// Lines that stay to the letter, in their place of the order: a change of tools with its own place to stand, or a
/// piece of a wipe tower.
struct FixedLines {
  std::vector<std::string> lines;
  bool lays = false;        // plastic: filament is pushed forward before; else drawn back as for a change
  std::size_t tool_at = 0;  // index of the line that the change begins with, where it lays nothing
  int tool_after = 0;       // in use from there on,
  FilePoint to = {};        // where the carriage is then, as the file tells places of that tool
  std::uint32_t state = 0;  // index into RecoveredPrint::states, before it
  std::vector<std::int64_t> drawn_back_e5 = {};  // of each tool, by the lines themselves
};

/// On the spot.
struct FilamentMove {
  std::size_t after = 0;   // so many places of a way
  std::int64_t by_e5 = 0;  // < 0: drawn back
};

/// What is driven after a run, and is no way to the next.
struct LeftWay {
  std::vector<FilePoint> places;
  std::vector<FilamentMove> filament;
};

struct RecoveredRun {
  int tool = 0;
  FilePoint from;
  std::vector<RunRoad> roads;                   // at least one, or
  std::optional<FixedLines> fixed = {};         // none
  std::vector<std::string> notes;               // comments that stand before it
  std::vector<FilePoint> way;                   // passed on the way here in the file
  std::vector<FilamentMove> way_filament = {};  // likewise, moved
  std::vector<std::int64_t> way_z_um = {};      // there, and where it ends; empty: the nozzle does not rise on the way
  std::vector<std::string> spiral = {};         // lines that lift the nozzle before it, and before a change of tools
  std::uint32_t way_state = 0;                  // index into RecoveredPrint::states, on the way
  LeftWay leaving = {};                         // before the tool or the layer changes
  std::vector<FilePoint> wipe_from = {};        // passed before its wipe
  std::vector<WipeMove> wipe = {};              // after it
  std::int64_t back_before_wipe_e5 = 0;         // drawn back on the spot before
  bool lifted = false;                          // the nozzle, on the way here
  bool drawn_back = false;                      // likewise, filament,
  std::size_t back_after = 0;                   // where so many places of the way were passed
};

struct RecoveredLayer {
  std::vector<std::string> header;  // lines
  double z_mm = 0;                  // of the nozzle while it prints
  double height_mm = 0;
  LeftWay leaving;                 // of the layer before, where a tool is taken first,
  std::size_t fed_low = 0;         // and of that, filament moved before the nozzle rises
  std::vector<RecoveredRun> runs;  // as in the file
};

struct RecoveredPrint {
  std::size_t begin = 0, end = 0;  // of the layers in the text, bytes: what lies outside stays as it is; the wipe after
                                   // the last road lies inside
  bool prints_after_end = false;   // more of a tower or shield
  std::vector<RecoveredLayer> layers;
  std::vector<ModalState> states;

  bool keeps_tools = false;  // changes of tools stay as many, and in their order
  ToolChanges changes;

  bool relative_e = false;
  bool e_of_each_tool = false;                    // each tool has its own count, which is never set anew (Sailfish)
  bool says_on_and_off = false;                   // M101 and M103 around what is drawn back (MakerWare)
  double begin_z_mm = 0;                          // where the layers begin; 0: not told
  int begin_tool = 0, end_tool = 0;               // in use where the layers begin, and where they end
  std::uint32_t begin_state = 0, end_state = 0;   // likewise
  std::vector<std::int64_t> begin_drawn_back_e5;  // of each tool
  std::vector<std::int64_t> begin_count_e5;       // of E, of each tool
  std::int64_t end_count_e5 = 0;                  // of the last one
  std::int64_t end_drawn_back_e5 = 0;             // by a wipe after the last road
  double end_feed_mm_min = 0;
  std::string progress_line;         // the first M73 P among the layers, which are told anew; empty: there are none
  std::string silent_progress_line;  // likewise, M73 Q: of the printer's quiet mode
  bool tells_elapsed = false;        // the time so far, likewise
  bool drives_otherwise = false;     // ways have accelerations of their own, told before each
  double change_lift_mm = 0;         // of a nozzle before another one takes over
  double lift_slope = 0;             // mm a mm of way on which nozzles are lifted; 0: they are lifted on the spot
};

/// Throws Error("file:line: ...") for what cannot be put in another order for sure; it says what to do.
/// Requires: the print has its text.  Cost: 50 ns a line and as much memory as the text.
RecoveredPrint recovered_print(const GcodePrint& print);

}  // namespace cleancolor
