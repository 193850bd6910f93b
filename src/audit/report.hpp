// audit/report.hpp
//
// Reports of audits: a table for people, JSON for programs, one HTML page with pictures.
//
// Texts from files (names, producers, commands) are shown without their control characters, and escaped.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "audit/audit.hpp"

namespace cleancolor {

/// Everything that is known of one audited file.  Requires: pointers that are not null; result->scenarios has as many
/// as *scenarios, in their order.
struct AuditedFile {
  std::string name;  // as the user gave it
  const GcodePrint* print = nullptr;
  const AuditMachine* machine = nullptr;
  const AuditResult* result = nullptr;
  const std::vector<Scenario>* scenarios = nullptr;  // that were followed
  std::vector<std::string> warnings;                 // what was warned of while it was read and audited
};

struct ReportOptions {
  std::size_t scenario = 0;      // index: what verdicts, places and pictures speak of
  std::size_t places = 10;       // so many of the worst are listed
  std::size_t worst_layers = 5;  // so many are drawn
};

/// Figures of all scenarios, filament and time, the worst places and the verdict; for a terminal of 100 columns.
std::string audit_text(const AuditedFile& file, const ReportOptions& options = {});

/// The main figures of several files side by side, with time and filament, and whether they print the same part.
std::string comparison_text(std::span<const AuditedFile> files);

/// One JSON object with all files: docs/audit.schema.json ("schema": 1). Of the options only places counts.
std::string audit_json(std::span<const AuditedFile> files, const ReportOptions& options = {});

/// The object of one file in it.
std::string audit_file_json(const AuditedFile& file, const ReportOptions& options = {});

/// A print to turn and look into as part of the page: HTML that is ready, made by whoever can draw so.
struct ReportScene {
  std::string place;          // what stands above the pictures
  std::string scripts;        // at the end of the body: data, and the script that draws it
  std::string script_sha256;  // of that script, in base64; no other may run
  std::string style;          // CSS of what it draws
};

/// One self-contained page: figures, worst layers drawn, smear over height, four sides; several files side by side. All
/// of it can be read without scripts; only the scene has one.
std::string audit_html(std::span<const AuditedFile> files, const ReportOptions& options = {},
                       const ReportScene& scene = {});

}  // namespace cleancolor
