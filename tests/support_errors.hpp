// support_errors.hpp
//
// For tests of what is refused or warned of: the message of an Error, warnings, and files with their text.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/progress.hpp"

namespace cleancolor {

/// The message of the Error that the action throws; "no error" where it throws none.
inline std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

struct Warned {
  std::vector<std::string> warnings;
  Progress progress{.warn = [this](const std::string& w) { warnings.push_back(w); }};
};

inline std::string file_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// A folder of one test, emptied before and removed after it.
class TestFolder {
 public:
  TestFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    // With the process id: the same test may run in two build directories at once.
    std::string name =
        std::string("cleancolor_") + test->test_suite_name() + "_" + test->name() + "_" + std::to_string(::getpid());
    for (char& c : name)
      if (c == '/') c = '_';  // in the names of parameterised tests
    path_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TestFolder() { std::filesystem::remove_all(path_); }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  /// Writes the file and returns its path.
  std::string file(const std::string& name, std::string_view text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }
  std::string path(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace cleancolor

/// The statement throws an Error whose message contains the text.
#define EXPECT_ERROR(statement, text)                                                           \
  do {                                                                                          \
    const std::string error_message = cleancolor::error_of([&] { (void)(statement); });         \
    EXPECT_NE(error_message.find(text), std::string::npos) << "but it said: " << error_message; \
  } while (false)
