#include "cli/explain.hpp"

#include <ostream>

#include "base/output_file.hpp"
#include "base/parallel.hpp"
#include "cli/console.hpp"
#include "cli/machine_arguments.hpp"
#include "cli/separate_files.hpp"
#include "explain/plan_picture.hpp"
#include "explain/plan_table.hpp"
#include "reader/read.hpp"

namespace cleancolor {
namespace {

void require_inputs_kept(const ExplainCommand& command) {
  std::vector<std::filesystem::path> inputs{command.file};
  if (command.printer.ends_with(".toml")) inputs.emplace_back(command.printer);
  require_separate_files(inputs, {{"output", command.output}, {"--json", command.json}});
}

}  // namespace

void run(const ExplainCommand& command, std::ostream& out, std::ostream& err, bool err_is_terminal) {
  require_inputs_kept(command);
  Console console(err, {.terminal = err_is_terminal, .quiet = command.quiet});
  const Progress progress = console.progress();
  const MachineRequest request = machine_request(command, progress);
  const GcodePrint print = read_gcode_file(command.file, progress);
  require_layer(print, command.layer);
  const AuditMachine machine = audit_machine(print, request, progress);
  const Explanation plan =
      explained(print, machine, command.layer, {.threads = thread_count(command.threads)}, progress);
  if (!command.output.empty()) {
    progress.advance("picture", 0);
    const Canvas picture = plan_picture(print, {plan, machine});
    write_file(command.output, command.output.extension() == ".png" ? picture.png() : picture.svg());
  }
  console.clear();
  if (!command.json.empty()) write_file(command.json, plan_json(plan, print));
  if (command.json_on_standard_output)
    out << plan_json(plan, print);
  else if (!command.quiet)
    out << plan_text(plan, print);
  out.flush();
}

}  // namespace cleancolor
