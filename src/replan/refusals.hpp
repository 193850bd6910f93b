// replan/refusals.hpp
//
// Refusals: what among the layers of a file can be neither moved nor left where it is.
//
//   line or road  ->  why, and what to do; nothing where it can
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "reader/line.hpp"
#include "reader/print.hpp"
#include "replan/dialect_words.hpp"

namespace cleancolor {

inline constexpr double same_height_mm = 0.0005;  // closer ones are one

/// Of a line that begins with a G. raw: its text.
std::optional<std::string> fault_of_g(const GcodeLine& line, std::string_view raw);

/// Of another command; knows_tool: it is the same one wherever the line goes.
std::optional<std::string> fault_of_command(const GcodeLine& line, std::string_view raw, bool knows_tool);

/// Of a road that begins at `from`; tool: the one in use.
std::optional<std::string> fault_of_road(const GcodeMove& move, Vec3 from, int tool, const DialectWords& words);

}  // namespace cleancolor
