#include "cli/audit_arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "audit/ooze_keys.hpp"
#include "base/error.hpp"
#include "cli/words.hpp"

namespace cleancolor {

const char* const audit_description =
    "Predicts how clean a print in several colours comes out, from the G-code of any slicer.\n"
    "\n"
    "Every nozzle is followed through the whole print: what it leaves on other colours while it idles (smears), and "
    "what\n"
    "it lacks when it prints an outer wall again (holes). Scenario worst: idle nozzles always ooze; model: pressure,\n"
    "retraction and temperature count. What the figures mean: docs/audit.md.\n"
    "\n"
    "Where the nozzles are: --nozzle-offset, else --printer, else the file, else a guess that is warned of.\n";

namespace {

constexpr const char* audit_examples =
    "Examples:\n"
    "  cleancolor audit print.gcode --printer replicator-dual\n"
    "  cleancolor audit print.gcode --nozzle-offset 0x0,33x0 --offsets-in slicer -o report.html --json figures.json\n"
    "  cleancolor audit ours.gcode prusa.gcode cura.gcode --compare\n"
    "  cleancolor audit print.gcode --fail-over smear_volume=5 --fail-over model.hole_volume=1\n"
    "  cleancolor audit print.gcode --layer 37 --svg layer.svg\n"
    "  cleancolor audit print.gcode --ooze volume=2,3.5 --ooze model.elastic_time=0.4\n"
    "\n";

constexpr double largest_number = 1e6;
constexpr std::uint32_t most_places = 100000;

std::string footer() {
  std::string text = audit_examples;
  text += "Figures for --fail-over:\n";
  for (const FigureInfo& f : figure_table())
    text += fmt::format("  {:<31}{:<5}{}\n", f.name, f.unit == "1" ? "" : f.unit, f.help);
  text += "\nKeys of --ooze, for worst; model.KEY for the scenario model:\n";
  for (const OozeKey& key : ooze_keys()) text += fmt::format("  {:<18}{:<13}{}\n", key.name, key.unit, key.help);
  return text + "\n" + exit_codes;
}

// allow_extra_args(false): an option that may come again takes one word at a time, or it would swallow the files.
void add_judging(CLI::App& app, AuditTexts& texts) {
  const char* group = "How to judge";
  app.add_option("--scenario", texts.scenario, "scenario that is shown first, and that --fail-over means")
      ->type_name("worst|model")
      ->group(group);
  app.add_option("--ooze", texts.ooze, "number of the ooze, one for all nozzles or one for each; repeatable; see below")
      ->type_name("[SCENARIO.]KEY=VALUE,...")
      ->group(group)
      ->allow_extra_args(false);
  app.add_flag("--sensitivity", texts.sensitivity, "also the figures under variants of worst")->group(group);
  app.add_option("--fail-over", texts.limits, "exit code 1 where the figure is greater; repeatable; see below")
      ->type_name("[SCENARIO.]FIGURE=VALUE")
      ->group(group)
      ->allow_extra_args(false);
}

void add_output(CLI::App& app, AuditTexts& texts) {
  const char* group = "Output";
  AuditCommand& command = texts.command;
  app.add_flag("--compare", command.compare, "the files side by side instead of one after the other")->group(group);
  app.add_option("-o,--output", command.html, "report with pictures, one page")->type_name("FILE.html")->group(group);
  app.add_flag("--no-scene", texts.no_scene, "report without the print to turn and look into: a smaller file")
      ->group(group);
  app.add_option("--json", texts.json, "all figures for programs; - prints them instead of the table")
      ->type_name("FILE.json|-")
      ->group(group);
  app.add_option("--layer", texts.layer, "layer to draw, from 1; default: the worst")->type_name("N")->group(group);
  app.add_option("--svg", command.svg, "picture of the layer")->type_name("FILE.svg")->group(group);
  app.add_option("--png", command.png, "picture of the layer")->type_name("FILE.png")->group(group);
  app.add_option("--places", texts.places, "so many of the worst places are listed; default: 10")
      ->type_name("N")
      ->group(group);
  app.add_flag("--quiet", command.quiet, "print neither progress nor tables; warnings still")->group(group);
  app.add_option("--threads", command.threads, "number of threads; 0: as many as the machine has")
      ->type_name("N")
      ->group(group);
}

/// "[SCENARIO.]NAME=VALUE"
struct Assignment {
  std::string_view scenario, name, value;
};
Assignment assignment(std::string_view option, std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos) throw Error(fmt::format("{}: '{}' has no '='; see cleancolor audit --help", option, text));
  Assignment a{.scenario = {}, .name = text.substr(0, equals), .value = text.substr(equals + 1)};
  if (const std::size_t point = a.name.find('.'); point != a.name.npos) {
    a.scenario = a.name.substr(0, point);
    a.name.remove_prefix(point + 1);
  }
  return a;
}

std::size_t scenario_index(const std::vector<Scenario>& scenarios, std::string_view name, std::string_view option) {
  const auto found = std::ranges::find(scenarios, name, &Scenario::name);
  if (found != scenarios.end()) return std::size_t(found - scenarios.begin());
  std::vector<std::string> names;
  for (const Scenario& s : scenarios) names.push_back(s.name);
  throw Error(fmt::format("{}: there is no scenario '{}'; there are {}{}", option, name, fmt::join(names, ", "),
                          scenarios.size() > 2 ? "" : ", and more with --sensitivity"));
}

const OozeKey& ooze_key(std::string_view name) {
  if (const OozeKey* key = find_ooze_key(name)) return *key;
  std::vector<std::string_view> names;
  for (const OozeKey& key : ooze_keys()) names.push_back(key.name);
  throw Error(fmt::format("--ooze: there is no key '{}'; known are {}", name, fmt::join(names, ", ")));
}

double ooze_value(const OozeKey& key, std::string_view text) {
  double value = 0;
  if (!parse_whole(text, value) || std::isnan(value))
    throw Error(fmt::format("--ooze {}: '{}' is not a number", key.name, text));
  const bool yes_or_no = key.unit.empty();
  const bool fits = std::isinf(value) ? value > 0 && key.may_be_infinite
                    : yes_or_no       ? value == 0 || value == 1
                                      : value >= 0 && value <= largest_number && (value > 0 || key.may_be_zero);
  if (!fits)
    throw Error(fmt::format("--ooze {}: {} is out of range; it is {}", key.name, text,
                            yes_or_no         ? "0 or 1"
                            : key.may_be_zero ? "0 or more"
                                              : "more than 0"));
  return value;
}

/// Values of one key, by nozzle; the last holds for those that follow.
void set_ooze(std::vector<OozeParameters>& nozzles, const OozeKey& key, const std::vector<double>& values) {
  while (nozzles.size() < values.size()) nozzles.push_back(nozzles.back());
  for (std::size_t i = 0; i < nozzles.size(); ++i) key.set(nozzles[i], values[std::min(i, values.size() - 1)]);
}

/// --ooze of worst is also that of its variants: they differ in rules alone.
void set_ooze(std::vector<Scenario>& scenarios, std::string_view text) {
  const Assignment a = assignment("--ooze", text);
  const std::string_view name = a.scenario.empty() ? "worst" : a.scenario;
  scenario_index(scenarios, name, "--ooze");
  const OozeKey& key = ooze_key(a.name);
  std::vector<double> values;
  for (const std::string_view value : split(a.value, ',')) values.push_back(ooze_value(key, value));
  if (values.size() > max_tools)
    throw Error(fmt::format("--ooze {}: {} values; at most {} nozzles are possible", a.name, values.size(), max_tools));
  for (Scenario& scenario : scenarios) {
    if (scenario.name != name && (name != "worst" || scenario.name == "model")) continue;
    set_ooze(scenario.ooze, key, values);
    scenario.help += fmt::format("; here with {}={}", a.name, a.value);
  }
}

FigureLimit limit_of(const AuditCommand& command, std::string_view text) {
  const Assignment a = assignment("--fail-over", text);
  FigureLimit limit{.scenario = command.scenario, .figure = find_figure(a.name), .most = 0};
  if (!a.scenario.empty()) limit.scenario = scenario_index(command.scenarios, a.scenario, "--fail-over");
  if (limit.figure == nullptr) {
    std::vector<std::string_view> names;
    for (const FigureInfo& f : figure_table()) names.push_back(f.name);
    throw Error(fmt::format("--fail-over: there is no figure '{}'; known are {}", a.name, fmt::join(names, ", ")));
  }
  if (!parse_whole(a.value, limit.most) || !std::isfinite(limit.most) || limit.most < 0)
    throw Error(fmt::format("--fail-over {}: '{}' is not a number of 0 or more", a.name, a.value));
  return limit;
}

void require_outputs(const AuditCommand& command, bool layer_is_said) {
  const bool draws = !command.svg.empty() || !command.png.empty();
  require_ending(command.svg, "--svg", ".svg", "a PNG is written by --png");
  require_ending(command.png, "--png", ".png", "an SVG is written by --svg");
  require_ending(command.html, "-o", ".html", "JSON is written by --json, pictures by --svg and --png");
  if (layer_is_said && !draws) throw Error("--layer: say where to draw it: --svg FILE.svg or --png FILE.png");
  if (!command.scene && command.html.empty())
    throw Error("--no-scene: it is about the report; write one by -o FILE.html");
  if (draws && command.files.size() > 1) throw Error("--svg and --png draw a layer of one file; name only one");
  if (command.compare && command.files.size() < 2) throw Error("--compare: name at least two files");
}

}  // namespace

