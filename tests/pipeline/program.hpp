// tests/pipeline/program.hpp
//
// The program as a process of its own: how it ends, what it says, what it leaves behind, how much memory it takes.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

#include "support_errors.hpp"

namespace cleancolor::test {

struct Outcome {
  int exit_code = -1;  // -1: ended by a signal
  std::string out, err;
  double cpu_seconds = 0;  // also on a busy machine
  double peak_mb = 0;
};

/// Exit codes as documented for people who write scripts; the tests must not follow a change of the program.
inline constexpr int exit_done = 0, exit_wrong_input = 2, exit_system = 3;

/// Runs the program in the folder and waits for it; after 60 s it is killed. prepare: called in the child before.
Outcome run(
    const TestFolder& folder, const std::vector<std::string>& arguments, const std::function<void()>& prepare = [] {});

/// Starts it and does not wait.
pid_t started(
    const TestFolder& folder, const std::vector<std::string>& arguments, const std::function<void()>& prepare = [] {});

/// Names of the files in the folder, sorted, without those in which run() keeps what was said.
std::vector<std::string> files_in(const TestFolder& folder);

}  // namespace cleancolor::test
