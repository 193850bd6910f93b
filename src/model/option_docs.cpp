// The reference of all options: options_markdown.

#include <fmt/format.h>

#include "model/options.hpp"

namespace cleancolor {
namespace {

constexpr std::string_view introduction = R"(# Options

This file is written by `cleancolor options --markdown`; do not edit it.

Options are set, each step over the one before, by the defaults below, the printer's profile (`--printer`), the
material's (`--material`), the print settings (`--print`), an imported configuration (`--load`), and `--set name=value`.
Names, meanings and the text of values are PrusaSlicer's wherever it has the option.

* **per extruder**: a list with one value for each extruder, or one value for all. In `--set` and .ini files numbers are
  separated by commas, texts by semicolons; in TOML it is an array.
* Yes and no are `1` and `0` in `--set` and .ini files, `true` and `false` in TOML.
* A share is a percentage such as `50%`, in TOML `"50%"`; from 0% to 1000%, at least 1% where 0 is not allowed.
* Points are `33x0` in `--set` and .ini files, `[33, 0]` in TOML; an outline is a list of points.
)";

std::string values_of(const Option& option) {
  const std::string range = fmt::format("{:g} to {:g}", option.min, option.max);
  const std::string with_unit = option.unit.empty() ? range : fmt::format("{} {}", range, option.unit);
  switch (option.kind()) {
    case OptionKind::flag:
      return "yes or no";
    case OptionKind::integer:
    case OptionKind::number:
    case OptionKind::length_or_share:
      return with_unit;
    case OptionKind::percent:
      return range + " %";
    case OptionKind::text:
      return "text";
    case OptionKind::choice:
      return fmt::format("`{}`", fmt::join(option.choices(), "`, `"));
    case OptionKind::point:
      return "point, mm";
    case OptionKind::polygon:
      return "outline, mm";
  }
  return "";
}

std::string row(const Option& option) {
  const std::string value = option_text(Config{}, option.name);
  return fmt::format("| `{}` | {}{} | {} | {} |\n", option.name, values_of(option),
                     option.per_extruder() ? "; per extruder" : "",
                     value.empty() || value == "\"\"" ? "" : fmt::format("`{}`", value), option.help);
}

}  // namespace

std::string options_markdown() {
  std::string text(introduction);
  for (const OptionGroup group : {OptionGroup::printer, OptionGroup::material, OptionGroup::print}) {
    text += fmt::format("\n## Options of the {}\n", group_name(group));
    std::string_view section;
    for (const Option& option : options()) {
      if (option.group != group) continue;
      if (option.section != section) {
        section = option.section;
        text += fmt::format("\n### {}\n\n| option | values | default | meaning |\n|---|---|---|---|\n", section);
      }
      text += row(option);
    }
  }
  return text;
}

}  // namespace cleancolor
