// cli/audit_arguments.hpp
//
// The arguments of `cleancolor audit`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/command_line.hpp"
#include "cli/machine_arguments.hpp"

namespace cleancolor {

/// As CLI11 collects them.
struct AuditTexts {
  AuditCommand command;
  MachineTexts machine;
  std::vector<std::string> ooze;
  std::vector<std::string> limits;
  std::string scenario = "worst";
  std::string json;
  std::string layer;
  std::string places;
  bool sensitivity = false;
  bool no_scene = false;
};

/// What `cleancolor audit --help` says first.
extern const char* const audit_description;

/// Adds the command to the program; it fills the texts, which must outlive it.
CLI::App* add_audit(CLI::App& program, AuditTexts& texts);

/// Throws Error for what is not understood.
AuditCommand audit_command(AuditTexts texts);

}  // namespace cleancolor
