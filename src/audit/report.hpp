// audit/report.hpp
//
// Reports of audits: a table for people, JSON for programs, one HTML page with pictures.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "audit/audit.hpp"

namespace cleancolor {

/// Everything that is known of one audited file.
struct AuditedFile {
  std::string name;  // as the user gave it
  const GcodePrint* print = nullptr;
  const AuditMachine* machine = nullptr;
  const AuditResult* result = nullptr;
};

/// Figures of all scenarios, filament and time, and the worst places; for a terminal of 100 columns.
std::string audit_text(const AuditedFile& file, std::size_t places = 10);

/// The main figures of several files side by side, with time and filament, and whether they print the same part
/// (plastic within 3 %).
std::string comparison_text(std::span<const AuditedFile> files);

/// One JSON object with all files; its fields are documented in docs/audit.md ("schema": 1).
std::string audit_json(std::span<const AuditedFile> files);

/// One self-contained page: figures, worst layers drawn, smear over height, four sides; several files side by side.
std::string audit_html(std::span<const AuditedFile> files, std::size_t worst_layers = 5);

}  // namespace cleancolor
