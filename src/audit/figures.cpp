#include "audit/figures.hpp"

#include <algorithm>

namespace cleancolor {

Figures& Figures::operator+=(const Figures& other) {
  constexpr std::array all = {&Figures::smear_exposure_travel,
                              &Figures::smear_exposure_print,
                              &Figures::smear_exposure_travel_visible,
                              &Figures::smear_exposure_print_visible,
                              &Figures::inner_exposure_travel,
                              &Figures::inner_exposure_print,
                              &Figures::smear_volume_travel,
                              &Figures::smear_volume_print,
                              &Figures::inner_volume_travel,
                              &Figures::inner_volume_print,
                              &Figures::own_volume,
                              &Figures::hole_volume,
                              &Figures::zippers,
                              &Figures::zippers_visible,
                              &Figures::wipes,
                              &Figures::wiped_volume,
                              &Figures::refills,
                              &Figures::refill_volume,
                              &Figures::tool_changes};
  static_assert(sizeof(Figures) == all.size() * sizeof(double), "every figure is summed");
  for (const auto figure : all) this->*figure += other.*figure;
  return *this;
}

namespace {

using F = const Figures&;

constexpr std::array<FigureInfo, 21> table = {{
    {"smear_volume", "mm3", "ooze left on visible plastic of another colour, times how visible it is",
     [](F f) { return f.smear_volume(); }, true},
    {"smear_volume_travel", "mm3", "of it while no nozzle extrudes", [](F f) { return f.smear_volume_travel; }, true},
    {"smear_volume_print", "mm3", "and while another nozzle extrudes", [](F f) { return f.smear_volume_print; }, true},
    {"hole_volume", "mm3", "plastic missing from outer walls, times how visible they are",
     [](F f) { return f.hole_volume; }, true},
    {"zippers", "1", "starts and ends of extrusion on outer walls", [](F f) { return f.zippers; }, true},
    {"zippers_visible", "1", "the same, each as visible as it is", [](F f) { return f.zippers_visible; }, true},
    {"smear_exposure_travel", "mm",
     "way of idle nozzles over visible plastic of another colour while no nozzle extrudes",
     [](F f) { return f.smear_exposure_travel; }, true},
    {"smear_exposure_print", "mm", "and while another nozzle extrudes", [](F f) { return f.smear_exposure_print; },
     true},
    {"smear_exposure_travel_visible", "mm", "smear_exposure_travel, every mm times how visible it is",
     [](F f) { return f.smear_exposure_travel_visible; }},
    {"smear_exposure_print_visible", "mm", "smear_exposure_print, likewise",
     [](F f) { return f.smear_exposure_print_visible; }},
    {"inner_exposure_travel", "mm",
     "way of idle nozzles over hidden plastic of another colour while no nozzle extrudes",
     [](F f) { return f.inner_exposure_travel; }},
    {"inner_exposure_print", "mm", "and while another nozzle extrudes", [](F f) { return f.inner_exposure_print; }},
    {"inner_volume", "mm3",
     "ooze left on another colour where it is hidden; it matters where the plastic is translucent",
     [](F f) { return f.inner_volume(); }, true},
    {"inner_volume_travel", "mm3", "of it while no nozzle extrudes", [](F f) { return f.inner_volume_travel; }},
    {"inner_volume_print", "mm3", "and while another nozzle extrudes", [](F f) { return f.inner_volume_print; }},
    {"own_volume", "mm3", "ooze left on visible plastic of the nozzle's own colour, times how visible it is",
     [](F f) { return f.own_volume; }, true},
    {"wipes", "1", "crossings of shield, tower or skirt by a nozzle that carries ooze", [](F f) { return f.wipes; },
     true},
    {"wiped_volume", "mm3", "ooze left there", [](F f) { return f.wiped_volume; }, true},
    {"refills", "1", "refill passes", [](F f) { return f.refills; }},
    {"refill_volume", "mm3", "plastic pushed in them", [](F f) { return f.refill_volume; }},
    {"tool_changes", "1", "changes of the nozzle in use", [](F f) { return f.tool_changes; }, true},
}};

}  // namespace

std::span<const FigureInfo> figure_table() {
  return table;
}

const FigureInfo* find_figure(std::string_view name) {
  const auto found = std::ranges::find(table, name, &FigureInfo::name);
  return found == table.end() ? nullptr : &*found;
}

}  // namespace cleancolor
