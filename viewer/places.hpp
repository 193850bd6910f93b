// viewer/places.hpp
//
// What the audit found as arrays of numbers: places, figures of each layer, visibility of each move.
//
// Of the scenario that stands first (worst). The format: docs/viewer-api.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "audit/audit.hpp"

namespace cleancolor {

struct PlaceArrays {
  std::vector<std::uint8_t> visibility;                       // by move that lays plastic: 255 is in plain sight
  std::vector<float> layer_smear, layer_hole, layer_zippers;  // by layer: mm3, mm3, count
  std::vector<float> place_from, place_to;                    // x, y, z
  std::vector<float> place_mm3, place_visibility;
  std::vector<std::uint32_t> place_layer, place_move;
  std::vector<std::uint8_t> place_kind, place_nozzle, place_over;  // kind: Place::Kind
  std::vector<Defect> worst;                                       // by mm3, descending
};

/// Requires: the result of this print.  Cost: about 0.5 us of CPU a move.
PlaceArrays place_arrays(const GcodePrint& print, const AuditMachine& machine, const AuditResult& result,
                         int threads = 0);

/// The arrays as one binary answer; in its header the figures of the whole print, and what each nozzle
/// oozes in the scenario that they are of.
std::string places_file(const PlaceArrays& places, const Figures& total, const Scenario& scenario,
                        const AuditMachine& machine);

}  // namespace cleancolor
