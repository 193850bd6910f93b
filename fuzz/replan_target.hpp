// fuzz/replan_target.hpp
//
// What the fuzz target of re-planning does with one input, also called by the test that replays seeds and findings.
//
// An Error is a fine answer. What is re-planned was compared with the input by replanned() itself; it is not re-planned
// twice, and is the same for one and two threads. Otherwise the target aborts.
#pragma once

#include <cstdlib>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "reader/read.hpp"
#include "replan/replan.hpp"

namespace cleancolor {

inline void fuzz_replan(std::string_view text) {
  const auto replanned_by = [](const std::string& file, int threads) {
    const GcodePrint print = read_gcode(file, "fuzz.gcode");
    return replanned(print, audit_machine(print, {}), {.threads = threads});
  };
  try {
    const Replanned once = replanned_by(std::string(text), 1);
    if (replanned_by(std::string(text), 2).text != once.text) std::abort();
    if (const Replanned again = replanned_by(once.text, 1); again.changed || again.text != once.text) std::abort();
  } catch (const Error&) {
  }
}

}  // namespace cleancolor
