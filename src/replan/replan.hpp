// replan/replan.hpp
//
// Replan: G-code of another slicer, with all its paths and settings, in an order and by ways that keep colours clean.
//
//   print, printer  ->  text
//
// The paths are found again (replan/recovered.hpp), planned as our own are (replan/planning.hpp), and written back in
// the dialect of the file (replan/written.hpp); what comes out is read again and compared (replan/same_print.hpp). Of
// several such attempts (replan/attempts.hpp) the one that is worth most is handed out (replan/worth.hpp).
#pragma once

#include <optional>
#include <string>

#include "audit/machine.hpp"
#include "base/progress.hpp"
#include "model/config.hpp"
#include "reader/print.hpp"
#include "replan/worth.hpp"

namespace cleancolor {

/// --protect
enum class ReplanProtection { none, rampart, full };

struct ReplanRequest {
  std::optional<Config> printer = {};  // a profile; the file's configuration is put over it
  ReplanProtection protection = ReplanProtection::full;
  bool keeps_order = false;     // order, starts and travel stay those of the file
  bool keeps_seams = false;     // loops begin where they do in the file
  bool removes_shield = false;  // a skirt as high as the print; a rampart takes its place
  bool removes_tower = false;   // that wipes; likewise
  int threads = 1;
};

/// By the worst scenario of the audit: of the file, and of what became of it.
struct Gain {
  Cleanness before, after;
};

struct Replanned {
  std::string text;     // of the file
  bool changed = true;  // false: it is as it was, for this reason
  std::string reason = {};
  bool has_rampart = false;
  std::optional<Gain> gain = {};  // where it was judged: with order, travel and rampart planned
  double time_s = 0;              // predicted, of both
  double old_time_s = 0;
  double filament_mm = 0, old_filament_mm = 0;  // of all nozzles
  double removed_mm3 = 0;                       // of plastic: shield and tower
};

/// Throws Error("file:line: ...") for files that cannot be re-planned for sure; it says what to do.
/// Requires: the print has its text.  The same text for any number of threads.
/// Cost: about as long as slicing the part.
Replanned replanned(const GcodePrint& print, const AuditMachine& machine, const ReplanRequest& request,
                    const Progress& progress = {});

}  // namespace cleancolor
