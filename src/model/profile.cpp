#include "model/profile.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "base/error.hpp"
#include "model/text_file.hpp"

namespace cleancolor {
namespace {

constexpr int max_inheritance = 8;

std::string place_of(const std::string& file, const toml::node& node) {
  return fmt::format("{}:{}: ", file, node.source().begin.line);
}

[[noreturn]] void wrong_type(const Option& option, const std::string& where, std::string_view wanted) {
  throw Error(fmt::format("{}{}: the value must be {}", where, option.name, wanted));
}

std::optional<Vec2> point(const toml::node& node) {
  const toml::array* pair = node.as_array();
  if (!pair || pair->size() != 2 || !(*pair)[0].is_number() || !(*pair)[1].is_number()) return std::nullopt;
  return Vec2{*(*pair)[0].value<double>(), *(*pair)[1].value<double>()};
}

std::optional<std::vector<Vec2>> polygon(const toml::node& node) {
  const toml::array* list = node.as_array();
  if (!list) return std::nullopt;
  std::vector<Vec2> points;
  for (const toml::node& element : *list) {
    const auto p = point(element);
    if (!p) return std::nullopt;
    points.push_back(*p);
  }
  return points;
}

OptionValue value_of(const Option& option, const toml::node& node, const std::string& where) {
  switch (option.kind()) {
    case OptionKind::flag:
      if (!node.is_boolean()) wrong_type(option, where, "true or false");
      return *node.value<bool>();
    case OptionKind::integer: {
      const auto value = node.is_integer() ? node.value<int>() : std::nullopt;
      if (!value) wrong_type(option, where, "a whole number");
      return *value;
    }
    case OptionKind::number:
      if (!node.is_number()) wrong_type(option, where, "a number");
      return *node.value<double>();
    case OptionKind::percent:
    case OptionKind::length_or_share:
      if (node.is_number()) return parse_option(option, fmt::format("{}", *node.value<double>()), where);
      if (!node.is_string()) wrong_type(option, where, "a number or a percentage such as \"20%\"");
      return parse_option(option, *node.value<std::string_view>(), where);
    case OptionKind::text:
    case OptionKind::choice:
      if (!node.is_string()) wrong_type(option, where, "a text in quotes");
      return parse_option(option, *node.value<std::string_view>(), where);
    case OptionKind::point: {
      const auto p = point(node);
      if (!p) wrong_type(option, where, "a point [x, y]");
      return *p;
    }
    case OptionKind::polygon: {
      auto points = polygon(node);
      if (!points) wrong_type(option, where, "a list of points [[x, y], ...]");
      return *std::move(points);
    }
  }
  wrong_type(option, where, "of a known kind");
}

// Does the node hold one value rather than a list with one value per extruder? [33, 0] is a point, [[0, 0], [33, 0]]
// two.
bool is_one_value(const Option& option, const toml::node& node) {
  const auto first_is_array = [](const toml::node& n) {
    const toml::array* list = n.as_array();
    return list && !list->empty() && (*list)[0].is_array();
  };
  if (!option.per_extruder() || !node.is_array()) return true;
  if (option.kind() == OptionKind::point) return !first_is_array(node);
  if (option.kind() == OptionKind::polygon) {
    // A list of points, a list of lists of points; [] is no area, [[], []] none for each of two extruders.
    const toml::array& list = *node.as_array();
    return list.empty() || point(list[0]).has_value();
  }
  return false;
}

ProfileSetting setting_of(const Option& option, const toml::node& node, const std::string& file) {
  ProfileSetting setting{&option, {}, place_of(file, node)};
  if (is_one_value(option, node)) {
    setting.values.push_back(value_of(option, node, setting.where));
  } else {
    for (const toml::node& element : *node.as_array()) {
      setting.values.push_back(value_of(option, element, place_of(file, element)));
    }
  }
  if (setting.values.empty() || setting.values.size() > max_extruders) {
    throw Error(fmt::format("{}{}: {} values; give one for each extruder, of which there can be 1 to {}", setting.where,
                            option.name, setting.values.size(), max_extruders));
  }
  if (option.group == OptionGroup::material && setting.values.size() > 1) {
    throw Error(fmt::format("{}{}: a list; a material profile is about one extruder and has one value", setting.where,
                            option.name));
  }
  // Ranges are checked while the line is known.
  Config trial;
  for (const OptionValue& value : setting.values) store_option(trial, option, 0, value, setting.where);
  return setting;
}

const Option& option_of(OptionGroup group, std::string_view key, const std::string& where) {
  const Option* option = find_option(key);
  if (!option) throw Error(fmt::format("{}there is no option '{}'{}", where, key, did_you_mean(key)));
  if (option->group != group) {
    throw Error(fmt::format("{}{} is an option of the {}, not of the {}; put it into a profile for --{}", where, key,
                            group_name(option->group), group_name(group), group_name(option->group)));
  }
  return *option;
}

void put(std::vector<ProfileSetting>& settings, ProfileSetting setting) {
  const auto same = std::ranges::find(settings, setting.option, &ProfileSetting::option);
  if (same == settings.end()) {
    settings.push_back(std::move(setting));
  } else {
    *same = std::move(setting);
  }
}

std::string string_of(const toml::node& node, std::string_view key, const std::string& file) {
  if (!node.is_string())
    throw Error(fmt::format("{}{}: the value must be a text in quotes", place_of(file, node), key));
  return *node.value<std::string>();
}

Profile find(OptionGroup group, const std::string& name_or_file, const std::string& where, int depth);

bool is_file(const std::string& name) {
  return name.ends_with(".toml") || name.find('/') != name.npos;
}

// The one place where toml++ speaks by exceptions.
toml::table parsed(std::string_view text, const std::string& file) {
  try {
    return toml::parse(text, std::string_view(file));
  } catch (const toml::parse_error& e) {
    throw Error(fmt::format("{}:{}: {}", file, e.source().begin.line, e.description()));
  }
}

Profile read(OptionGroup group, std::string_view text, const std::string& file, int depth, Inherits from) {
  const toml::table table = parsed(text, file);
  Profile profile;
  if (const toml::node* node = table.get("inherits")) {
    std::string parent = string_of(*node, "inherits", file);
    if (is_file(parent) && from == Inherits::built_in)
      throw Error(fmt::format("{}inherits: '{}' is a file; only built-in profiles can be inherited here",
                              place_of(file, *node), parent));
    if (is_file(parent)) parent = (std::filesystem::path(file).parent_path() / parent).string();
    if (depth == max_inheritance) {
      throw Error(fmt::format("{}inherits: more than {} profiles inherit one from another; is it a circle?",
                              place_of(file, *node), max_inheritance));
    }
    profile = find(group, parent, place_of(file, *node), depth + 1);
  }
  profile.group = group;
  profile.name = std::filesystem::path(file).stem().string();
  for (const auto& [key, node] : table) {
    if (key == "inherits") continue;
    if (key == "description") {
      profile.description = string_of(node, key, file);
    } else if (group == OptionGroup::printer && key == "default_material") {
      profile.default_material = string_of(node, key, file);
    } else if (group == OptionGroup::printer && key == "default_print") {
      profile.default_print = string_of(node, key, file);
    } else {
      put(profile.settings, setting_of(option_of(group, key, place_of(file, node)), node, file));
    }
  }
  return profile;
}

Profile find(OptionGroup group, const std::string& name_or_file, const std::string& where, int depth) {
  if (is_file(name_or_file)) return read(group, text_of_file(name_or_file), name_or_file, depth, Inherits::all);
  std::vector<std::string_view> names;
  for (const BuiltInProfile& p : builtin_profiles()) {
    if (p.group != group) continue;
    if (p.name == name_or_file) return read(group, p.toml, fmt::format("{}.toml", p.name), depth, Inherits::all);
    names.push_back(p.name);
  }
  throw Error(fmt::format("{}there is no {} '{}'; known are {}; a file of your own ends in .toml", where,
                          group_name(group), name_or_file, fmt::join(names, ", ")));
}

}  // namespace

bool is_built_in(OptionGroup group, std::string_view name) {
  return std::ranges::any_of(builtin_profiles(),
                             [&](const BuiltInProfile& p) { return p.group == group && p.name == name; });
}

Profile find_profile(OptionGroup group, const std::string& name_or_file) {
  return find(group, name_or_file, "", 0);
}

std::optional<OptionGroup> profile_group(const std::string& name_or_file) {
  if (!is_file(name_or_file)) {
    const auto found = std::ranges::find(builtin_profiles(), name_or_file, &BuiltInProfile::name);
    return found == builtin_profiles().end() ? std::nullopt : std::optional(found->group);
  }
  const toml::table table = parsed(text_of_file(name_or_file), name_or_file);
  for (const auto& [key, node] : table) {
    if (const Option* option = find_option(key)) return option->group;
  }
  const auto inherited = table["inherits"].value<std::string>();
  return inherited && !is_file(*inherited) ? profile_group(*inherited) : std::nullopt;
}

Profile read_profile(OptionGroup group, std::string_view toml, const std::string& file, Inherits from) {
  return read(group, toml, file, 0, from);
}

Config with_profile(Config config, const Profile& profile, std::size_t extruder) {
  for (const ProfileSetting& s : profile.settings) {
    if (s.option->name == "nozzle_diameter") set_extruder_count(config, s.values.size());
  }
  const std::size_t count = config.extruders.size();
  for (const ProfileSetting& s : profile.settings) {
    if (profile.group == OptionGroup::material || !s.option->per_extruder()) {
      store_option(config, *s.option, extruder, s.values.front(), s.where);
      continue;
    }
    if (s.values.size() != 1 && s.values.size() != count) {
      throw Error(fmt::format("{}{}: {} values for {} extruders (so many values has nozzle_diameter)", s.where,
                              s.option->name, s.values.size(), count));
    }
    for (std::size_t i = 0; i < count; ++i) {
      store_option(config, *s.option, i, s.values.size() == 1 ? s.values.front() : s.values[i], s.where);
    }
  }
  return config;
}

}  // namespace cleancolor
