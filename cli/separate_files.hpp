// cli/separate_files.hpp
//
// No output replaces an input.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cleancolor {

struct NamedOutput {
  std::string name;            // as messages call it: "output", "--preview"
  std::filesystem::path path;  // empty: none
};

/// Throws Error where an output would replace an input or another output, also through links.
void require_separate_files(const std::vector<std::filesystem::path>& inputs, const std::vector<NamedOutput>& outputs);

}  // namespace cleancolor
