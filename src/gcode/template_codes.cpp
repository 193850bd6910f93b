#include "gcode/template_codes.hpp"

#include <fmt/format.h>

#include <cctype>
#include <string>
#include <vector>

namespace cleancolor {
namespace {

/// Lines without comments and blanks around them.
std::vector<std::string_view> lines_of(std::string_view code) {
  std::vector<std::string_view> lines;
  while (!code.empty()) {
    const std::size_t end = std::min(code.find('\n'), code.size());
    std::string_view line = code.substr(0, end);
    code.remove_prefix(std::min(end + 1, code.size()));
    line = line.substr(0, line.find(';'));
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.front()))) line.remove_prefix(1);
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.remove_suffix(1);
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

/// "M104 S215" begins with M104, "M1040" does not.
bool begins_with(std::string_view line, std::string_view code) {
  if (code.empty() || !line.starts_with(code)) return false;
  return line.size() == code.size() || !std::isdigit(static_cast<unsigned char>(line[code.size()]));
}

bool begins_with_any(std::string_view line, const std::array<std::string_view, 3>& codes) {
  for (const std::string_view code : codes)
    if (begins_with(line, code)) return true;
  return false;
}

bool has_parameter(std::string_view line, const std::string& parameter) {
  const std::size_t at = line.find(" " + parameter);
  return at != line.npos && begins_with(line.substr(at + 1), parameter);
}

bool names_a_tool(std::string_view line) {
  for (const std::string_view letter : {" T", " P"})
    if (const std::size_t at = line.find(letter); at != line.npos && at + 2 < line.size() && std::isdigit(line[at + 2]))
      return true;
  return false;
}

/// A line that is not a heating code itself but is given the temperature.
bool hands_over(std::string_view code, std::string_view option, const std::array<std::string_view, 3>& codes) {
  for (const std::string_view line : lines_of(code))
    if (!begins_with_any(line, codes) && line.find(option) != line.npos) return true;
  return false;
}

/// The same of one nozzle: {first_layer_temperature[1]} and [first_layer_temperature_1] are nozzle 1's, without a
/// number the first one's that prints.
bool hands_over_nozzle(std::string_view code, const std::array<std::string_view, 3>& codes, int tool,
                       int initial_tool) {
  constexpr std::string_view option = "first_layer_temperature";
  for (const std::string_view line : lines_of(code)) {
    if (begins_with_any(line, codes)) continue;
    for (std::size_t at = line.find(option); at != line.npos; at = line.find(option, at + 1)) {
      const std::string_view rest = line.substr(at + option.size());
      const bool numbered =
          rest.size() > 1 && (rest[0] == '[' || rest[0] == '_') && std::isdigit(static_cast<unsigned char>(rest[1]));
      if ((numbered ? rest[1] - '0' : initial_tool) == tool) return true;
    }
  }
  return false;
}

}  // namespace

bool heats_nozzle(std::string_view code, std::string_view filled, const FlavourWords& words, int tool,
                  int initial_tool) {
  if (hands_over_nozzle(code, words.nozzle_codes, tool, initial_tool)) return true;
  for (const std::string_view line : lines_of(filled)) {
    if (!begins_with_any(line, words.nozzle_codes)) continue;
    if (has_parameter(line, fmt::format("T{}", tool)) || has_parameter(line, fmt::format("P{}", tool))) return true;
    if (!names_a_tool(line) && (tool == initial_tool || has_parameter(line, "S0"))) return true;
  }
  return false;
}

bool heats_bed(std::string_view code, std::string_view filled, const FlavourWords& words) {
  if (hands_over(code, "bed_temperature", words.bed_codes)) return true;
  for (const std::string_view line : lines_of(filled))
    if (begins_with_any(line, words.bed_codes)) return true;
  return false;
}

bool selects_tool(std::string_view filled, const FlavourWords& words, int tool) {
  for (const std::string_view line : lines_of(filled))
    for (const std::string_view code : words.tool_codes)
      if (!code.empty() && begins_with(line, fmt::format(fmt::runtime(code), fmt::arg("tool", tool)))) return true;
  return false;
}

}  // namespace cleancolor
