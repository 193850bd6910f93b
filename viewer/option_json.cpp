#include "viewer/option_json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "model/options.hpp"
#include "model/settings.hpp"

namespace cleancolor {
namespace {

using Json = nlohmann::ordered_json;

std::string_view kind_word(OptionKind kind) {
  switch (kind) {
    case OptionKind::flag:
      return "flag";
    case OptionKind::integer:
      return "integer";
    case OptionKind::number:
      return "number";
    case OptionKind::percent:
      return "percent";
    case OptionKind::length_or_share:
      return "length_or_share";
    case OptionKind::text:
      return "text";
    case OptionKind::choice:
      return "choice";
    case OptionKind::point:
      return "point";
    case OptionKind::polygon:
      return "polygon";
  }
  return "text";
}

bool is_number(OptionKind kind) {
  return kind == OptionKind::integer || kind == OptionKind::number || kind == OptionKind::percent ||
         kind == OptionKind::length_or_share;
}

Json limit(const Option& option, double value) {
  return is_number(option.kind()) && std::isfinite(value) ? Json(value) : Json();
}

Json option_json(const Option& option) {
  Json choices = Json::array();
  for (const std::string_view choice : option.choices()) choices.push_back(choice);
  return {{"name", option.name},
          {"group", group_name(option.group)},
          {"section", option.section},
          {"kind", kind_word(option.kind())},
          {"unit", option.unit},
          {"min", limit(option, option.min)},
          {"max", limit(option, option.max)},
          {"choices", choices},
          {"per_extruder", option.per_extruder()},
          {"help", option.help},
          {"default", option_text(Config{}, option.name)}};
}

Json profile_json(const Profile& profile, PrinterRow row = {}) {
  const Config config = with_profile(Config{}, profile);
  Json settings = Json::object();
  for (const ProfileSetting& s : profile.settings)
    settings[std::string(s.option->name)] = option_text(config, s.option->name);
  Json json = {{"group", group_name(profile.group)}, {"name", profile.name}, {"description", profile.description}};
  if (profile.group == OptionGroup::printer) {
    json["extruders"] = config.extruders.size();
    json["default_material"] = profile.default_material;
    json["default_print"] = profile.default_print;
    json["audit_only"] = config.audit_only;
    json["chosen"] = row.chosen;
    json["sent"] = row.sent;
  }
  json["settings"] = settings;
  return json;
}

/// Like a profile, so that whoever asks for values finds those of protection likewise.
Json protection_json(const std::string& word) {
  const ProtectionLevel level = *protection_level(word);
  Json settings = Json::object();
  for (const std::string& assignment : level.set) {
    const std::size_t equals = assignment.find('=');
    settings[assignment.substr(0, equals)] = assignment.substr(equals + 1);
  }
  return {{"group", "protection"}, {"name", word}, {"turns", level.turns}, {"settings", settings}};
}

std::string text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string options_json() {
  Json all = Json::array();
  for (const Option& option : options()) all.push_back(option_json(option));
  return text(all);
}

std::string printer_row(const Profile& printer, PrinterRow row) {
  return text(profile_json(printer, row));
}

std::string built_in_rows(const std::string& chosen) {
  std::vector<std::string> rows;
  for (const BuiltInProfile& p : builtin_profiles())
    rows.push_back(text(profile_json(find_profile(p.group, std::string(p.name)),
                                     {.chosen = p.group == OptionGroup::printer && p.name == chosen})));
  for (const char* word : {"none", "rampart", "full"}) rows.push_back(text(protection_json(word)));
  return fmt::format("{}", fmt::join(rows, ","));
}

}  // namespace cleancolor
