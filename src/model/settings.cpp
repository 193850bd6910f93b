#include "model/settings.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "base/text_parts.hpp"
#include "model/ini.hpp"
#include "model/options.hpp"
#include "model/profile.hpp"
#include "model/validate.hpp"

namespace cleancolor {
namespace {

Config with_materials(Config config, const std::vector<std::string>& materials) {
  if (materials.empty()) return config;
  const std::size_t count = config.extruders.size();
  if (materials.size() > count) {
    throw Error(fmt::format("--material: {} materials, but the printer has {} extruder{}", materials.size(), count,
                            count == 1 ? "" : "s"));
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::string& name = materials[std::min(i, materials.size() - 1)];
    config = with_profile(std::move(config), find_profile(OptionGroup::material, name), i);
  }
  return config;
}

/// printer: nullptr where none is named beside a loaded file.
Config with_profiles(const Profile* printer, const Settings& settings) {
  Config config;
  std::vector<std::string> materials = settings.materials;
  std::string print = settings.print;
  const bool loads = !settings.load.empty();
  if (printer) {
    config = with_profile(std::move(config), *printer);
    if (materials.empty() && !loads && !printer->default_material.empty()) materials = {printer->default_material};
    if (print.empty() && !loads) print = printer->default_print;
  }
  // A loaded file may have more extruders than are known of so far.
  if (loads && materials.size() > config.extruders.size() && materials.size() <= max_extruders) {
    set_extruder_count(config, materials.size());
  }
  config = with_materials(std::move(config), materials);
  if (!print.empty()) config = with_profile(std::move(config), find_profile(OptionGroup::print, print));
  return config;
}

Config with_loaded(Config config, const std::filesystem::path& file, const Progress& progress) {
  IniResult result = with_ini_file(std::move(config), file, progress);
  if (!result.ignored.empty()) {
    progress.warn(fmt::format("{}: {} option{} not known here and without effect: {}", file.string(),
                              result.ignored.size(), result.ignored.size() == 1 ? " is" : "s are",
                              fmt::join(result.ignored, ", ")));
  }
  return std::move(result.config);
}

Config with_options(Config config, const Settings& settings, const Progress& progress) {
  if (!settings.load.empty()) config = with_loaded(std::move(config), settings.load, progress);
  for (const std::string& assignment : settings.set) {
    const std::size_t equals = assignment.find('=');
    if (equals == assignment.npos) {
      throw Error(fmt::format("--set {}: expected name=value, such as --set layer_height=0.2", assignment));
    }
    std::string name = assignment.substr(0, equals);
    name.erase(name.find_last_not_of(' ') + 1);
    set_option(config, name, assignment.substr(equals + 1), "--set ");
  }
  validate(config);
  return config;
}

}  // namespace

std::optional<ProtectionLevel> protection_level(std::string_view word) {
  if (word == "full") return ProtectionLevel{};
  if (word == "rampart") return ProtectionLevel{.turns = true, .set = {"planner=plain"}};
  if (word == "none") return ProtectionLevel{.turns = false, .set = {"planner=plain", "rampart=off"}};
  return std::nullopt;
}

std::optional<double> azimuth_deg(std::string_view word, std::string_view name) {
  if (word == "auto") return std::nullopt;
  if (word == "off") return 0;
  double degrees = 0;
  if (!parse_whole(word, degrees) || !std::isfinite(degrees))
    throw Error(fmt::format("{}: '{}' is neither auto nor off nor an angle in degrees", name, word));
  return degrees;
}

Config config_of(const Settings& settings, const Progress& progress) {
  if (settings.printer.empty() && !settings.load.empty())  // which has one of its own
    return with_options(with_profiles(nullptr, settings), settings, progress);
  const std::string printer = settings.printer.empty() ? "generic" : settings.printer;
  return config_of(find_profile(OptionGroup::printer, printer), settings, progress);
}

Config config_of(const Profile& printer, const Settings& settings, const Progress& progress) {
  return with_options(with_profiles(&printer, settings), settings, progress);
}

}  // namespace cleancolor
