// cli/slice_arguments.hpp
//
// The arguments of `cleancolor slice` and `cleancolor azimuth`.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line.hpp"

namespace cleancolor {

/// As CLI11 collects them.
struct SliceTexts {
  SliceCommand command;
  std::vector<std::string> files;
  std::vector<std::string> extruders;
  std::vector<std::string> colours;
  std::string center;
  std::optional<std::string> azimuth;
  std::string rampart;
  std::string protect;
  std::string planner;
  std::string effort;
  std::string overlap = "refuse";
  bool keep = false;
  CLI::Option* file_option = nullptr;
  CLI::Option* extruder_option = nullptr;
};

/// What `cleancolor slice --help` says first.
extern const char* const slice_description;

/// Adds the command to the program; it fills the texts, which must outlive it.
CLI::App* add_slice(CLI::App& program, SliceTexts& texts);

/// Throws Error for what is not understood.
SliceCommand slice_command(const CLI::App& app, SliceTexts texts);

// `cleancolor azimuth` takes the same parts and printers.
extern const char* const azimuth_description;
CLI::App* add_azimuth(CLI::App& program, SliceTexts& texts);
AzimuthCommand azimuth_command(const CLI::App& app, SliceTexts texts);

}  // namespace cleancolor
