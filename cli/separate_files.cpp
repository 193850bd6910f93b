#include "cli/separate_files.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace cleancolor {
namespace {

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code fault;
  if (std::filesystem::equivalent(a, b, fault)) return true;
  // One that is not there yet has only its name.
  const auto whole_a = std::filesystem::weakly_canonical(std::filesystem::absolute(a, fault), fault);
  return !fault && whole_a == std::filesystem::weakly_canonical(std::filesystem::absolute(b, fault), fault);
}

}  // namespace

void require_separate_files(const std::vector<std::filesystem::path>& inputs, const std::vector<NamedOutput>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto& [name, path] = outputs[i];
    if (path.empty()) continue;
    for (const auto& input : inputs)
      if (is_same_file(input, path))
        throw Error(fmt::format("{}: input and {} are the same file; name another", input.string(), name));
    for (std::size_t j = 0; j < i; ++j)
      if (!outputs[j].path.empty() && is_same_file(outputs[j].path, path))
        throw Error(fmt::format("{}: {} and {} are the same file; name another", path.string(), outputs[j].name, name));
  }
}

}  // namespace cleancolor