CLI::App* add_audit(CLI::App& program, AuditTexts& texts) {
  CLI::App* audit = program.add_subcommand("audit", "predict smears and holes of G-code from any slicer");
  audit->footer(footer());
  audit->add_option("files", texts.command.files, "G-code files")->type_name("FILE");
  add_machine(*audit, texts.machine);
  add_judging(*audit, texts);
  add_output(*audit, texts);
  return audit;
}

AuditCommand audit_command(AuditTexts texts) {
  AuditCommand command = std::move(texts.command);
  if (command.files.empty()) throw Error("audit: name at least one G-code file; see cleancolor audit --help");
  static_cast<MachineOptions&>(command) = machine_options(texts.machine);
  command.scenarios = scenarios(texts.sensitivity);
  command.scenario = scenario_index(command.scenarios, texts.scenario, "--scenario");
  for (const std::string& text : texts.ooze) set_ooze(command.scenarios, text);
  for (const std::string& text : texts.limits) command.limits.push_back(limit_of(command, text));
  if (!texts.layer.empty()) command.layer = layer_index(texts.layer);
  if (!texts.places.empty() && (!parse_whole(texts.places, command.places) || command.places > most_places))
    throw Error(fmt::format("--places: '{}' is not a number up to {}", texts.places, most_places));
  command.scene = !texts.no_scene;
  command.json_on_standard_output = texts.json == "-";
  if (!command.json_on_standard_output) command.json = texts.json;
  require_ending(command.json, "--json", ".json", "- prints it");
  require_outputs(command, command.layer.has_value());
  require_threads(command.threads);
  return command;
}

}  // namespace cleancolor
