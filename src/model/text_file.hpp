// model/text_file.hpp
//
// A small text file as a whole: profiles and configurations.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace cleancolor {

/// Throws Error where the file cannot be read, is a folder, or is larger than 16 MB.
std::string text_of_file(const std::filesystem::path& file);

/// The last max_bytes of the file, or all of it.  Throws Error where it cannot be read or is a folder.
std::string end_of_file(const std::filesystem::path& file, std::uintmax_t max_bytes);

}  // namespace cleancolor
