// replan/same_print.hpp
//
// Same print: whether what was written prints the same part as what was read. Nothing is handed out without it.
//
// Compared: filament of each tool and role, to 0.01 %; the roads as sets of points, each once, but for seams that
// moved; that filament never stays drawn back while plastic is laid. Walls of a rampart and refills are ours, and left
// out.
#pragma once

#include <optional>
#include <string>

#include "audit/machine.hpp"
#include "reader/print.hpp"
#include "replan/removed.hpp"

namespace cleancolor {

struct ComparisonOptions {
  RemovedFilament removed = {};  // from the one before
  int threads = 1;               // two at most are of use
};

/// What differs, in words; nothing where they are the same.  Requires: one machine for both.
std::optional<std::string> difference(const GcodePrint& before, const GcodePrint& after, const AuditMachine& machine,
                                      const ComparisonOptions& options = {});

}  // namespace cleancolor
