// audit/report_words.hpp
//
// Words and numbers that all reports share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "audit/audit.hpp"

namespace cleancolor {

/// A figure as a person reads it: mm3 with two digits behind the point, mm with none, counts as they are.
std::string figure_text(double value, std::string_view unit);

/// "1 234.5 m" of filament or way, from mm.
std::string metres_text(double mm);

/// "smear of T1 over T0", "hole in T0".
std::string place_text(const Place& place);

/// Layers with a smear (or hole) volume of at least 0.001 mm3, and the worst of them; of equals the lowest.
struct AffectedLayers {
  std::size_t count = 0;
  std::optional<std::uint32_t> worst;
};
AffectedLayers smeared_layers(const ScenarioResult& scenario);
AffectedLayers holed_layers(const ScenarioResult& scenario);

/// The layers with most smear, hole volume added; those without any left out. By volume, descending.
std::vector<std::uint32_t> worst_layers(const ScenarioResult& scenario, std::size_t count);

/// One line: "smears: 53.0 mm3 in 61 of 146 layers, most in layer 37 (z 11.10 mm); holes: ...".
std::string verdict(const GcodePrint& print, const AuditResult& result, std::size_t scenario);

/// Where the idle nozzles are, in words.
std::string_view idle_nozzle_text(IdleNozzle idle);

/// "the slicer", "the firmware".
std::string_view offsets_in_text(OffsetsIn offsets_in);

/// Who wrote the file; "unknown" where it does not say. Printable.
std::string producer_text(const GcodePrint& print);

}  // namespace cleancolor
