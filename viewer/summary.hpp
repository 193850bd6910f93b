// viewer/summary.hpp
//
// What the page must know of a print before it is audited, as JSON: docs/viewer-api.md.
//
// Counts are those that the audit comes to (tested), found here without it, for the audit takes longer.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "audit/timeline.hpp"
#include "pipeline.hpp"
#include "viewer/moves.hpp"

namespace cleancolor {

/// A print that has been read.  Requires: pointers that are not null, of one print.
struct ReadPrint {
  const GcodePrint* print = nullptr;
  const AuditMachine* machine = nullptr;
  const Timeline* time = nullptr;
  const MoveArrays* moves = nullptr;
  const Config* printer = nullptr;     // nullptr: not known
  const Azimuths* azimuths = nullptr;  // nullptr: not known
  std::vector<std::string> warnings = {};
};

/// Cost: about 20 ns a move.
nlohmann::ordered_json print_summary(const ReadPrint& read);

}  // namespace cleancolor
