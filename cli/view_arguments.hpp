// cli/view_arguments.hpp
//
// The arguments of `cleancolor view`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/command_line.hpp"
#include "cli/machine_arguments.hpp"

namespace cleancolor {

/// As CLI11 collects them.
struct ViewTexts {
  ViewCommand command;
  MachineTexts machine;
  std::vector<std::filesystem::path> files;
  std::string port;
  bool no_browser = false;
};

/// What `cleancolor view --help` says first.
extern const char* const view_description;

/// Adds the command to the program; it fills the texts, which must outlive it.
CLI::App* add_view(CLI::App& program, ViewTexts& texts);

/// Throws Error for what is not understood.
ViewCommand view_command(ViewTexts texts);

}  // namespace cleancolor
