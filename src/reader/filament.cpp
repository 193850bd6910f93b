#include "reader/filament.hpp"

#include <algorithm>
#include <numbers>

#include "model/text_scan.hpp"

namespace cleancolor {
namespace {

constexpr double usual_diameter_mm = 1.75;
constexpr double usual_retraction_mm = 1;

double circle_area(double diameter) {
  return std::numbers::pi / 4 * diameter * diameter;
}

/// The values of a list by tool; those that are not told repeat the last one.
std::array<double, max_tools> by_tool(std::string_view list, double usual) {
  std::array<double, max_tools> values;
  double last = usual;
  for (double& value : values) {
    const std::size_t stop = std::min(list.find_first_of(",;"), list.size());
    if (const auto told = number<double>(list.substr(0, stop)); told && *told >= 0 && *told < 100) last = *told;
    list.remove_prefix(std::min(stop + 1, list.size()));
    value = last;
  }
  return values;
}

}  // namespace

FilamentCounts::FilamentCounts(const GcodeFacts& facts) : volumetric_(facts.volumetric_e) {
  const std::vector<double>& diameters = facts.filament_diameter_mm;
  for (std::size_t t = 0; t < max_tools; ++t)
    area_mm2_[t] = circle_area(diameters.empty() ? usual_diameter_mm : diameters[std::min(t, diameters.size() - 1)]);
  std::string_view retraction = last_value(facts, "retract_length");
  if (retraction.empty()) retraction = last_value(facts, "retraction_length");  // OrcaSlicer
  retraction_mm_ = by_tool(retraction, usual_retraction_mm);
  const std::string_view flavour = last_value(facts, "gcode_flavor");
  follows_g91_ = flavour != "klipper" && flavour != "reprapfirmware" && flavour != "sailfish" && flavour != "makerware";
}

void FilamentCounts::m82_or_m83(bool relative) {
  by_m83_ = relative;
  by_g91_ = false;
}

void FilamentCounts::g90_or_g91(bool relative) {
  by_g91_ = relative;
}

void FilamentCounts::one_for_each_tool(int tool_in_use) {
  if (!each_tool_) std::swap(count_mm_[0], count_mm_[std::size_t(tool_in_use)]);
  each_tool_ = true;
  follows_g91_ = false;
}

void FilamentCounts::set(int tool, double count_mm) {
  count_mm_[each_tool_ ? std::size_t(tool) : 0] = count_mm;
}

double FilamentCounts::pushed_mm(int tool, double told_mm) {
  double& count = count_mm_[each_tool_ ? std::size_t(tool) : 0];
  const bool relative = by_m83_ || (by_g91_ && follows_g91_);
  const double pushed = relative ? told_mm : told_mm - count;
  count = relative ? count + told_mm : told_mm;
  return volumetric_ ? pushed / area_mm2_[std::size_t(tool)] : pushed;
}

void FilamentCounts::volumetric(int tool, double diameter_mm) {
  volumetric_ = diameter_mm > 0;
  if (volumetric_) area_mm2_[std::size_t(tool)] = circle_area(diameter_mm);
}

double FilamentCounts::drawn_back_mm(int tool, bool back) {
  const auto t = std::size_t(tool);
  if (is_drawn_back_[t] == back) return 0;
  is_drawn_back_[t] = back;
  return back ? -retraction_mm_[t] : retraction_mm_[t] + extra_mm_;
}

}  // namespace cleancolor
