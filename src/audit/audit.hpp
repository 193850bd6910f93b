// audit/audit.hpp
//
// Audit: how clean a print will come out, from its G-code alone.
//
//   print, machine, options  ->  figures: total, by pair of colours, by layer, and as places
//
// Every nozzle is followed through the whole print. What it carries grows while it idles and is left on the first solid
// under its tip; what it lacks shows where it next prints an outer wall. Definitions: docs/audit.md.
//
// Knows nothing of slicing or planning: it shares with them the profile, the roles of roads and `base`.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "audit/exposed.hpp"
#include "audit/figures.hpp"
#include "audit/machine.hpp"
#include "audit/ooze.hpp"
#include "audit/timeline.hpp"
#include "audit/visibility.hpp"
#include "base/progress.hpp"
#include "reader/print.hpp"

namespace cleancolor {

/// One way to judge; every scenario is followed through the same print.
struct Scenario {
  std::string name;  // "worst", "model", or of a variant
  std::string help;
  std::vector<OozeParameters> ooze;  // by nozzle; the last holds for those that follow
  OozeRules rules;
};

/// worst and model; with sensitivity: also the variants of worst.
std::vector<Scenario> scenarios(bool sensitivity = false);

struct AuditOptions {
  std::vector<Scenario> scenarios = cleancolor::scenarios();
  double step_mm = 0.5;  // visibility along a way is looked up this often
  ExposedBy exposed = ExposedBy::both;
  VisibilityOptions visibility;
  int threads = 0;  // 0: as many as the machine has; the figures do not depend on it
};

/// Something that happens at one place.
struct Place {
  enum class Kind : std::uint8_t { smear, inner, own, hole, wipe, zipper };
  Kind kind = Kind::smear;
  std::uint8_t nozzle = 0;  // whose plastic it is, or is missing
  std::uint8_t over = 0;    // whose plastic it lies on; of holes and zippers: the same
  bool travel = false;      // case 1: no nozzle extrudes
  float mm3 = 0;            // times v; of zippers: 1
  float visibility = 0;
  float length_mm = 0;  // of the touch
  std::uint32_t layer = 0;
  std::uint32_t move = 0;  // of the print, in which it happens; of what happens between two, the later
  Vec2 at_mm;              // where the touch begins, in plastic coordinates
  Vec2 end_mm;             // and ends
};

struct PairFigures {
  int nozzle = 0, over = 0;
  Figures figures;
};

struct ScenarioResult {
  std::string name;
  Figures total;
  std::vector<PairFigures> pairs;  // nozzle over foreign colour, all ordered pairs; by nozzle, then by over
  std::vector<Figures> layers;     // as many as the print has
  std::vector<Place> places;       // in the order of time, those of less than 0.001 mm3 left out (zippers stay)
};

struct NozzleUse {
  double part_filament_mm = 0, auxiliary_filament_mm = 0;
  double part_mm3 = 0, auxiliary_mm3 = 0;
  double part_g = 0, auxiliary_g = 0;
};

struct AuditResult {
  std::vector<ScenarioResult> scenarios;  // in the order of the options; at least one
  std::vector<NozzleUse> nozzles;
  double print_time_s = 0;
  double travel_mm = 0;
  int layers = 0;
  int tool_changes = 0;
  std::vector<std::string> warnings;                    // what makes the figures doubtful
  std::shared_ptr<const Timeline> time;                 // for pictures
  std::shared_ptr<const PrintedVisibility> visibility;  // likewise
};

/// Requires: as many nozzles as the print has tools, at least; a scenario at least; step_mm > 0. How it counts where
/// the definitions leave it open: audit/replay.hpp. Same figures for any number of threads. Cost: about 0.4 s of CPU
/// for 200 000 moves; memory: 100 bytes a move beside the print. Throws Error("interrupted").
AuditResult audit(const GcodePrint& print, const AuditMachine& machine, const AuditOptions& options = {},
                  const Progress& progress = {});

/// A place, with what lies so near that people see one defect.
struct Defect {
  std::size_t place = 0;  // index into ScenarioResult::places: the worst one of it
  float mm3 = 0;          // of all
  float length_mm = 0;
};

/// Smears and holes, those closer than 5 mm in one layer and of one pair joined; by mm3, descending.
std::vector<Defect> defects(const ScenarioResult& result);

/// The worst of them as places, with the mm3 and length of all that is joined.
std::vector<Place> worst_places(const ScenarioResult& result, std::size_t count);

}  // namespace cleancolor
