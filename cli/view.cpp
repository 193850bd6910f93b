#include "cli/view.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <ostream>
#include <thread>

#include "base/error.hpp"
#include "cli/console.hpp"
#include "cli/interrupt.hpp"
#include "cli/machine_arguments.hpp"
#include "viewer/server.hpp"

namespace cleancolor {
namespace {

bool has_display() {
  const auto is_set = [](const char* name) {
    const char* value = std::getenv(name);
    return value && *value;
  };
  return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
}

/// Opens the page by way of a file that only this user can read: arguments of programs can be read by all, and the
/// address holds the token.
void open_browser(const std::string& url, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "open.html";
  std::ofstream(file) << fmt::format(
      "<!doctype html><meta http-equiv=\"refresh\" content=\"0; url={0}\"><a href=\"{0}\">"
      "cleancolor</a>\n",
      url);
  std::string program = "xdg-open", argument = file.string();
  std::array<char*, 3> words = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  posix_spawnp(&child, program.c_str(), nullptr, nullptr, words.data(), environ);  // the address is printed anyway
}

}  // namespace

void run(const ViewCommand& command, std::ostream& out, std::ostream& err) {
  Console console(err, {.terminal = false, .quiet = true});
  Api api({.machine = machine_request(command, console.progress()),
           .printer = command.printer,
           .threads = command.threads});
  for (const std::filesystem::path& file : command.prints) api.add_print(file);
  for (const std::filesystem::path& file : command.meshes) api.add_mesh(file);
  const Server server(api, {.address = command.address, .port = command.port, .refused = [&](const std::string& line) {
                              err << "cleancolor: " << line << std::endl;
                            }});
  out << server.page_url() << std::endl;
  if (command.browser && has_display()) open_browser(server.page_url(), api.temporary());
  while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

}  // namespace cleancolor
