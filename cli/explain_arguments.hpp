// cli/explain_arguments.hpp
//
// The arguments of `cleancolor explain`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cli/command_line.hpp"
#include "cli/machine_arguments.hpp"

namespace cleancolor {

/// As CLI11 collects them.
struct ExplainTexts {
  ExplainCommand command;
  MachineTexts machine;
  std::string layer;
  std::string json;
};

/// What `cleancolor explain --help` says first.
extern const char* const explain_description;

/// Adds the command to the program; it fills the texts, which must outlive it.
CLI::App* add_explain(CLI::App& program, ExplainTexts& texts);

/// Throws Error for what is not understood.
ExplainCommand explain_command(ExplainTexts texts);

}  // namespace cleancolor
