#include "base/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstring>

#include "base/error.hpp"

namespace cleancolor {
namespace {

constexpr std::size_t buffer_bytes = 1 << 20;

/// The rest of a write that the system may take in pieces; false: errno says why.
template <class WriteSome>
bool write_all(std::string_view bytes, WriteSome&& write_some) {
  while (!bytes.empty()) {
    const ssize_t n = write_some(bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    bytes.remove_prefix(std::size_t(n));
  }
  return true;
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& target) : target_(target) {
  std::error_code error;
  if (std::filesystem::is_symlink(target_, error)) {
    const auto real = std::filesystem::weakly_canonical(target_, error);
    if (!error) target_ = real;
  }
  const auto status = std::filesystem::status(target_, error);
  if (std::filesystem::is_directory(status))
    throw SystemError(fmt::format("{}: is a folder; name a file to write", target_.string()));
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw SystemError(fmt::format("{}: is not a regular file; name one to write", target_.string()));
  // Renaming would replace a write-protected file all the same, as would root.
  constexpr auto writable =
      std::filesystem::perms::owner_write | std::filesystem::perms::group_write | std::filesystem::perms::others_write;
  if (std::filesystem::exists(status) && (status.permissions() & writable) == std::filesystem::perms::none)
    throw SystemError(fmt::format("{}: is write-protected; name another file to write", target_.string()));

  // The process id keeps two runs that write the same target apart.
  temporary_ = target_.parent_path() / fmt::format(".{}.{}.part", target_.filename().string(), ::getpid());
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail("cannot be created", errno);
  // What is replaced stays as private as it was, and whose it was where the system lets that be.
  struct stat replaced{};
  if (std::filesystem::exists(status) && ::stat(target_.c_str(), &replaced) == 0) {
    if (::fchown(descriptor_, replaced.st_uid, replaced.st_gid) != 0) errno = 0;
    if (::fchmod(descriptor_, replaced.st_mode & 07777) != 0) fail("cannot be created", errno);
  }
  buffer_.reserve(buffer_bytes);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::write(std::string_view bytes) {
  assert(descriptor_ >= 0);
  size_ += bytes.size();
  if (buffer_.size() + bytes.size() > buffer_bytes) flush();
  if (bytes.size() >= buffer_bytes) {
    if (!write_all(bytes, [&](std::string_view b) { return ::write(descriptor_, b.data(), b.size()); }))
      fail("cannot be written", errno);
  } else {
    buffer_ += bytes;
  }
}

void OutputFile::patch(std::uint64_t offset, std::string_view bytes) {
  assert(descriptor_ >= 0 && offset + bytes.size() <= size_);
  flush();
  const bool done = write_all(bytes, [&](std::string_view b) {
    const ssize_t n = ::pwrite(descriptor_, b.data(), b.size(), off_t(offset));
    if (n > 0) offset += std::uint64_t(n);
    return n;
  });
  if (!done) fail("cannot be written", errno);
}

void OutputFile::commit() {
  assert(descriptor_ >= 0);
  flush();
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail("cannot be written", errno);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot be replaced", errno);
  temporary_.clear();
}

void OutputFile::flush() {
  if (!write_all(buffer_, [&](std::string_view b) { return ::write(descriptor_, b.data(), b.size()); }))
    fail("cannot be written", errno);
  buffer_.clear();
}

void OutputFile::fail(const char* what, int error) const {
  throw SystemError(fmt::format("{}: {}: {}", target_.string(), what, std::strerror(error)));
}

void write_file(const std::filesystem::path& target, std::string_view bytes) {
  OutputFile file(target);
  file.write(bytes);
  file.commit();
}

}  // namespace cleancolor
