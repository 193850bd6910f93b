#include "cli/view_arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "cli/words.hpp"
#include "model/text_scan.hpp"

namespace cleancolor {

const char* const view_description =
    "Shows prints in the browser: every nozzle, its ooze, and where the audit expects smears and holes.\n"
    "\n"
    "G-code of any slicer is drawn, several files side by side. Meshes are put into a list, and can be sliced from "
    "the\n"
    "page. Only this machine can reach the page, and only with the address that is printed. Ctrl-C ends it.\n";

namespace {

constexpr const char* view_examples =
    "Examples:\n"
    "  cleancolor view globe.gcode\n"
    "  cleancolor view ours.gcode prusa.gcode --nozzle-offset 0x0,33x0 --offsets-in slicer\n"
    "  cleancolor view ocean.stl land.stl --printer replicator-dual\n"
    "  cleancolor view --listen 0.0.0.0 --port 8000 --no-browser\n"
    "\n"
    "What the page asks for, scripts can ask, too: docs/viewer-api.md.\n"
    "\n";

constexpr std::array<std::string_view, 4> gcode_endings = {".gcode", ".gco", ".g", ".nc"};
constexpr std::array<std::string_view, 5> mesh_endings = {".stl", ".obj", ".ply", ".amf", ".3mf"};

bool has_ending(const std::filesystem::path& file, std::span<const std::string_view> endings) {
  const std::string own = file.extension().string();
  return std::ranges::any_of(endings, [&](std::string_view ending) { return is_keyword(own, ending); });
}

}  // namespace

CLI::App* add_view(CLI::App& program, ViewTexts& texts) {
  CLI::App* view = program.add_subcommand("view", "show prints in the browser, and slice from there");
  view->footer(std::string(view_examples) + exit_codes);
  ViewCommand& command = texts.command;
  view->add_option("files", texts.files, "G-code files and meshes")->type_name("FILE");
  add_machine(*view, texts.machine);
  const char* group = "The page";
  view->add_option("--port", texts.port, "port; 0: any. Default: 8737, or any where that is taken")
      ->type_name("N")
      ->group(group);
  view->add_option("--listen", command.address,
                   "address to listen at; others than 127.0.0.1 can be reached by whoever has the token, and the way "
                   "is not encrypted")
      ->type_name("ADDRESS")
      ->group(group);
  view->add_flag("--no-browser", texts.no_browser, "only print the address")->group(group);
  view->add_option("--threads", command.threads, "number of threads; 0: as many as the machine has")
      ->type_name("N")
      ->group(group);
  return view;
}

ViewCommand view_command(ViewTexts texts) {
  ViewCommand command = std::move(texts.command);
  for (const std::filesystem::path& file : texts.files) {
    const bool gcode = has_ending(file, gcode_endings);
    if (!gcode && !has_ending(file, mesh_endings))
      throw Error(fmt::format("{}: neither G-code nor a mesh by its ending; known are {}, {}", file.string(),
                              fmt::join(gcode_endings, " "), fmt::join(mesh_endings, " ")));
    if (!std::filesystem::is_regular_file(file)) throw Error(fmt::format("{}: there is no such file", file.string()));
    (gcode ? command.prints : command.meshes).push_back(file);
  }
  static_cast<MachineOptions&>(command) = machine_options(texts.machine);
  int port = 0;
  if (!texts.port.empty()) {
    if (!parse_whole(std::string_view(texts.port), port) || port < 0 || port > 65535)
      throw Error(fmt::format("--port: '{}' is not a port, 0 to 65535", texts.port));
    command.port = port;
  }
  command.browser = !texts.no_browser;
  require_threads(command.threads);
  return command;
}

}  // namespace cleancolor
