// cli/words.hpp
//
// What the parsers of all commands share: texts of --help, and what files and threads may be.
#pragma once

#include <filesystem>
#include <string_view>

#include "base/text_parts.hpp"

namespace cleancolor {

inline constexpr const char* exit_codes =
    "Exit codes:\n"
    "  0    done\n"
    "  1    audit: a figure is over the limit that --fail-over sets\n"
    "  2    wrong input or options\n"
    "  3    a file cannot be read or written\n"
    "  130  interrupted; no file is left\n";

/// Throws Error where the file, if there is one, does not end so; hint: what to do.
void require_ending(const std::filesystem::path& path, std::string_view option, std::string_view ending,
                    std::string_view hint);

/// Throws Error where --threads cannot be used.
void require_threads(int threads);

}  // namespace cleancolor
