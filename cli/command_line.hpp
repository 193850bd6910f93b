// cli/command_line.hpp
//
// The command line -> what is asked for, as plain values. Nothing is read, printed or done here.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "audit/audit.hpp"
#include "model/settings.hpp"
#include "pipeline.hpp"
#include "replan/replan.hpp"

namespace cleancolor {

// Exit codes; --help tells them.
inline constexpr int exit_done = 0;
inline constexpr int exit_exceeded = 1;
inline constexpr int exit_wrong_input = 2;
inline constexpr int exit_system = 3;
inline constexpr int exit_interrupted = 130;

/// cleancolor slice
struct SliceCommand {
  Settings settings;
  std::vector<ModelFile> files;                  // at least one
  std::map<std::uint32_t, int> extruder_of_rgb;  // 0xRRGGBB -> 0-based
  Placement placement;
  std::optional<double> azimuth_deg;  // empty: auto
  Overlap overlap = Overlap::refuse;
  std::filesystem::path output;   // never empty
  std::filesystem::path preview;  // empty: none
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

/// cleancolor azimuth
struct AzimuthCommand {
  SliceCommand slice;  // what would be sliced; output: an SVG picture, or empty
  bool json = false;   // on standard output, instead of the table
};

/// --fail-over: a figure of a scenario must not be greater.
struct FigureLimit {
  std::size_t scenario = 0;
  const FigureInfo* figure = nullptr;  // never null
  double most = 0;
};

/// The printer that G-code is for.
struct MachineOptions {
  std::string printer;                 // name or file; empty: not said
  std::vector<Vec2> nozzle_offset_mm;  // empty: not said
  std::optional<OffsetsIn> offsets_in;
  std::optional<IdleNozzle> idle_nozzle;
};

/// cleancolor audit
struct AuditCommand : MachineOptions {
  std::vector<std::filesystem::path> files;  // at least one
  std::vector<Scenario> scenarios;           // what --sensitivity and --ooze make of them
  std::size_t scenario = 0;                  // the one that is shown first
  std::vector<FigureLimit> limits;
  bool compare = false;
  std::optional<std::uint32_t> layer;          // 0-based, to be drawn; empty: the worst one
  std::filesystem::path html, json, svg, png;  // empty: none
  bool scene = true;                           // in the HTML page
  bool json_on_standard_output = false;
  std::size_t places = 10;
  int threads = 0;
  bool quiet = false;
};

/// cleancolor explain
struct ExplainCommand : MachineOptions {
  std::filesystem::path file;
  std::uint32_t layer = 0;       // 0-based
  std::filesystem::path output;  // .svg or .png; empty: none
  std::filesystem::path json;    // empty: none
  bool json_on_standard_output = false;
  int threads = 0;
  bool quiet = false;
};

/// cleancolor replan
struct ReplanCommand : MachineOptions {
  std::filesystem::path file;
  std::filesystem::path output;  // empty: in place, or none
  bool post_process = false;     // in place
  bool dry_run = false;
  bool keep_going = false;
  ReplanProtection protection = ReplanProtection::full;
  bool keeps_order = false;  // and travel
  bool keeps_seams = false;
  bool removes_shield = false, removes_tower = false;
  int threads = 0;
  bool quiet = false;
};

/// cleancolor view
struct ViewCommand : MachineOptions {
  std::vector<std::filesystem::path> prints, meshes;
  std::string address = "127.0.0.1";
  std::optional<int> port;  // empty: the usual one, or any where that is taken; 0: any
  bool browser = true;
  int threads = 0;
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

using Command = std::variant<SliceCommand, AzimuthCommand, AuditCommand, ExplainCommand, ReplanCommand, ViewCommand,
                             ProfilesCommand, OptionsCommand, TextCommand>;

/// arguments: without the program's name. Throws Error for anything that is not understood.
Command parse_command_line(std::vector<std::string> arguments);

}  // namespace cleancolor
