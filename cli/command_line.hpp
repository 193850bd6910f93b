// cli/command_line.hpp
//
// The command line -> what is asked for, as plain values. Nothing is read, printed or done here.
#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "model/settings.hpp"
#include "pipeline.hpp"

namespace cleancolor {

// Exit codes; --help tells them.
inline constexpr int exit_done = 0;
inline constexpr int exit_wrong_input = 2;
inline constexpr int exit_system = 3;
inline constexpr int exit_interrupted = 130;

/// cleancolor slice
struct SliceCommand {
  Settings settings;
  std::vector<ModelFile> files;                  // at least one
  std::map<std::uint32_t, int> extruder_of_rgb;  // 0xRRGGBB -> 0-based
  Placement placement;
  Overlap overlap = Overlap::refuse;
  std::filesystem::path output;   // never empty
  std::filesystem::path preview;  // empty: none
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

/// cleancolor profiles [show NAME]
struct ProfilesCommand {
  std::string show;  // name or file; empty: list all
};

/// cleancolor options [--markdown] [WORD]
struct OptionsCommand {
  std::string word;  // only options with it in section, name or help, capitals or not
  bool markdown = false;
};

/// --help and --version: text for standard output.
struct TextCommand {
  std::string text;
};

using Command = std::variant<SliceCommand, ProfilesCommand, OptionsCommand, TextCommand>;

/// arguments: without the program's name. Throws Error for anything that is not understood.
Command parse_command_line(std::vector<std::string> arguments);

}  // namespace cleancolor
