// base/output_file.hpp
//
// OutputFile: a file that is either whole or not there. Written aside, renamed at the end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace cleancolor {

/// Writes to a hidden temporary file beside the target; commit() renames it. Without commit() the destructor removes it
/// and a file that was there before stays as it was.
///
/// Every failure (no such folder, no permission, disc full, the target is write-protected or not a regular file) is a
/// SystemError with the path and the reason. A symbolic link is followed: the file that it names is replaced, not the
/// link.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& target);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);

  /// Replaces bytes that were written before.  Requires: offset + bytes.size() <= size().
  void patch(std::uint64_t offset, std::string_view bytes);

  std::uint64_t size() const { return size_; }  // bytes written so far

  /// The target now is this file. Nothing may be written after.
  void commit();

 private:
  void flush();
  [[noreturn]] void fail(const char* what, int error) const;

  std::filesystem::path target_;
  std::filesystem::path temporary_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::string buffer_;  // the last bytes, not yet on the disc
};

/// The whole file at once, written aside and renamed.
void write_file(const std::filesystem::path& target, std::string_view bytes);

}  // namespace cleancolor
