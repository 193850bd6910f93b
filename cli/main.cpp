// The program: the command line in, one call, one place where trouble ends.

#include <unistd.h>

#include <exception>
#include <iostream>

#include "base/error.hpp"
#include "cli/audit.hpp"
#include "cli/azimuth.hpp"
#include "cli/command_line.hpp"
#include "cli/explain.hpp"
#include "cli/interrupt.hpp"
#include "cli/profiles.hpp"
#include "cli/replan.hpp"
#include "cli/slice.hpp"
#include "cli/view.hpp"

namespace cleancolor {
namespace {

/// The exit code.
int run(const Command& command) {
  int code = exit_done;
  if (const auto* slice = std::get_if<SliceCommand>(&command)) {
    run(*slice, std::cout, std::cerr, isatty(STDERR_FILENO) != 0);
  } else if (const auto* azimuth = std::get_if<AzimuthCommand>(&command)) {
    run(*azimuth, std::cout, std::cerr, isatty(STDERR_FILENO) != 0);
  } else if (const auto* audit = std::get_if<AuditCommand>(&command)) {
    code = run(*audit, std::cout, std::cerr, isatty(STDERR_FILENO) != 0);
  } else if (const auto* explain = std::get_if<ExplainCommand>(&command)) {
    run(*explain, std::cout, std::cerr, isatty(STDERR_FILENO) != 0);
  } else if (const auto* replan = std::get_if<ReplanCommand>(&command)) {
    run(*replan, std::cout, std::cerr, isatty(STDERR_FILENO) != 0);
  } else if (const auto* view = std::get_if<ViewCommand>(&command)) {
    run(*view, std::cout, std::cerr);
  } else if (const auto* profiles = std::get_if<ProfilesCommand>(&command)) {
    std::cout << text_of(*profiles);
  } else if (const auto* options = std::get_if<OptionsCommand>(&command)) {
    std::cout << text_of(*options);
  } else {
    std::cout << std::get<TextCommand>(command).text;
  }
  if (!std::cout.flush()) throw SystemError("standard output cannot be written");
  return code;
}

int fail(int code, const char* message) {
  std::cerr << "cleancolor: " << message << std::endl;
  return code;
}

}  // namespace
}  // namespace cleancolor

int main(int argc, char** argv) {
  using namespace cleancolor;
  watch_interrupts();
  try {
    return run(parse_command_line({argv + 1, argv + argc}));
  } catch (const SystemError& e) {
    return fail(exit_system, e.what());
  } catch (const Error& e) {
    if (interrupted()) return fail(exit_interrupted, "interrupted; no file was written");
    return fail(exit_wrong_input, e.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_system, "out of memory");
  } catch (const std::exception& e) {  // of the standard library: files and threads
    return fail(exit_system, e.what());
  }
}
