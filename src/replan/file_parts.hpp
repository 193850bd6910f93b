// replan/file_parts.hpp
//
// File parts: how a file counts and says things, where its layers begin and end, and which lines of a layer's header
// belong to its first change of tools.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reader/print.hpp"
#include "replan/dialect_words.hpp"
#include "replan/recovered.hpp"

namespace cleancolor {

/// What tells of the whole file stands in so much of its beginning.
inline constexpr std::size_t head_bytes = 4096;

/// Throws Error("file:line: what").
[[noreturn]] void refuse_line(const GcodePrint& print, std::size_t offset, const std::string& what);

/// Whether it begins with one of them; empty ones are none.
bool begins_with_one_of(std::string_view line, const std::array<std::string_view, 2>& prefixes);

/// Of an option in the configuration of a file: whether it is more than nothing.
bool is_set(std::string_view value);

struct FileHabits {
  bool e_of_each_tool = false;     // as in RecoveredPrint
  bool says_on_and_off = false;    // likewise
  bool stands_aside = false;       // at changes of tools: ooze_prevention
  double travel_slope = 0;         // mm a mm, of ways on which nozzles are lifted; 0: it is not told
  bool says_roles_behind = false;  // roads say behind them what they are: verbose comments of Slic3r
};
FileHabits habits_of_file(const GcodePrint& print);

/// Throws Error where a layer is no higher than the one before.
void require_rising(const RecoveredPrint& recovered, const GcodePrint& print);

/// Behind the line that begins at or contains this byte.
std::size_t line_end(std::string_view text, std::size_t at);

/// Behind the wipe that follows there before `stop`, where the next road is, and anything else but moves and what holds
/// until it is said anew; `at` where there is none: a wipe goes over the road before it, and so with it.
std::size_t behind_wipe(std::string_view text, std::size_t at, std::size_t stop, const DialectWords& words);

/// What of a wipe tower is laid at one height, from that road on.
struct TowerPiece {
  std::optional<std::size_t> last_road;  // move; nothing: none is
  std::size_t next_road_at = 0;          // of what follows, in the text; its end where nothing does
};
TowerPiece tower_piece(const GcodePrint& print, std::size_t first_road, double z_mm);

/// Behind the moves from there on that lift the nozzle while it goes round, and come back to where they began; the move
/// itself where there are none. One who goes round on arcs moves in chords.
std::size_t behind_spiral(const GcodePrint& print, std::size_t move);

/// From the first mark of a layer to the last road and its wipe, bytes. Where a tower is roads like others: to the last
/// road of the part, and what its nozzle still travels.
struct LayersText {
  std::size_t begin = 0, end = 0;
  bool prints_after = false;  // more of a tower or shield
};
LayersText layers_text(const GcodePrint& print, const DialectWords& words);

/// Bambu's printers change filament in a way of their own, which drives about: throws Error where they do.
void require_no_own_changes(const GcodePrint& print, const LayersText& layers);

/// A layer that begins with a change of tools.
struct ChangedHeader {
  std::size_t layer = 0;
  int from_tool = 0;
  std::size_t offset = 0;  // of the line that changes it
};

/// The last lines of these headers become those that the tool is left with: as many as elsewhere in the file, else all
/// behind the marks of the layer.
void part_headers(RecoveredPrint& recovered, const std::vector<ChangedHeader>& changed, const GcodePrint& print,
                  const DialectWords& words);

}  // namespace cleancolor
