#include "cli/audit.hpp"

#include <fmt/format.h>

#include <memory>
#include <ostream>

#include "audit/pictures.hpp"
#include "audit/report.hpp"
#include "audit/report_words.hpp"
#include "base/error.hpp"
#include "base/output_file.hpp"
#include "cli/console.hpp"
#include "cli/machine_arguments.hpp"
#include "cli/separate_files.hpp"
#include "reader/read.hpp"
#include "viewer/report_scene.hpp"

namespace cleancolor {
namespace {

/// One file, and what AuditedFile points to.
struct Judged {
  std::string name;
  GcodePrint print;
  AuditMachine machine;
  AuditResult result;
  std::vector<std::string> warnings;
};

std::unique_ptr<Judged> judged(const AuditCommand& command, const std::filesystem::path& file,
                               const MachineRequest& request, const Progress& progress) {
  auto one = std::make_unique<Judged>();
  one->name = file.string();
  Progress own = progress;
  own.warn = [&](const std::string& message) {
    one->warnings.push_back(message);
    progress.warn(message);
  };
  one->print = read_gcode_file(file, own);
  if (command.layer) require_layer(one->print, *command.layer);
  one->machine = audit_machine(one->print, request, own);
  one->print.text.reset();  // the moves tell all that follows
  AuditOptions options;
  options.scenarios = command.scenarios;
  options.threads = command.threads;
  one->result = audit(one->print, one->machine, options, own);
  return one;
}

void draw_layer(const AuditCommand& command, const Judged& one) {
  if (command.svg.empty() && command.png.empty()) return;
  const auto worst = worst_layers(one.result.scenarios[command.scenario], 1);
  const std::uint32_t layer = command.layer.value_or(worst.empty() ? 0 : worst.front());
  const Canvas picture = layer_picture(one.print, one.machine, one.result, command.scenario, layer);
  if (!command.svg.empty()) write_file(command.svg, picture.svg());
  if (!command.png.empty()) write_file(command.png, picture.png());
}

std::string tables(const AuditCommand& command, std::span<const AuditedFile> files, const ReportOptions& options) {
  if (command.compare) return comparison_text(files);
  std::string text;
  for (const AuditedFile& file : files) text += (text.empty() ? "" : "\n\n") + audit_text(file, options);
  return text;
}

/// Returns whether all hold.
bool limits_hold(const AuditCommand& command, std::span<const AuditedFile> files, std::ostream& err) {
  bool hold = true;
  for (const AuditedFile& file : files)
    for (const FigureLimit& limit : command.limits) {
      const ScenarioResult& scenario = file.result->scenarios[limit.scenario];
      const double value = limit.figure->of(scenario.total);
      if (value <= limit.most) continue;
      const std::string unit = limit.figure->unit == "1" ? "" : fmt::format(" {}", limit.figure->unit);
      err << fmt::format("cleancolor: {}: {}.{} is {:.6g}{}, more than the {:g}{} allowed\n", file.name, scenario.name,
                         limit.figure->name, value, unit, limit.most, unit);
      hold = false;
    }
  return hold;
}

void require_inputs_kept(const AuditCommand& command) {
  std::vector<std::filesystem::path> inputs = command.files;
  if (command.printer.ends_with(".toml")) inputs.emplace_back(command.printer);
  require_separate_files(
      inputs, {{"output", command.html}, {"--json", command.json}, {"--svg", command.svg}, {"--png", command.png}});
}

}  // namespace

int run(const AuditCommand& command, std::ostream& out, std::ostream& err, bool err_is_terminal) {
  require_inputs_kept(command);
  Console console(err, {.terminal = err_is_terminal, .quiet = command.quiet});
  const Progress progress = console.progress();
  const MachineRequest request = machine_request(command, progress);
  std::vector<std::unique_ptr<Judged>> all;
  std::vector<AuditedFile> files;
  for (const std::filesystem::path& file : command.files) {
    const Judged& one = *all.emplace_back(judged(command, file, request, progress));
    files.push_back({one.name, &one.print, &one.machine, &one.result, &command.scenarios, one.warnings});
  }
  const ReportOptions options{.scenario = command.scenario, .places = command.places};
  draw_layer(command, *all.front());
  if (!command.html.empty()) {
    progress.advance("pictures", 0);
    ReportScene scene;
    if (command.scene) scene = report_scene(files, request.printer ? &*request.printer : nullptr, command.threads);
    write_file(command.html, audit_html(files, options, scene));
  }
  console.clear();
  const std::string json =
      command.json_on_standard_output || !command.json.empty() ? audit_json(files, options) : std::string();
  if (!command.json.empty()) write_file(command.json, json);
  if (command.json_on_standard_output)
    out << json;
  else if (!command.quiet)
    out << tables(command, files, options);
  out.flush();
  return limits_hold(command, files, err) ? exit_done : exit_exceeded;
}

}  // namespace cleancolor
