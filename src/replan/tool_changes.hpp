// replan/tool_changes.hpp
//
// Tool changes: the lines that a file leaves each tool with, and takes it with: its T and what follows.
//
// They are the same each time, or they cannot be moved. Comments and messages may differ, for they tell the layer or
// the other tool: then they are left out, being true of one change alone. A temperature that they set may be another
// one in the first layer: a change that comes there, or later, for the first time takes it from the configuration.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "model/config.hpp"

namespace cleancolor {

class ToolChanges {
 public:
  using Lines = std::vector<std::string>;

  /// Whether the lines are as they were before, if they were. What is left out is empty from then on.
  bool take_leave(int tool, const Lines& lines);
  bool take_enter(int tool, const Lines& lines, bool in_first_layer);

  /// nullptr: not known.
  const Lines* leave(int tool) const;

  /// Empty: not known. extruder: the tool's.
  Lines enter(int tool, bool in_first_layer, const Extruder& extruder) const;

 private:
  std::map<int, Lines> leave_, enter_first_, enter_;
};

}  // namespace cleancolor
