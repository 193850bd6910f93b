// reader/dialect.hpp
//
// Dialect: what comments of the slicers mean. One pass over the comments, in the order of the file.
//
//   comment  ->  role of what is printed from here on, width, height, and facts about the file
//
// Dialects: PrusaSlicer, SuperSlicer, Slic3r (its verbose comments behind moves), OrcaSlicer and BambuStudio (both
// spellings), Cura (Marlin and Griffin headers), Simplify3D, KISSlicer, ideaMaker, and our own.
// Simplify3D, KISSlicer, BambuStudio and Cura's Griffin are known from hand-written samples only
// (tests/reader/samples).
#pragma once

#include <optional>
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

class CommentReader {
 public:
  explicit CommentReader(GcodeFacts& facts) : facts_(facts) {}

  /// A comment on a line of its own; text without the ';'. Anything not known is left alone.
  void comment(std::string_view text);

  /// A comment behind a command: Slic3r's and Simplify3D's verbose words ("perimeter", "brim", "skirt").
  void comment_behind_command(std::string_view text);

  const CommentState& state() const { return state_; }

 private:
  GcodeFacts& facts_;
  CommentState state_;
  Role before_tower_ = Role::unknown;  // of what a tower, a flush or a refill interrupts
};

/// Reads the configuration block and the header of the file into the facts: producer, dialect, offsets, filament.
///
/// Looks at the first and the last 512 kB of the text at most. A block that cannot be read is warned of, never fatal.
void read_facts(std::string_view text, const std::string& file, GcodeFacts& facts, std::vector<std::string>& warnings);

}  // namespace cleancolor
