// cli/replan_arguments.hpp
//
// The arguments of `cleancolor replan`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cli/command_line.hpp"
#include "cli/machine_arguments.hpp"

namespace cleancolor {

/// As CLI11 collects them.
struct ReplanTexts {
  ReplanCommand command;
  MachineTexts machine;
  std::string order = "plan", travel = "plan", seams = "plan", protect = "full";
};

/// What `cleancolor replan --help` says first.
extern const char* const replan_description;

/// Adds the command to the program; it fills the texts, which must outlive it.
CLI::App* add_replan(CLI::App& program, ReplanTexts& texts);

/// Throws Error for what is not understood.
ReplanCommand replan_command(ReplanTexts texts);

}  // namespace cleancolor
