#include "cli/slice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ostream>
#include <set>

#include "base/error.hpp"
#include "cli/console.hpp"
#include "cli/report.hpp"
#include "cli/separate_files.hpp"
#include "model/options.hpp"
#include "model/profile.hpp"

namespace cleancolor {
namespace {

std::string printers_to_print_with(bool several_extruders) {
  std::vector<std::string> names;
  for (const BuiltInProfile& p : builtin_profiles()) {
    if (p.group != OptionGroup::printer) continue;
    const Config config = with_profile(Config{}, find_profile(p.group, std::string(p.name)));
    if (!config.audit_only && (config.extruders.size() > 1) >= several_extruders) names.emplace_back(p.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// What people know from other slicers and try here: the beginning of the option's name, and what it is about.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> missing_features = {{
    {"support_material", "supports are"},
    {"raft_", "a raft is"},
    {"ironing", "ironing is"},
    {"spiral_vase", "the spiral vase is"},
    {"complete_objects", "printing one object after the other is"},
    {"brim_ears", "a brim of ears only is"},
    {"arc_fitting", "arcs are"},
}};

/// "there is no option" would leave people to look for another name.
void require_known_features(const std::vector<std::string>& assignments) {
  for (const std::string& assignment : assignments)
    for (const auto& [name, feature] : missing_features)
      if (assignment.starts_with(name) && !find_option(assignment.substr(0, assignment.find('='))))
        throw Error(fmt::format("--set {}: {} not there yet; leave the option out", assignment, feature));
}

// As far as the command line alone tells: files may hold more colours.
std::size_t needed_extruders(const SliceCommand& command) {
  std::set<int> named;
  for (const ModelFile& file : command.files) {
    if (file.extruder) named.insert(*file.extruder);
  }
  for (const auto& [rgb, extruder] : command.extruder_of_rgb) named.insert(extruder);
  const auto unnamed = std::ranges::count_if(command.files, [](const ModelFile& f) { return !f.extruder; });
  int highest = named.empty() ? -1 : *named.rbegin();
  int next = 0;
  for (auto i = unnamed; i > 0; --i) {
    while (named.contains(next)) ++next;
    highest = std::max(highest, next++);
  }
  return static_cast<std::size_t>(highest + 1);
}

/// Meshes, the loaded configuration, and profiles that are files.
std::vector<std::filesystem::path> inputs(const SliceCommand& command) {
  std::vector<std::filesystem::path> paths;
  for (const ModelFile& file : command.files) paths.push_back(file.path);
  if (!command.settings.load.empty()) paths.push_back(command.settings.load);
  std::vector<std::string> profiles = command.settings.materials;
  profiles.insert(profiles.end(), {command.settings.printer, command.settings.print});
  for (const std::string& profile : profiles)
    if (profile.ends_with(".toml")) paths.emplace_back(profile);
  return paths;
}

}  // namespace

SliceRequest slice_request(const SliceCommand& command, const Progress& progress) {
  SliceRequest request;
  require_known_features(command.settings.set);
  request.config = config_of(command.settings, progress);
  const std::size_t needed = needed_extruders(command);
  const bool is_chosen = !command.settings.printer.empty() || !command.settings.load.empty();
  if (!is_chosen && needed > request.config.extruders.size()) {
    throw Error(
        fmt::format("{} extruders are needed; where their nozzles are depends on the printer: choose one with "
                    "--printer, such as {}, or a .toml file of your own",
                    needed, printers_to_print_with(true)));
  }
  if (request.config.audit_only) {
    throw Error(fmt::format("--printer {}: the profile serves only to audit and re-plan G-code; print with {}",
                            command.settings.printer, printers_to_print_with(false)));
  }
  require_separate_files(inputs(command), {{"output", command.output}, {"--preview", command.preview}});
  request.files = command.files;
  request.extruder_of_rgb = command.extruder_of_rgb;
  request.placement = command.placement;
  request.azimuth_deg = command.azimuth_deg;
  request.overlap = command.overlap;
  request.output = command.output;
  request.preview = command.preview;
  request.threads = command.threads;
  return request;
}

void run(const SliceCommand& command, std::ostream& out, std::ostream& err, bool err_is_terminal) {
  Console console(err, {.terminal = err_is_terminal, .quiet = command.quiet});
  const Progress progress = console.progress();
  const SliceRequest request = slice_request(command, progress);
  const Summary summary = slice(request, progress);
  console.clear();
  if (command.json) {
    out << summary_json(summary, request, console.warnings());
  } else if (!command.quiet) {
    out << summary_table(summary, request);
  }
}

}  // namespace cleancolor
