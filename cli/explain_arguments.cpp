#include "cli/explain_arguments.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "cli/words.hpp"

namespace cleancolor {

const char* const explain_description =
    "Draws how one layer of a print was planned, from its G-code alone.\n"
    "\n"
    "The picture has three views: the paths with their order and direction, and the travel between them; the roadmap "
    "of\n"
    "ways that the carriage can take, as the planner makes it; and where every nozzle is while it does not print. The\n"
    "table has a row for each path. How layers are planned: docs/planner.md. Any slicer's file will do.\n"
    "\n"
    "Where the nozzles are: --nozzle-offset, else --printer, else the file, else a guess that is warned of.\n";

namespace {

constexpr const char* explain_examples =
    "Examples:\n"
    "  cleancolor explain globe.gcode --layer 60 -o layer.svg\n"
    "  cleancolor explain globe.gcode --layer 60 -o layer.png --nozzle-offset 0x0,33x0 --offsets-in slicer\n"
    "  cleancolor explain globe.gcode --layer 60 --printer replicator-dual --json -\n"
    "\n";

}  // namespace

CLI::App* add_explain(CLI::App& program, ExplainTexts& texts) {
  CLI::App* explain = program.add_subcommand("explain", "draw how one layer of G-code was planned");
  explain->footer(std::string(explain_examples) + exit_codes);
  ExplainCommand& command = texts.command;
  explain->add_option("file", command.file, "G-code file")->type_name("FILE");
  explain->add_option("--layer", texts.layer, "layer to explain, from 1")->type_name("N");
  add_machine(*explain, texts.machine);
  const char* group = "Output";
  explain->add_option("-o,--output", command.output, "picture of the plan")
      ->type_name("FILE.svg|FILE.png")
      ->group(group);
  explain->add_option("--json", texts.json, "the table for programs; - prints it instead of the table")
      ->type_name("FILE.json|-")
      ->group(group);
  explain->add_flag("--quiet", command.quiet, "print neither progress nor table; warnings still")->group(group);
  explain->add_option("--threads", command.threads, "number of threads; 0: as many as the machine has")
      ->type_name("N")
      ->group(group);
  return explain;
}

ExplainCommand explain_command(ExplainTexts texts) {
  ExplainCommand command = std::move(texts.command);
  if (command.file.empty()) throw Error("explain: name a G-code file; see cleancolor explain --help");
  if (texts.layer.empty()) throw Error("explain: say which layer, from 1: --layer N");
  command.layer = layer_index(texts.layer);
  static_cast<MachineOptions&>(command) = machine_options(texts.machine);
  command.json_on_standard_output = texts.json == "-";
  if (!command.json_on_standard_output) command.json = texts.json;
  require_ending(command.json, "--json", ".json", "- prints it");
  if (command.output.extension() != ".png") require_ending(command.output, "-o", ".svg", "or in .png");
  require_threads(command.threads);
  return command;
}

}  // namespace cleancolor
