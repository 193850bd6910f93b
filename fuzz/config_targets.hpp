// fuzz/config_targets.hpp
//
// What the fuzz targets of profiles and configurations do with one input, also called by the test that replays seeds
// and findings.
//
// An Error is a fine answer. What is accepted must keep its promise: written out and read again, it says the same.
// Otherwise the target aborts.
#pragma once

#include <cstdlib>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "model/ini.hpp"
#include "model/profile.hpp"
#include "model/validate.hpp"

namespace cleancolor {

template <class Action>
bool accepted(const Action& action) {
  try {
    action();
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// The text as a profile of each kind.
inline void fuzz_toml(std::string_view text) {
  for (const OptionGroup group : {OptionGroup::printer, OptionGroup::material, OptionGroup::print}) {
    Config config;
    if (!accepted([&] { config = with_profile(config, read_profile(group, text, "fuzz.toml")); })) continue;
    accepted([&] { validate(config); });
    Config again;
    const std::string toml = profile_toml(config, group);
    if (!accepted([&] { again = with_profile(again, read_profile(group, toml, "again.toml")); })) std::abort();
    if (profile_toml(again, group) != toml) std::abort();
  }
}

/// The text as an .ini file and as the end of a G-code file.
inline void fuzz_ini(std::string_view text) {
  for (const auto read : {read_ini, read_gcode_config}) {
    Config config;
    if (!accepted([&] { config = with_ini(config, read(text, "fuzz.ini"), "fuzz.ini").config; })) continue;
    accepted([&] { validate(config); });
    std::string ini;
    for (const auto& [key, value] : config_block(config)) ini += key + " = " + value + "\n";
    Config again;
    if (!accepted([&] { again = with_ini(again, read_ini(ini, "again.ini"), "again.ini").config; })) std::abort();
    if (config_block(again) != config_block(config)) std::abort();
  }
}

}  // namespace cleancolor
