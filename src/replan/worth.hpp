// replan/worth.hpp
//
// Worth: which of several plans of one print is handed out, or none of them.
//
//   audit of the file and of its plans  ->  the plan that costs least, or the file as it is
//
// A print costs what the planner counts, too: smear + weight_hole_volume x holes + weight_time x seconds, as the
// audit's worst scenario finds them. Seconds beyond 1.3 times the file's count ten times. A rampart goes around all
// that stands on the bed; where that may cost more than it brings, one around a single column (replan/columns.hpp) is
// tried, which fills nozzles all the same, and none.
#pragma once

#include <vector>

#include "audit/machine.hpp"
#include "base/progress.hpp"
#include "model/config.hpp"
#include "reader/print.hpp"

namespace cleancolor {

enum class RampartExtent { all, column, none };

struct Cleanness {
  double smear_mm3 = 0, hole_mm3 = 0, time_s = 0;
};

/// As the worst scenario of the audit counts.
Cleanness cleanness(const GcodePrint& print, const AuditMachine& machine, int threads, const Progress& progress);

/// before: of the file.
double print_cost(const Cleanness& print, const Cleanness& before, const Config& config);

/// What may cost less than a rampart around all.
std::vector<RampartExtent> worth_trying(const Cleanness& with_rampart, const Cleanness& before, const Config& config);

/// Whether it is handed out: smears and weighted holes together are at most 2 % and 0.05 mm3 more than the file's, and
/// it costs less, or spares a larger share of them than it adds to the time, up to 1.3 times the file's.
bool is_worth_it(const Cleanness& print, const Cleanness& before, const Config& config);

}  // namespace cleancolor
