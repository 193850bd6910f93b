#include "program.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

namespace cleancolor::test {
namespace {

const std::string out_name = "said.out", err_name = "said.err";

void redirect(const std::string& file, int descriptor) {
  const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  ::dup2(opened, descriptor);
  ::close(opened);
}

}  // namespace

pid_t started(const TestFolder& folder, const std::vector<std::string>& arguments,
              const std::function<void()>& prepare) {
  std::vector<std::string> words = {CLEANCOLOR_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const std::string place = folder.path("."), out = folder.path(out_name), err = folder.path(err_name);
  const pid_t child = ::fork();
  if (child != 0) return child;
  redirect(out, STDOUT_FILENO);
  redirect(err, STDERR_FILENO);
  if (::chdir(place.c_str()) != 0) ::_exit(126);
  ::alarm(60);
  prepare();
  ::execv(pointers.front(), pointers.data());
  ::_exit(127);
}

Outcome run(const TestFolder& folder, const std::vector<std::string>& arguments, const std::function<void()>& prepare) {
  const pid_t child = started(folder, arguments, prepare);
  int status = 0;
  rusage usage{};
  Outcome outcome;
  if (::wait4(child, &status, 0, &usage) != child) return outcome;
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  const auto seconds = [](const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
  outcome.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  outcome.peak_mb = double(usage.ru_maxrss) / 1024;
  outcome.out = file_text(folder.path(out_name));
  outcome.err = file_text(folder.path(err_name));
  return outcome;
}

std::vector<std::string> files_in(const TestFolder& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path("."))) {
    const std::string name = entry.path().filename().string();
    if (name != out_name && name != err_name) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace cleancolor::test
