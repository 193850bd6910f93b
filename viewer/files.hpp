// viewer/files.hpp
//
// Files of the viewer: uploads and results in a private folder that goes when the program ends, and those that the user
// named, which stay.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace cleancolor {

/// A file as long as somebody holds it.
class StoredFile {
 public:
  /// owned: it goes with the last holder, and the folder around it, if that is then empty.
  StoredFile(std::filesystem::path path, bool owned) : path_(std::move(path)), owned_(owned) {}
  ~StoredFile();
  StoredFile(const StoredFile&) = delete;
  StoredFile& operator=(const StoredFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  bool owned_;
};
using FileHandle = std::shared_ptr<const StoredFile>;

/// A folder that only this user can look into; the destructor removes it with all that is in it.
class TempFolder {
 public:
  /// Throws SystemError where it cannot be made.
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  /// A file of this name, not there yet, in a folder of its own: messages about it then name what the user knows.
  /// Requires: a name as file_name makes them.
  FileHandle new_file(const std::string& name);

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::atomic<int> next_ = 1;
};

/// What somebody calls a file, without folders and whatever else is no part of a name: at most 100 bytes, printable,
/// not hidden, never empty.
std::string file_name(std::string_view asked);

}  // namespace cleancolor
