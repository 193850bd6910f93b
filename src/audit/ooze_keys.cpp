#include "audit/ooze_keys.hpp"

#include <algorithm>
#include <array>

namespace cleancolor {
namespace {

using P = const OozeParameters&;
using Q = OozeParameters&;

constexpr std::array<OozeKey, 8> ooze_key_table = {{
    {.name = "volume",
     .field_name = "volume_mm3",
     .unit = "mm3",
     .help = "V: what leaves an idle nozzle in the end",
     .of = [](P p) { return p.volume_mm3; },
     .set = [](Q p, double v) { p.volume_mm3 = v; }},
    {.name = "time",
     .field_name = "time_s",
     .unit = "s",
     .help = "tau: after which 63 % of it have left",
     .of = [](P p) { return p.time_s; },
     .set = [](Q p, double v) { p.time_s = v; },
     .may_be_zero = false},
    {.name = "missing_is_spent",
     .field_name = "missing_is_spent",
     .unit = "",
     .help = "1: what is missing in a nozzle cannot flow out again; 0: it is always full",
     .of = [](P p) { return p.missing_is_spent ? 1.0 : 0.0; },
     .set = [](Q p, double v) { p.missing_is_spent = v != 0; }},
    {.name = "elastic_time",
     .field_name = "elastic_time_s",
     .unit = "s",
     .help = "K: pressure advance; a nozzle that stops still holds K x flow under pressure; 0: none",
     .of = [](P p) { return p.elastic_time_s; },
     .set = [](Q p, double v) { p.elastic_time_s = v; }},
    {.name = "halving",
     .field_name = "halving_c",
     .unit = "degrees C",
     .help = "so much cooler, half the ooze; 0: temperature does not matter",
     .of = [](P p) { return p.halving_c; },
     .set = [](Q p, double v) { p.halving_c = v; }},
    {.name = "heating",
     .field_name = "heating_c_s",
     .unit = "degrees C/s",
     .help = "how fast the heater warms",
     .of = [](P p) { return p.heating_c_s; },
     .set = [](Q p, double v) { p.heating_c_s = v; },
     .may_be_zero = false},
    {.name = "cooling",
     .field_name = "cooling_c_s",
     .unit = "degrees C/s",
     .help = "how fast a nozzle cools",
     .of = [](P p) { return p.cooling_c_s; },
     .set = [](Q p, double v) { p.cooling_c_s = v; },
     .may_be_zero = false},
    {.name = "touch_height",
     .field_name = "touch_height_mm",
     .unit = "mm",
     .help = "a nozzle lifted by more touches nothing; inf: one that is lifted still touches",
     .of = [](P p) { return p.touch_height_mm; },
     .set = [](Q p, double v) { p.touch_height_mm = v; },
     .may_be_infinite = true},
}};

}  // namespace

std::span<const OozeKey> ooze_keys() {
  return ooze_key_table;
}

const OozeKey* find_ooze_key(std::string_view name) {
  const auto found = std::ranges::find(ooze_key_table, name, &OozeKey::name);
  return found == ooze_key_table.end() ? nullptr : &*found;
}

}  // namespace cleancolor
