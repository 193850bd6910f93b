#include "cli/profiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/error.hpp"
#include "model/profile.hpp"

namespace cleancolor {
namespace {

std::string list_of_profiles() {
  std::string text;
  for (const OptionGroup group : {OptionGroup::printer, OptionGroup::material, OptionGroup::print}) {
    const bool is_print = group == OptionGroup::print;
    text += fmt::format("{}{}{} (--{}):\n", text.empty() ? "" : "\n", is_print ? "print settings" : group_name(group),
                        is_print ? "" : "s", group_name(group));
    for (const BuiltInProfile& p : builtin_profiles()) {
      if (p.group != group) continue;
      text += fmt::format("  {:<24}{}\n", p.name, find_profile(group, std::string(p.name)).description);
    }
  }
  return text + "\ncleancolor profiles show NAME prints one with every default, to start your own from.\n";
}

Profile profile_of(const std::string& name_or_file) {
  if (const auto group = profile_group(name_or_file)) return find_profile(*group, name_or_file);
  throw Error(fmt::format(
      "there is no profile '{}'; 'cleancolor profiles' lists them; a file of your own ends in .toml", name_or_file));
}

std::string quoted_key(std::string_view key, const std::string& text) {
  return text.empty() ? "" : fmt::format("{} = \"{}\"\n", key, text);
}

std::string shown(const Profile& profile) {
  const Config config = with_profile(Config{}, profile);
  std::string head = fmt::format("# {} profile {}, with every default\n", group_name(profile.group), profile.name);
  head += quoted_key("description", profile.description);
  head += quoted_key("default_material", profile.default_material);
  head += quoted_key("default_print", profile.default_print);
  return head + "\n" + profile_toml(config, profile.group);
}

/// Capitals or not: headings begin with one.
bool contains(std::string_view text, std::string_view word) {
  const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
  return std::search(text.begin(), text.end(), word.begin(), word.end(), same) != text.end();
}

bool concerns(const Option& option, std::string_view word) {
  return contains(option.section, word) || contains(option.name, word) || contains(option.help, word);
}

}  // namespace

std::string text_of(const ProfilesCommand& command) {
  return command.show.empty() ? list_of_profiles() : shown(profile_of(command.show));
}

std::string text_of(const OptionsCommand& command) {
  if (command.markdown) return options_markdown();
  std::string text;
  std::string_view section;
  for (const Option& option : options()) {
    if (!concerns(option, command.word)) continue;
    if (option.section != section) {
      section = option.section;
      text += fmt::format("{}{} ({})\n", text.empty() ? "" : "\n", section, group_name(option.group));
    }
    const std::string choices = fmt::format("{}", fmt::join(option.choices(), " | "));
    const std::string_view values = choices.empty() ? option.unit : choices;
    text += fmt::format("  {:<38}{}{}\n", option.name, option.help, values.empty() ? "" : fmt::format(" [{}]", values));
  }
  if (text.empty()) throw Error(fmt::format("no option has '{}' in its section, name or help", command.word));
  return text;
}

}  // namespace cleancolor
