// A config written as a TOML profile: profile_toml.

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "model/profile.hpp"

namespace cleancolor {
namespace {

std::string toml_quoted(std::string_view text) {
  const bool has_lines = text.find('\n') != text.npos;
  // A new line directly after the opening quotes is not part of the text.
  std::string toml = has_lines ? "\"\"\"\n" : "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      toml += '\\';
      toml += c;
    } else if ((code < 0x20 && c != '\n') || code == 0x7f) {
      toml += fmt::format("\\u{:04X}", static_cast<unsigned>(code));
    } else {
      toml += c;
    }
  }
  return toml + (has_lines ? "\"\"\"" : "\"");
}

std::string point_of(Vec2 p) {
  return fmt::format("[{}, {}]", p.x + 0.0, p.y + 0.0);
}  // never "-0"

std::string toml_of(const Option& option, const OptionValue& value) {
  switch (option.kind()) {
    case OptionKind::flag:
      return std::get<bool>(value) ? "true" : "false";
    case OptionKind::integer:
    case OptionKind::number:
      return value_text(option, value);
    case OptionKind::percent:
    case OptionKind::length_or_share: {
      const std::string text = value_text(option, value);
      return text.ends_with('%') ? toml_quoted(text) : text;
    }
    case OptionKind::text:
    case OptionKind::choice:
      return toml_quoted(value_text(option, value));
    case OptionKind::point:
      return point_of(std::get<Vec2>(value));
    case OptionKind::polygon: {
      std::vector<std::string> points;
      for (const Vec2 p : std::get<std::vector<Vec2>>(value)) points.push_back(point_of(p));
      return fmt::format("[{}]", fmt::join(points, ", "));
    }
  }
  return "";
}

std::string range_text(const Option& option) {
  if (option.kind() == OptionKind::choice) return fmt::format(" ({})", fmt::join(option.choices(), " | "));
  return option.unit.empty() ? "" : fmt::format(" ({})", option.unit);
}

}  // namespace

std::string profile_toml(const Config& config, OptionGroup group) {
  std::string toml;
  std::string_view section;
  for (const Option& option : options()) {
    if (option.group != group) continue;
    if (section != option.section) {
      section = option.section;
      toml += fmt::format("{}# {}\n", toml.empty() ? "" : "\n", section);
    }
    const bool is_list = option.per_extruder() && group != OptionGroup::material;
    std::vector<std::string> values;
    for (std::size_t i = 0; i < (is_list ? config.extruders.size() : 1); ++i) {
      values.push_back(toml_of(option, option_value(config, option, i)));
    }
    const std::string joined = fmt::format("{}", fmt::join(values, ", "));
    toml += fmt::format("\n# {}{}\n{} = {}\n", option.help, range_text(option), option.name,
                        is_list ? "[" + joined + "]" : joined);
  }
  return toml;
}

}  // namespace cleancolor
