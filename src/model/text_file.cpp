#include "model/text_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "base/error.hpp"

namespace cleancolor {
namespace {

constexpr std::uintmax_t max_text_bytes = 16 * 1024 * 1024;

std::uintmax_t size_of(const std::filesystem::path& file) {
  std::error_code fault;
  const auto status = std::filesystem::status(file, fault);
  if (!std::filesystem::exists(status)) throw Error(fmt::format("{}: there is no such file", file.string()));
  if (!std::filesystem::is_regular_file(status)) throw Error(fmt::format("{}: this is not a file", file.string()));
  const std::uintmax_t size = std::filesystem::file_size(file, fault);
  if (fault) throw SystemError(fmt::format("{}: cannot be read: {}", file.string(), fault.message()));
  return size;
}

}  // namespace

std::string text_of_file(const std::filesystem::path& file) {
  if (size_of(file) > max_text_bytes) {
    throw Error(fmt::format("{}: more than 16 MB; this is no profile or configuration", file.string()));
  }
  return end_of_file(file, max_text_bytes);
}

std::string end_of_file(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  const std::uintmax_t size = size_of(file);
  const std::uintmax_t bytes = std::min(size, max_bytes);
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(size - bytes));
  std::string text(bytes, '\0');
  if (!in.read(text.data(), static_cast<std::streamsize>(bytes))) {
    throw SystemError(fmt::format("{}: cannot be read", file.string()));
  }
  return text;
}

}  // namespace cleancolor
