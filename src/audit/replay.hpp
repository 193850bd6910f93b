// audit/replay.hpp
//
// Replay: the print once more, in the order of time, with every nozzle's ooze in every scenario.
//
//   drives with their crossings  ->  figures, places, filament
//
// How it counts, where the definitions of docs/audit.md leave it open:
// * All nozzles that lay plastic in the print begin to idle when the first of them does: they were primed just before.
// * A tip takes or leaves plastic as it goes: what it carries is left at the begin of a piece, what flows out over the
//   piece along it. Pieces over auxiliary plastic that follow without a gap, also from drive to drive, are one
//   crossing; it is a wipe if it begins with more than 0.001 mm3 on the tip.
// * Plastic pushed in place (beyond an unretraction) makes up what is missing. More than 0.5 mm3 in one move counts as
//   printing: it takes along what the tip carries, and the clock of idling starts anew.
// * What a stroke makes up is missing at its begin: v of a hole is that of the middle of this first part.
// * An extrusion is a run of laying moves; a retraction, a change of nozzle or a move that lays nothing ends it.
// * A refill is a run of moves whose role is refill.
// * Scenarios with a temperature let ooze go on while the print waits for a heater. print_time never counts the wait.
#pragma once

#include <memory>
#include <vector>

#include "audit/audit.hpp"
#include "audit/crossings.hpp"

namespace cleancolor {

class Replay {
 public:
  /// All are kept by reference.
  Replay(const GcodePrint& print, const AuditMachine& machine, const Timeline& time,
         const PrintedVisibility& visibility, const std::vector<Scenario>& scenarios);
  ~Replay();

  /// The next drives. Requires: called in the order of time, without a gap.
  void follow(const Crossings& crossings, std::span<const std::shared_ptr<const LayerPlastic>> plastic);

  struct Result {
    std::vector<ScenarioResult> scenarios;
    std::vector<NozzleUse> nozzles;
    int tool_changes = 0;
  };
  Result finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace cleancolor
