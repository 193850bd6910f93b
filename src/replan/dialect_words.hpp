// replan/dialect_words.hpp
//
// Dialect words: what the slicers that are re-planned call things, and where they put them.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "reader/line.hpp"
#include "reader/print.hpp"

namespace cleancolor {

/// Prefixes of lines; an empty one: there is none.
struct DialectWords {
  std::array<std::string_view, 2> layer_begins;  // the second may stand before the first, or behind it
  std::array<std::string_view, 2> header_ends;   // what follows in a layer's header may belong to a tool change
  std::string_view own_type;                     // of the rampart
  std::string_view own_object;                   // what belongs to no object; empty: labels are ended instead
  std::string_view elapsed;                      // the time so far, after each layer
  std::string_view width = ";WIDTH:", height = ";HEIGHT:";  // of roads
  std::string_view wipe_begins = ";WIPE_START", wipe_ends = ";WIPE_END";
  std::string_view tower = ";TYPE:Wipe tower";   // begins a piece of it
  std::array<std::string_view, 3> of_ways = {};  // comments that stand before, in and behind travel
  std::string_view travel = "G1";
  bool tells_sizes = true;          // ;WIDTH: and ;HEIGHT: before roads
  bool zeroes_e = true;             // after each drawing back
  bool rises_before_layer = false;  // and goes to where the layer begins
  bool begins_drawn_back = false;   // a tool is taken to be drawn back where it is used first
  bool tower_is_roads = false;      // a prime tower is roads like others; else its pieces stay to the letter
  bool times_heaters = false;       // by how long a tool idles: replan/heaters.hpp
  bool lifts_at_change = false;     // also where it does not lift otherwise
  bool pushes_at_change = false;    // a new tool lowers and pushes part of its filament forward before it travels
};

/// Nothing for dialects that are not re-planned. OrcaSlicer has two, one for each kind of printer.
const DialectWords* words_of(const GcodePrint& print);

/// The tool that the line takes into use; negative: it is not understood; nothing: it is no such line.
std::optional<int> tool_taken(const GcodeLine& line);

}  // namespace cleancolor
