#include "audit/audit.hpp"

namespace cleancolor {

std::vector<Scenario> scenarios(bool sensitivity) {
  std::vector<Scenario> all{
      {"worst", "idle nozzles always ooze: 2 mm3 in the end, 63 % of it within 20 s", {worst_ooze()}, {}},
      {"model", "pressure, retraction and temperature counted, and nozzles lifted off the print", {model_ooze()}, {}},
  };
  if (!sensitivity) return all;
  const auto variant = [&](const char* name, const char* help, const OozeRules& rules) {
    all.push_back({name, help, {worst_ooze()}, rules});
  };
  variant("tireless", "worst, but ooze never tires: its clock restarts at each wipe or smear", {.tireless = true});
  variant("printed_only", "worst, but only plastic already printed can be touched", {.printed_only = true});
  variant("own_does_not_empty", "worst, but plastic of the nozzle's own colour takes no ooze", {.own_empties = false});
  variant("touch_2mm", "worst, but a touch of s mm takes the share 1 - exp(-s / 2) of the ooze", {.touch_mm = 2});
  return all;
}

}  // namespace cleancolor
