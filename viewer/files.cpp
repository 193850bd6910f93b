#include "viewer/files.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "base/error.hpp"
#include "base/printable.hpp"

namespace cleancolor {
namespace {

constexpr std::size_t longest_name = 100, longest_ending = 10;

}  // namespace

StoredFile::~StoredFile() {
  if (!owned_) return;
  std::error_code ignored;  // the folder goes as a whole later on
  std::filesystem::remove(path_, ignored);
  std::filesystem::remove(path_.parent_path(), ignored);
}

TempFolder::TempFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "cleancolor-view-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw SystemError(fmt::format("{}: cannot be made: {}", pattern, std::strerror(errno)));
  path_ = pattern;
}

TempFolder::~TempFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

FileHandle TempFolder::new_file(const std::string& name) {
  const std::filesystem::path folder = path_ / std::to_string(next_++);
  std::error_code fault;
  if (!std::filesystem::create_directory(folder, fault))
    throw SystemError(fmt::format("{}: cannot be made: {}", folder.string(), fault.message()));
  return std::make_shared<StoredFile>(folder / name, true);
}

std::string file_name(std::string_view asked) {
  asked = asked.substr(asked.find_last_of("/\\") + 1);
  std::string name = printable(asked);
  if (name.size() > longest_name) {
    const std::size_t point = name.rfind('.');
    const bool ends = point != name.npos && name.size() - point <= longest_ending;
    const std::string ending = ends ? name.substr(point) : "";
    name = printable(std::string_view(name).substr(0, longest_name - ending.size())) + ending;
  }
  name.erase(0, name.find_first_not_of(". "));
  return name.empty() ? "upload" : name;
}

}  // namespace cleancolor
