#include "viewer/job_request.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "model/options.hpp"
#include "model/profile.hpp"
#include "model/settings.hpp"
#include "model/validate.hpp"
#include "viewer/api_error.hpp"

namespace cleancolor {
namespace {

using Json = nlohmann::ordered_json;

ApiError wrong(const std::string& message, std::string field = "") {
  return {400, message, std::move(field)};
}

/// "" where there is none of this name.
std::string text_at(const Json& json, const char* name) {
  const auto found = json.find(name);
  if (found == json.end() || found->is_null()) return "";
  if (!found->is_string()) throw wrong(fmt::format("{}: a text is expected", name), name);
  return found->get<std::string>();
}

int number_at(const Json& json, const char* name, int most) {
  const auto found = json.find(name);
  if (found == json.end() || !found->is_number_integer())
    throw wrong(fmt::format("meshes: {} must be a whole number", name), "meshes");
  const auto value = found->get<std::int64_t>();
  if (value < 0 || value > most)
    throw wrong(fmt::format("meshes: {} {} is not between 0 and {}", name, value, most), "meshes");
  return int(value);
}

void require_fields(const Json& json, std::initializer_list<std::string_view> known, const std::string& field) {
  for (const auto& [name, value] : json.items())
    if (std::ranges::find(known, name) == known.end())
      throw wrong(fmt::format("there is no field '{}'; known are {}", name, fmt::join(known, ", ")),
                  field.empty() ? name : field);
}

std::vector<JobMesh> meshes_at(const Json& json) {
  const auto found = json.find("meshes");
  if (found == json.end() || !found->is_array() || found->empty()) throw wrong("meshes: name at least one", "meshes");
  if (found->size() > most_meshes) throw wrong(fmt::format("meshes: at most {}", most_meshes), "meshes");
  std::vector<JobMesh> meshes;
  for (const Json& one : *found) {
    if (!one.is_object()) throw wrong("meshes: each is an object with id and extruder", "meshes");
    require_fields(one, {"id", "extruder"}, "meshes");
    JobMesh& mesh = meshes.emplace_back();
    mesh.id = number_at(one, "id", 1'000'000'000);
    if (one.contains("extruder") && !one["extruder"].is_null())
      mesh.extruder = number_at(one, "extruder", int(max_extruders) - 1);
  }
  return meshes;
}

std::vector<std::string> texts_at(const Json& json, const char* name) {
  const auto found = json.find(name);
  if (found == json.end() || found->is_null()) return {};
  std::vector<std::string> texts;
  if (found->is_array())
    for (const Json& one : *found) {
      if (!one.is_string()) break;
      texts.push_back(one.get<std::string>());
    }
  if (!found->is_array() || texts.size() != found->size())
    throw wrong(fmt::format("{}: a list of texts is expected", name), name);
  return texts;
}

void require_profile(const std::string& name, OptionGroup group, const char* field) {
  if (!name.empty() && !is_built_in(group, name))
    throw wrong(fmt::format("there is no {} '{}'", group_name(group), name), field);
}

/// The option of which a message speaks first; "" where it speaks of none.
std::string option_named(std::string_view message) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz_";
  for (std::size_t at = 0; (at = message.find_first_of(letters, at)) != message.npos;) {
    const std::size_t end = std::min(message.size(), message.find_first_not_of(letters, at));
    const std::string_view word = message.substr(at, end - at);
    if (find_option(word)) return std::string(word);
    at = end;
  }
  return "";
}

/// The text of a setting, whether it came as a text, a number or a truth.
std::string setting_text(const std::string& name, const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
  if (value.is_number()) return value.dump();
  throw wrong(fmt::format("{}: a text is expected", name), name);
}

void apply_settings(Config& config, const Json& json) {
  const auto found = json.find("settings");
  if (found == json.end() || found->is_null()) return;
  if (!found->is_object()) throw wrong("settings: an object of names and texts is expected", "settings");
  for (const auto& [name, value] : found->items()) {
    const std::string text = setting_text(name, value);
    try {
      set_option(config, name, text);
    } catch (const Error& e) {
      throw wrong(e.what(), name);
    }
  }
}

Config config_at(const Json& json, const OwnPrinters& own, const ProtectionLevel& protection) {
  const std::string printer = text_at(json, "printer");
  const OwnPrinterHandle own_printer = own.find(printer);
  const Settings settings{.printer = printer,
                          .materials = texts_at(json, "materials"),
                          .print = text_at(json, "print"),
                          .set = protection.set};
  if (!own_printer) require_profile(printer, OptionGroup::printer, "printer");
  require_profile(settings.print, OptionGroup::print, "print");
  for (const std::string& m : settings.materials) require_profile(m, OptionGroup::material, "materials");
  Config config;
  try {
    config = own_printer ? config_of(own_printer->profile, settings) : config_of(settings);
  } catch (const Error& e) {  // the profiles are sound, so only their number can be at fault
    throw wrong(e.what(), settings.materials.size() > 1 ? "materials" : "printer");
  }
  if (config.audit_only) throw wrong(fmt::format("the profile {} serves only to audit G-code", printer), "printer");
  apply_settings(config, json);
  try {
    validate(config);
  } catch (const Error& e) {
    throw wrong(e.what(), option_named(e.what()));
  }
  return config;
}

/// Empty: the best.
std::optional<double> azimuth_at(const Json& json, const ProtectionLevel& protection) {
  const auto found = json.find("azimuth");
  if (found == json.end() || found->is_null()) return azimuth_deg(protection.turns ? "auto" : "off");
  if (!found->is_string() && !found->is_number()) throw wrong("azimuth: auto, off or degrees are expected", "azimuth");
  try {
    return azimuth_deg(setting_text("azimuth", *found));
  } catch (const Error& e) {
    throw wrong(e.what(), "azimuth");
  }
}

}  // namespace

JobRequest job_request(std::string_view body, const OwnPrinters& own) {
  const Json json = Json::parse(body, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) throw wrong("the body is not a JSON object");
  require_fields(json, {"meshes", "printer", "materials", "print", "settings", "protect", "azimuth"}, "");
  const std::string protect = text_at(json, "protect");
  const auto level = protect.empty() ? ProtectionLevel{} : protection_level(protect);
  if (!level) throw wrong(fmt::format("protect: '{}' is none of none, rampart, full", protect), "protect");
  JobRequest request;
  request.meshes = meshes_at(json);
  request.config = config_at(json, own, *level);
  request.azimuth_deg = azimuth_at(json, *level);
  const std::size_t extruders = request.config.extruders.size();
  for (const JobMesh& mesh : request.meshes)
    if (mesh.extruder && std::size_t(*mesh.extruder) >= extruders)
      throw wrong(fmt::format("meshes: the printer has no extruder {}; it has {}", *mesh.extruder + 1, extruders),
                  "meshes");
  return request;
}

}  // namespace cleancolor
