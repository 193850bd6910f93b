// audit/ooze_keys.hpp
//
// The numbers of OozeParameters by name: one table for --ooze, reports and docs.
#pragma once

#include <span>
#include <string_view>

#include "audit/ooze.hpp"

namespace cleancolor {

struct OozeKey {
  std::string_view name;        // "volume", as in --ooze volume=2
  std::string_view field_name;  // "volume_mm3", as in JSON
  std::string_view unit;        // "mm3"; empty for yes or no
  std::string_view help;        // one line
  double (*of)(const OozeParameters&);
  void (*set)(OozeParameters&, double);
  bool may_be_zero = true;
  bool may_be_infinite = false;
};

/// In the order in which they are shown.
std::span<const OozeKey> ooze_keys();

/// nullptr where there is none of this name.
const OozeKey* find_ooze_key(std::string_view name);

}  // namespace cleancolor
