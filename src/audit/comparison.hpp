// audit/comparison.hpp
//
// Comparison: several audits as one table, for text and HTML.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "audit/report.hpp"

namespace cleancolor {

struct ComparisonRow {
  std::string group;  // "worst", "model", "print"
  std::string name;   // "smear_volume", "time", "T0 part"
  std::string unit;   // may be empty
  std::vector<double> values = {};
  std::vector<std::string> texts = {};  // the values as they are shown
};

/// The main figures of the scenarios that all files have, then time, travel and filament. values and texts: one for
/// each file.
std::vector<ComparisonRow> comparison(std::span<const AuditedFile> files);

/// The most plastic that one of the files gives the part, beyond the least, as a share of the least.
double part_difference(std::span<const AuditedFile> files);

/// Files whose part plastic differs by more do not print the same part.
inline constexpr double same_part_share = 0.03;

/// One sentence about part_difference.
std::string same_part_text(std::span<const AuditedFile> files);

}  // namespace cleancolor
