#include "cli/replan_arguments.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "cli/words.hpp"

namespace cleancolor {

const char* const replan_description =
    "Gives G-code of another slicer the order, travel and rampart of this program; its paths and settings stay.\n"
    "\n"
    "Every path is printed as it was sliced: its plastic, speed, fan and acceleration. New are the order of the "
    "paths,\n"
    "where loops begin, the ways between them, and the rampart around the part, where it is worth its\n"
    "time. So far for files of PrusaSlicer, SuperSlicer, Slic3r, OrcaSlicer, Bambu Studio and Cura with\n"
    "several nozzles.\n"
    "What cannot be re-planned for sure is refused, with the reason; the result is read again and compared with\n"
    "the file before it is written.\n"
    "\n"
    "Where the nozzles are: --nozzle-offset, else --printer, else the file, else a guess that is warned of.\n";

namespace {

constexpr const char* replan_examples =
    "Examples:\n"
    "  cleancolor replan globe.gcode -o clean.gcode\n"
    "  cleancolor replan globe.gcode --dry-run\n"
    "  cleancolor replan globe.gcode -o clean.gcode --printer replicator-dual\n"
    "As a post-processing script of the slicer:\n"
    "  cleancolor replan --post-process\n"
    "\n";

bool is_kept(const std::string& word, std::string_view option) {
  if (word != "plan" && word != "keep") throw Error(fmt::format("{}: '{}' is neither plan nor keep", option, word));
  return word == "keep";
}

ReplanProtection protection_of(const std::string& word) {
  if (word == "none") return ReplanProtection::none;
  if (word == "rampart") return ReplanProtection::rampart;
  if (word == "full") return ReplanProtection::full;
  throw Error(fmt::format("--protect: '{}' is neither none, rampart nor full", word));
}

}  // namespace

CLI::App* add_replan(CLI::App& program, ReplanTexts& texts) {
  CLI::App* replan = program.add_subcommand("replan", "keep colours clean in G-code of another slicer");
  replan->footer(std::string(replan_examples) + exit_codes);
  ReplanCommand& command = texts.command;
  replan->add_option("file", command.file, "G-code file")->type_name("FILE");
  add_machine(*replan, texts.machine);
  const char* group = "What is planned";
  replan->add_option("--protect", texts.protect, "none: as slicers do; rampart: with the rampart; full: planned, too")
      ->type_name("none|rampart|full")
      ->group(group);
  replan->add_option("--order", texts.order, "order of the paths; keep goes with --travel keep")
      ->type_name("plan|keep")
      ->group(group);
  replan->add_option("--travel", texts.travel, "ways between the paths")->type_name("plan|keep")->group(group);
  replan
      ->add_option("--seams", texts.seams,
                   "where loops begin; keep: as in the file, for seams that are painted or aligned on purpose")
      ->type_name("plan|keep")
      ->group(group);
  replan
      ->add_flag("--remove-shield", command.removes_shield,
                 "take away a skirt as high as the print; the rampart takes its place")
      ->group(group);
  replan->add_flag("--remove-tower", command.removes_tower, "take away the wipe tower; the rampart takes its place")
      ->group(group);
  group = "Output";
  replan->add_option("-o,--output", command.output, "file to write")->type_name("FILE.gcode")->group(group);
  replan->add_flag("--post-process", command.post_process, "edit the file in place, as slicers ask of their scripts")
      ->group(group);
  replan->add_flag("--dry-run", command.dry_run, "write nothing; print the audit's figures before and after")
      ->group(group);
  replan
      ->add_flag("--keep-going", command.keep_going,
                 "hand on a file that cannot be re-planned as it is, with the reason, and exit code 0")
      ->group(group);
  replan->add_flag("--quiet", command.quiet, "print neither progress nor what was done; warnings still")->group(group);
  replan->add_option("--threads", command.threads, "number of threads; 0: as many as the machine has")
      ->type_name("N")
      ->group(group);
  return replan;
}

ReplanCommand replan_command(ReplanTexts texts) {
  ReplanCommand command = std::move(texts.command);
  if (command.file.empty()) throw Error("replan: name a G-code file; see cleancolor replan --help");
  static_cast<MachineOptions&>(command) = machine_options(texts.machine);
  const bool keeps_order = is_kept(texts.order, "--order"), keeps_travel = is_kept(texts.travel, "--travel");
  if (keeps_order != keeps_travel) throw Error("--order keep and --travel keep go together: say both");
  command.keeps_order = keeps_order;
  command.keeps_seams = is_kept(texts.seams, "--seams");
  if (keeps_order && (command.removes_shield || command.removes_tower))
    throw Error("--remove-shield and --remove-tower leave no order to keep: leave out --order keep --travel keep");
  command.protection = protection_of(texts.protect);
  const int ways_out = int(!command.output.empty()) + int(command.post_process) + int(command.dry_run);
  if (ways_out != 1)
    throw Error("replan: say one of -o FILE, --post-process (the file itself) and --dry-run (nothing)");
  require_threads(command.threads);
  return command;
}

}  // namespace cleancolor
