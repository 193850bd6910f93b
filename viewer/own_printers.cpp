#include "viewer/own_printers.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "model/settings.hpp"
#include "viewer/api_error.hpp"
#include "viewer/option_json.hpp"

namespace cleancolor {
namespace {

void require_built_in(OptionGroup group, const std::string& profile, std::string_view key, const std::string& name) {
  if (!profile.empty() && !is_built_in(group, profile))
    throw Error(fmt::format("{}: {}: there is no built-in {} '{}'", name, key, group_name(group), profile));
}

OwnPrinterHandle own_printer(const std::string& name, Profile profile, PrinterRow row) {
  profile.name = name;
  std::string text = printer_row(profile, row);
  return std::make_shared<const OwnPrinter>(OwnPrinter{std::move(profile), std::move(text)});
}

}  // namespace

OwnPrinters::OwnPrinters(const std::string& given) : given_(given) {
  if (given.empty() || is_built_in(OptionGroup::printer, given)) return;
  printers_[given] = own_printer(given, find_profile(OptionGroup::printer, given), {.chosen = true});
}

OwnPrinterHandle OwnPrinters::find(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = printers_.find(name);
  return found == printers_.end() ? nullptr : found->second;
}

std::vector<OwnPrinterHandle> OwnPrinters::all() const {
  std::vector<OwnPrinterHandle> all;
  const std::lock_guard lock(mutex_);
  for (const auto& [name, printer] : printers_) all.push_back(printer);
  return all;
}

void OwnPrinters::keep(const std::string& name, const std::string& toml) {
  if (name == given_)
    throw ApiError(400, fmt::format("{}: --printer names this one already; give the file another name", name),
                   "printer");
  OwnPrinterHandle printer;
  try {
    printer = own_printer(name, check_printer(toml, name), {.sent = true});
  } catch (const Error& e) {
    throw ApiError(400, e.what(), "printer");
  }
  const std::lock_guard lock(mutex_);
  if (printers_.size() >= most && !printers_.contains(name))
    throw ApiError(503, fmt::format("there are {} printers already; forget one", most));
  printers_[name].swap(printer);  // the one before goes when the lock is free
}

bool OwnPrinters::forget(const std::string& name) {
  if (name == given_) return false;
  const std::lock_guard lock(mutex_);
  return printers_.erase(name) > 0;
}

Profile check_printer(const std::string& toml, const std::string& name) {
  if (!name.ends_with(".toml")) throw Error(fmt::format("{}: the name of a printer's profile ends in .toml", name));
  Profile profile = read_profile(OptionGroup::printer, toml, name, Inherits::built_in);
  if (profile.settings.empty()) throw Error(fmt::format("{}: no option of a printer is in it", name));
  require_built_in(OptionGroup::material, profile.default_material, "default_material", name);
  require_built_in(OptionGroup::print, profile.default_print, "default_print", name);
  (void)with_profile(Config{}, profile);  // what is wrong by itself is told with its line
  try {
    (void)config_of(profile, {});
  } catch (const Error& e) {
    throw Error(fmt::format("{}: {}", name, e.what()));
  }
  return profile;
}

}  // namespace cleancolor
