#include "cli/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/error.hpp"
#include "cli/audit_arguments.hpp"
#include "cli/explain_arguments.hpp"
#include "cli/replan_arguments.hpp"
#include "cli/slice_arguments.hpp"
#include "cli/view_arguments.hpp"
#include "cli/words.hpp"

namespace cleancolor {
namespace {

constexpr const char* description =
    "Slices coloured meshes for printers with several nozzles, and judges how clean G-code prints.\n"
    "\n"
    "  cleancolor slice ocean.stl land.stl -o globe.gcode --printer replicator-dual\n"
    "  cleancolor slice robot.3mf --printer my-printer.toml --set layer_height=0.2\n"
    "  cleancolor slice a.stl b.stl -o ab.gcode --load my-prusaslicer.ini\n"
    "  cleancolor azimuth ocean.stl land.stl --printer replicator-dual -o azimuth.svg\n"
    "  cleancolor audit print.gcode --printer replicator-dual\n"
    "  cleancolor explain globe.gcode --layer 60 -o layer.svg\n"
    "  cleancolor replan prusa.gcode -o clean.gcode\n"
    "  cleancolor view globe.gcode\n"
    "  cleancolor profiles\n"
    "  cleancolor options infill\n";

constexpr int max_threads = 1024;

// CLI11 would only say that a command is missing.
void require_command(const CLI::App& app, const std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments.front().starts_with('-')) return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  if (std::ranges::find(names, arguments.front()) != names.end()) return;
  throw Error(fmt::format("there is no command '{}'; known are {}; see cleancolor --help", arguments.front(),
                          fmt::join(names, ", ")));
}

}  // namespace

void require_threads(int threads) {
  if (threads < 0 || threads > max_threads)
    throw Error(fmt::format("--threads: {} is not between 0 and {}", threads, max_threads));
}

Command parse_command_line(std::vector<std::string> arguments) {
  CLI::App app(description, "cleancolor");
  app.set_version_flag("--version", "cleancolor " CLEANCOLOR_VERSION);
  app.footer(exit_codes);
  app.require_subcommand(1);

  SliceTexts slice_texts;
  CLI::App* slice = add_slice(app, slice_texts);
  SliceTexts azimuth_texts;
  CLI::App* azimuth = add_azimuth(app, azimuth_texts);
  AuditTexts audit_texts;
  CLI::App* audit = add_audit(app, audit_texts);
  ExplainTexts explain_texts;
  CLI::App* explain = add_explain(app, explain_texts);
  ReplanTexts replan_texts;
  CLI::App* replan = add_replan(app, replan_texts);
  ViewTexts view_texts;
  CLI::App* view = add_view(app, view_texts);

  ProfilesCommand profiles;
  CLI::App* list = app.add_subcommand("profiles", "list printers, materials and print settings");
  CLI::App* show = list->add_subcommand("show", "print one profile with every default, as TOML to start your own from");
  show->add_option("name", profiles.show, "name or .toml file")->required()->type_name("NAME|FILE.toml");

  OptionsCommand reference;
  CLI::App* options = app.add_subcommand("options", "list all options for --set and profiles");
  options->add_option("word", reference.word, "only those with this word")->type_name("WORD");
  options->add_flag("--markdown", reference.markdown, "as in docs/options.md");

  require_command(app, arguments);
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the end
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::CallForVersion& call) {
    return TextCommand{std::string(call.what()) + "\n"};
  } catch (const CLI::CallForHelp&) {
    const CLI::App* asked = &app;
    for (const CLI::App* sub : {slice, azimuth, audit, explain, replan, view, list, show, options})
      asked = sub->parsed() ? sub : asked;
    if (asked == slice) slice->description(slice_description);
    if (asked == azimuth) azimuth->description(azimuth_description);
    if (asked == audit) audit->description(audit_description);
    if (asked == explain) explain->description(explain_description);
    if (asked == replan) replan->description(replan_description);
    if (asked == view) view->description(view_description);
    return TextCommand{asked->help(asked == &app ? "" : asked == show ? "cleancolor profiles" : "cleancolor")};
  } catch (const CLI::ParseError& fault) {
    throw Error(fmt::format("{}; see cleancolor {}--help", fault.what(),
                            slice->parsed()     ? "slice "
                            : azimuth->parsed() ? "azimuth "
                            : audit->parsed()   ? "audit "
                            : explain->parsed() ? "explain "
                            : replan->parsed()  ? "replan "
                            : view->parsed()    ? "view "
                                                : ""));
  }
  if (slice->parsed()) return slice_command(*slice, std::move(slice_texts));
  if (azimuth->parsed()) return azimuth_command(*azimuth, std::move(azimuth_texts));
  if (audit->parsed()) return audit_command(std::move(audit_texts));
  if (explain->parsed()) return explain_command(std::move(explain_texts));
  if (replan->parsed()) return replan_command(std::move(replan_texts));
  if (view->parsed()) return view_command(std::move(view_texts));
  if (list->parsed()) return profiles;
  return reference;
}

}  // namespace cleancolor
