#include "viewer/own_printers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "model/profile.hpp"
#include "model/validate.hpp"

namespace cleancolor {
namespace {

void require_built_in(OptionGroup group, const std::string& profile, std::string_view key, const std::string& name) {
  const auto is_it = [&](const BuiltInProfile& p) { return p.group == group && p.name == profile; };
  if (!profile.empty() && std::ranges::none_of(builtin_profiles(), is_it))
    throw Error(fmt::format("{}: {}: there is no built-in {} '{}'", name, key, group_name(group), profile));
}

}  // namespace

std::string printer_named(const std::string& name, const OwnPrinters& own) {
  const auto found = own.find(name);
  return found == own.end() ? name : found->second->path().string();
}

void check_printer(const std::string& toml, const std::string& name) {
  if (!name.ends_with(".toml")) throw Error(fmt::format("{}: the name of a printer's profile ends in .toml", name));
  const Profile profile = read_profile(OptionGroup::printer, toml, name, Inherits::built_in);
  if (profile.settings.empty()) throw Error(fmt::format("{}: no option of a printer is in it", name));
  require_built_in(OptionGroup::material, profile.default_material, "default_material", name);
  require_built_in(OptionGroup::print, profile.default_print, "default_print", name);
  Config config = with_profile(Config{}, profile);
  try {
    for (std::size_t i = 0; i < config.extruders.size() && !profile.default_material.empty(); ++i)
      config = with_profile(std::move(config), find_profile(OptionGroup::material, profile.default_material), i);
    if (!profile.default_print.empty())
      config = with_profile(std::move(config), find_profile(OptionGroup::print, profile.default_print));
    validate(config);
  } catch (const Error& e) {
    throw Error(fmt::format("{}: {}", name, e.what()));
  }
}

}  // namespace cleancolor
