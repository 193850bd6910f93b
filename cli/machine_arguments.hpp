// cli/machine_arguments.hpp
//
// The arguments that all commands share which read G-code: the printer that it is for, and a layer of it.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "audit/machine.hpp"
#include "cli/command_line.hpp"

namespace cleancolor {

/// As CLI11 collects them.
struct MachineTexts {
  std::string printer;
  std::string nozzle_offset;
  std::string offsets_in;
  std::string idle_nozzle;
};

/// Adds the options; they fill the texts, which must outlive the command.
void add_machine(CLI::App& app, MachineTexts& texts);

/// Throws Error for what is not understood.
MachineOptions machine_options(const MachineTexts& texts);

/// Reads the printer's profile.  Throws Error where there is none.
MachineRequest machine_request(const MachineOptions& options, const Progress& progress);

/// 0-based, of a number that counts from 1.  Throws Error where it is none.
std::uint32_t layer_index(const std::string& text);

/// Throws Error where the print does not have so many layers.
void require_layer(const GcodePrint& print, std::uint32_t layer);

}  // namespace cleancolor
