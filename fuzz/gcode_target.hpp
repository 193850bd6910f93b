// fuzz/gcode_target.hpp
//
// What the fuzz target of the G-code reader does with one input, also called by the test that replays seeds and
// findings.
//
// An Error is a fine answer. A print that is accepted must keep the promises of reader/print.hpp: offsets are where
// lines begin and ascend, numbers are finite, layers ascend, every index is in range. Otherwise the target aborts.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "reader/read.hpp"

namespace cleancolor {

inline bool begins_a_line(std::string_view text, std::uint32_t offset) {
  return offset < text.size() && (offset == 0 || text[offset - 1] == '\n' || text[offset - 1] == '\r' ||
                                  (offset == 3 && text.starts_with("\xEF\xBB\xBF")));
}

inline bool keeps_promises(const GcodeMove& move, const GcodePrint& print) {
  const auto sane = [](double value) { return std::isfinite(value) && std::abs(value) < 1e12; };
  const Vec3 to = move.to_mm;
  return begins_a_line(*print.text, move.offset) && move.layer < print.layers.size() && move.tool < print.tools &&
         move.feeds < max_tools && std::abs(to.x) <= 1e4 && std::abs(to.y) <= 1e4 && std::abs(to.z) <= 1e4 &&
         sane(move.filament_mm) && sane(move.speed_mm_s) && move.speed_mm_s >= 0 && sane(move.acceleration_mm_s2) &&
         sane(move.width_mm) && move.width_mm >= 0 && sane(move.height_mm) && move.height_mm >= 0;
}

inline bool keeps_promises(const GcodeEvent& event, const GcodePrint& print) {
  return begins_a_line(*print.text, event.offset) && event.before_move <= print.moves.size() && event.axis < 4 &&
         event.tool < max_tools && std::isfinite(event.value) &&
         (event.kind != GcodeEvent::Kind::tool_change || event.tool < print.tools);
}

inline void require_promises(const GcodePrint& print) {
  const auto require = [](bool promise) {
    if (!promise) std::abort();
  };
  require(print.tools >= 1 && print.tools <= max_tools);
  require(!print.moves.empty() && !print.layers.empty());
  require(std::ranges::is_sorted(print.moves, {}, &GcodeMove::offset));
  require(std::ranges::is_sorted(print.events, {}, &GcodeEvent::offset));
  require(std::ranges::is_sorted(print.events, {}, &GcodeEvent::before_move));
  require(std::ranges::is_sorted(print.layers, {}, &GcodeLayer::z_mm));
  for (const GcodeMove& move : print.moves) require(keeps_promises(move, print));
  for (const GcodeEvent& event : print.events) require(keeps_promises(event, print));
  for (const GcodeLayer& layer : print.layers) require(std::isfinite(layer.z_mm) && layer.height_mm > 0);
}

inline void fuzz_gcode(std::string_view text) {
  try {
    require_promises(read_gcode(std::string(text), "fuzz.gcode"));
  } catch (const Error&) {
  }
}

}  // namespace cleancolor
