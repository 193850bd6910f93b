// outcome.hpp
//
// For tests of the whole program: runs it as a shell does.
#pragma once

#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "support_errors.hpp"

namespace cleancolor {

struct Outcome {
  int exit_code;
  std::string out;
  std::string err;
};

/// arguments: as in a shell, relative to the folder; before: what stands before the program, as "ulimit -f 8;".
inline Outcome run(const TestFolder& folder, const std::string& arguments, const std::string& before = "") {
  const std::string out = folder.path("stdout"), err = folder.path("stderr");
  const std::string command = fmt::format("cd '{}' && {} '{}' {} > '{}' 2> '{}'", folder.path("."), before,
                                          CLEANCOLOR_PROGRAM, arguments, out, err);
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, file_text(out), file_text(err)};
}

}  // namespace cleancolor
