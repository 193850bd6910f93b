// reader/dialect.hpp
//
// Dialect: what comments of the slicers mean. One pass over the comments, in the order of the file.
//
//   comment  ->  role of what is printed from here on, width, height, and facts about the file
//
// Dialects: PrusaSlicer, SuperSlicer, Slic3r (its verbose comments behind moves), OrcaSlicer and BambuStudio (both
// spellings), Cura (Marlin and Griffin headers), Simplify3D, KISSlicer, ideaMaker, and our own.
// Which of them were tried on real files: docs/gcode-dialects.md.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "reader/print.hpp"

namespace cleancolor {

/// What holds for the moves that follow, as far as comments tell.
struct CommentState {
  Role role = Role::unknown;
  double width_mm = 0;   // 0: not told
  double height_mm = 0;  // 0: not told
  bool object = true;    // false: the comment says that what follows belongs to no object (;MESH:NONMESH)
};

struct RoleName;

/// Cost: 3 to 30 ns a comment; no allocation.
class CommentReader {
 public:
  explicit CommentReader(GcodeFacts& facts) : facts_(facts) {}

  /// A comment on a line of its own; text without the ';'. Anything not known is left alone.
  void comment(std::string_view text);

  /// A comment behind a command: Slic3r's verbose words ("perimeter", "brim"), in files that tell roles nowhere else.
  void comment_behind_command(std::string_view text);

  const CommentState& state() const { return state_; }

 private:
  /// What interrupts other things: after its end, what was printed before goes on.
  enum Block : std::size_t { tower, toolchange, flush, refill, blocks };

  void says(std::string_view name, std::span<const RoleName> names);
  void begin(Block block, Role role);
  void end(Block block);

  GcodeFacts& facts_;
  CommentState state_;
  std::array<std::optional<Role>, blocks> before_;  // of each block that is open
  bool on_own_lines_ = false;                       // roles are told by comments on lines of their own
};

/// "1d 2h 7m 8s", "0 hours 42 minutes", "332.83 minutes", "1234": a number alone counts seconds. 0: no time, or a time
/// of day.
double seconds_of(std::string_view text);

/// Reads the configuration block and the header of the file into the facts: producer, dialect, offsets, filament.
///
/// Looks at the first and the last 512 kB of the text at most. A block that cannot be read is warned of, never fatal.
void read_facts(std::string_view text, const std::string& file, GcodeFacts& facts, std::vector<std::string>& warnings);

}  // namespace cleancolor
