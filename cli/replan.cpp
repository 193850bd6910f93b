#include "cli/replan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <ostream>

#include "audit/audit.hpp"
#include "audit/machine_texts.hpp"
#include "audit/report.hpp"
#include "base/error.hpp"
#include "base/output_file.hpp"
#include "base/parallel.hpp"
#include "cli/console.hpp"
#include "cli/interrupt.hpp"
#include "cli/machine_arguments.hpp"
#include "cli/separate_files.hpp"
#include "reader/read.hpp"
#include "replan/replan.hpp"

namespace cleancolor {
namespace {

/// Slicers tell their scripts all options as SLIC3R_...; they serve where neither the user nor the file says it.
void take_environment(MachineRequest& request, const GcodePrint& print) {
  const char* offsets = std::getenv("SLIC3R_EXTRUDER_OFFSET");
  const bool told = !request.nozzle_offset_mm.empty() || request.printer || !print.facts.nozzle_offset_mm.empty();
  if (offsets == nullptr || *offsets == 0 || told) return;
  const std::vector<Vec2> told_mm = nozzle_offsets_of(offsets, "SLIC3R_EXTRUDER_OFFSET");
  // Zeroes say only that the firmware makes up for them.
  if (std::ranges::all_of(told_mm, [&](Vec2 p) { return p == told_mm.front(); })) return;
  request.nozzle_offset_mm = told_mm;
  if (!request.offsets_in) request.offsets_in = OffsetsIn::slicer;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw SystemError(fmt::format("{}: cannot be read", file.string()));
  return bytes;
}

/// The audit's figures of both, side by side.
std::string comparison(const GcodePrint& before, const GcodePrint& after, const AuditMachine& machine, int threads,
                       const Progress& progress) {
  AuditOptions options;
  options.threads = threads;
  const AuditResult old_result = audit(before, machine, options, progress);
  const AuditResult new_result = audit(after, machine, options, progress);
  const std::vector<AuditedFile> files = {{"before", &before, &machine, &old_result, &options.scenarios, {}},
                                          {"after", &after, &machine, &new_result, &options.scenarios, {}}};
  return comparison_text(files);
}

/// One line: what it brings, and what it takes.
std::string summary(const std::string& target, const Replanned& result) {
  std::string line = target + ": ";
  if (result.gain) {
    const auto& [before, after] = *result.gain;
    line += fmt::format("smears {:.1f} instead of {:.1f} mm3, holes {:.1f} instead of {:.1f} mm3, ", after.smear_mm3,
                        before.smear_mm3, after.hole_mm3, before.hole_mm3);
  }
  line += fmt::format("filament {:.2f} instead of {:.2f} m, ", result.filament_mm / 1e3, result.old_filament_mm / 1e3);
  const int digits = result.old_time_s < 6000 ? 1 : 0;
  return line + fmt::format("{:.{}f} min instead of {:.{}f} min, by this program's estimate\n", result.time_s / 60,
                            digits, result.old_time_s / 60, digits);
}

void replan(const ReplanCommand& command, Console& console, std::ostream& out) {
  const Progress progress = console.progress();
  MachineRequest request = machine_request(command, progress);
  const GcodePrint print = read_gcode_file(command.file, progress);
  if (command.post_process) take_environment(request, print);
  const AuditMachine machine = audit_machine(print, request, progress);
  const int threads = thread_count(command.threads);
  const Replanned result = replanned(print, machine,
                                     {.printer = request.printer,
                                      .protection = command.protection,
                                      .keeps_order = command.keeps_order,
                                      .keeps_seams = command.keeps_seams,
                                      .removes_shield = command.removes_shield,
                                      .removes_tower = command.removes_tower,
                                      .threads = threads},
                                     progress);
  if (!result.changed) progress.warn(fmt::format("{}: {}; it stays as it is", print.name, result.reason));
  if (command.dry_run) {
    const GcodePrint after = read_gcode(result.text, print.name);
    const std::string table = comparison(print, after, machine, threads, progress);
    console.clear();
    out << table;
    return;
  }
  const auto& target = command.post_process ? command.file : command.output;
  if (result.changed || !command.post_process) write_file(target, result.text);
  console.clear();
  if (!command.quiet && result.changed) out << summary(target.string(), result);
  if (!command.quiet && result.removed_mm3 > 0)
    out << fmt::format("{}: {:.0f} mm3 of plastic are removed\n", target.string(), result.removed_mm3);
}

}  // namespace

void run(const ReplanCommand& command, std::ostream& out, std::ostream& err, bool err_is_terminal) {
  std::vector<std::filesystem::path> inputs{command.file};
  if (command.printer.ends_with(".toml")) inputs.emplace_back(command.printer);
  require_separate_files(inputs, {{"output", command.output}});
  // Slicers show what a script that fails has said: of ours the reason alone.
  const bool quiet = command.quiet || (command.post_process && !err_is_terminal);
  Console console(err, {.terminal = err_is_terminal, .quiet = quiet});
  try {
    replan(command, console, out);
  } catch (const SystemError&) {
    throw;
  } catch (const Error& fault) {
    if (!command.keep_going || interrupted() || !std::filesystem::is_regular_file(command.file)) throw;
    console.clear();
    if (!command.output.empty()) write_file(command.output, bytes_of(command.file));
    err << "cleancolor: " << fault.what() << "; the file stays as it is" << std::endl;
  }
  out.flush();
}

}  // namespace cleancolor
