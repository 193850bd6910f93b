// cli/words.hpp
//
// What the parsers of all commands share: numbers in words, and texts of --help.
#pragma once

#include <charconv>
#include <filesystem>
#include <string_view>
#include <vector>

namespace cleancolor {

inline constexpr const char* exit_codes =
    "Exit codes:\n"
    "  0    done\n"
    "  1    audit: a figure is over the limit that --fail-over sets\n"
    "  2    wrong input or options\n"
    "  3    a file cannot be read or written\n"
    "  130  interrupted; no file is left\n";

/// Whether the whole text is one number.
template <class T>
bool parse_whole(std::string_view text, T& value) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  return fault == std::errc() && end == text.data() + text.size();
}

/// The pieces between the letters `at`; one where there is none.
std::vector<std::string_view> split(std::string_view text, char at);

/// Throws Error where the file, if there is one, does not end so; hint: what to do.
void require_ending(const std::filesystem::path& path, std::string_view option, std::string_view ending,
                    std::string_view hint);

/// Throws Error where --threads cannot be used.
void require_threads(int threads);

}  // namespace cleancolor
