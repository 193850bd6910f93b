// replan/gap.hpp
//
// Gap: the lines that a file has between two roads, but for moves and what holds until it is said anew.
//
//   end of a run | layer: header | tool: T and what follows | next run
//
// A layer may begin in it, and a tool may be changed, each once at most; where both are, the tool comes later. The
// change may begin before the T: tool changers are told to dock the tool in use (Prusa XL: P0), or the tool that comes
// is heated.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reader/print.hpp"

namespace cleancolor {

struct GapLine {
  std::string_view text;
  std::size_t offset = 0;
  bool is_command = false;
};

/// The texts.
std::vector<std::string> texts_of(std::span<const GapLine> lines);

/// Likewise. Throws Error where one is a command, which cannot be moved.
std::vector<std::string> notes_of(std::span<const GapLine> lines, const GcodePrint& print);

class Gap {
 public:
  void add(const GapLine& line) { lines_.push_back(line); }
  void begin_layer() {
    layer_at_ = lines_.size();
    docks_at_.reset();
  }
  void dock() { docks_at_ = docks_at_.value_or(lines_.size()); }
  void begin_tool(int tool);

  bool has_layer() const { return layer_at_.has_value(); }
  bool has_tool() const { return tool_at_.has_value(); }

  std::span<const GapLine> all() const { return lines_; }
  /// Before the layer, else before the tool, else all.
  std::span<const GapLine> before() const { return part(0, layer_at_.value_or(tool())); }
  std::span<const GapLine> header() const { return layer_at_ ? part(*layer_at_, tool()) : part(0, 0); }
  std::span<const GapLine> enter() const { return part(tool(), lines_.size()); }

 private:
  std::size_t tool() const { return tool_at_.value_or(lines_.size()); }
  std::span<const GapLine> part(std::size_t begin, std::size_t end) const {
    return std::span(lines_).subspan(begin, end - begin);
  }

  std::vector<GapLine> lines_;
  std::optional<std::size_t> layer_at_, docks_at_, tool_at_;
};

}  // namespace cleancolor
