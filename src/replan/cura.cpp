#include "replan/cura.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>

#include "base/error.hpp"
#include "printed/printed_layer.hpp"

namespace cleancolor {
namespace {

constexpr double least_wall_mm = 0.2, most_wall_mm = 2.5;  // what nozzles print
constexpr double least_retracted_mm = 0.5, most_retracted_mm = 5;
constexpr double seldom = 0.02;       // share of what is drawn back
constexpr double ironing_flow = 0.3;  // of skins: share of the flow of outer walls

/// Values in steps, each with its weight.
class Frequent {
 public:
  explicit Frequent(double step) : step_(step) {}

  void add(double value, double weight = 1) { weights_[std::llround(value / step_)] += weight; }
  bool empty() const { return weights_.empty(); }
  double value_or(double otherwise) const {
    if (empty()) return otherwise;
    const auto heavier = [](const auto& a, const auto& b) { return a.second < b.second; };
    return double(std::ranges::max_element(weights_, heavier)->first) * step_;
  }

 private:
  double step_;
  std::map<long long, double> weights_;
};

/// What one tool does when it stops printing.
struct RetractionHabits {
  Frequent back_mm{0.001}, back_at_change_mm{0.001}, back_mm_s{0.01}, forward_mm_s{0.01}, lift_mm{0.001};
  std::size_t drawn_back = 0, lifted = 0;
  double shortest_way_mm = INFINITY;  // that filament was drawn back for
};

/// What lies between two roads of a layer, or of two.
struct TravelBetween {
  double back_mm = 0;  // at most
  double way_mm = 0, lift_mm = 0;
  double now_back_mm = 0;
  int tool = 0;
};

class Reading {
 public:
  explicit Reading(const GcodePrint& print) : print_(print), habits_(std::size_t(max_tools)) {
    std::optional<std::size_t> road;
    for (std::size_t i = 1; i < print.moves.size(); ++i) {
      if (lays_plastic(print, i)) {
        if (road) end_gap(*road, i);
        add_road(i);
        road = i;
        gap_ = {.tool = print.moves[i].tool};
      } else if (road) {
        add_other(i);
      }
    }
  }

  double width_mm(Role role, double otherwise) const { return of(width_mm_, role, otherwise); }
  double speed_mm_s(Role role, double otherwise) const { return of(speed_mm_s_, role, otherwise); }
  double first_speed_mm_s(double otherwise) const { return first_mm_s_.value_or(otherwise); }
  const Frequent& travel_mm_s() const { return travel_mm_s_; }
  const Frequent& z_mm_s() const { return z_mm_s_; }
  const RetractionHabits& habits(std::size_t tool) const { return habits_[tool]; }
  std::size_t backs_at_layers() const { return backs_at_layers_; }
  bool begins_with_outer_walls() const { return outer_first_ > 0; }

 private:
  static double of(const std::map<Role, Frequent>& all, Role role, double otherwise) {
    const auto found = all.find(role);
    return found == all.end() ? otherwise : found->second.value_or(otherwise);
  }

  /// In each layer and tool that has inner and outer walls: which of them comes first.
  void add_wall(const GcodeMove& move) {
    const bool is_outer = move.role == Role::external_perimeter;
    if (!is_outer && move.role != Role::perimeter) return;
    if (move.layer != walls_layer_ || move.tool != walls_tool_) {
      walls_layer_ = move.layer, walls_tool_ = move.tool;
      first_is_outer_ = is_outer;
      has_voted_ = false;
    } else if (is_outer != first_is_outer_ && !has_voted_) {
      has_voted_ = true;
      outer_first_ += first_is_outer_ ? 1 : -1;
    }
  }

  void add_road(std::size_t i) {
    const GcodeMove& move = print_.moves[i];
    add_wall(move);
    const double mm = way_mm(print_, i);
    width_mm_.try_emplace(move.role, 0.01).first->second.add(road_width_mm(move), mm);
    speed_mm_s_.try_emplace(move.role, 0.01).first->second.add(move.speed_mm_s, mm);
    if (move.layer == 0 && is_wall(move.role)) first_mm_s_.add(move.speed_mm_s, mm);
  }

  void add_other(std::size_t i) {
    const GcodeMove& move = print_.moves[i];
    const double mm = way_mm(print_, i), rise = move.to_mm.z - print_.moves[i - 1].to_mm.z;
    gap_.way_mm += mm;
    gap_.lift_mm = std::max(gap_.lift_mm, rise);
    if (move.tool == gap_.tool) gap_.now_back_mm -= move.filament_mm;
    gap_.back_mm = std::max(gap_.back_mm, gap_.now_back_mm);
    if (move.filament_mm < 0) habits_[move.tool].back_mm_s.add(move.speed_mm_s);
    if (move.filament_mm > 0) habits_[move.tool].forward_mm_s.add(move.speed_mm_s);
    if (move.filament_mm != 0) return;
    if (mm > 0 && rise == 0) travel_mm_s_.add(move.speed_mm_s, mm);
    if (rise != 0) z_mm_s_.add(move.speed_mm_s);
  }

  void end_gap(std::size_t before, std::size_t after) {
    const GcodeMove &from = print_.moves[before], &to = print_.moves[after];
    RetractionHabits& h = habits_[from.tool];
    if (from.tool != to.tool) {
      h.back_at_change_mm.add(gap_.back_mm);
    } else if (from.to_mm.z == to.to_mm.z && gap_.back_mm > 0) {
      ++h.drawn_back;
      h.back_mm.add(gap_.back_mm);
      h.shortest_way_mm = std::min(h.shortest_way_mm, gap_.way_mm);
      if (gap_.lift_mm > 0) ++h.lifted, h.lift_mm.add(gap_.lift_mm);
    } else if (gap_.back_mm > 0) {
      ++backs_at_layers_;
      h.back_mm.add(gap_.back_mm);
    }
  }

  const GcodePrint& print_;
  std::map<Role, Frequent> width_mm_, speed_mm_s_;
  Frequent first_mm_s_{0.01}, travel_mm_s_{0.01}, z_mm_s_{0.01};
  std::vector<RetractionHabits> habits_;
  std::size_t backs_at_layers_ = 0;
  std::uint32_t walls_layer_ = ~std::uint32_t{0};
  std::uint8_t walls_tool_ = 0;
  bool first_is_outer_ = false, has_voted_ = false;
  int outer_first_ = 0;
  TravelBetween gap_;
};

std::vector<Vec2> used_bed_mm(const GcodePrint& print, const AuditMachine& machine) {
  Box<Vec2> box;
  for (std::size_t i = 0; i < print.moves.size(); ++i)
    if (lays_plastic(print, i)) {
      const GcodeMove& move = print.moves[i];
      box.add(plastic_mm(machine, {move.to_mm.x, move.to_mm.y}, move.tool));
    }
  const Vec2 free{cura_free_mm, cura_free_mm}, min = box.min - free, max = box.max + free;
  return {min, {max.x, min.y}, max, {min.x, max.y}};
}

LengthOrShare length(double mm) {
  return {mm, false};
}

void take_habits(Extruder& extruder, const RetractionHabits& habits, double nozzle_mm) {
  extruder.nozzle_diameter_mm = nozzle_mm;
  extruder.retract_length_mm = habits.back_mm.value_or(0);
  extruder.retract_length_toolchange_mm = habits.back_at_change_mm.value_or(extruder.retract_length_mm);
  extruder.retract_speed_mm_s = habits.back_mm_s.value_or(extruder.retract_speed_mm_s);
  extruder.deretract_speed_mm_s = habits.forward_mm_s.value_or(0);
  if (std::isfinite(habits.shortest_way_mm))
    extruder.retract_before_travel_mm = std::clamp(habits.shortest_way_mm, least_retracted_mm, most_retracted_mm);
  // Over what it has printed only, or everywhere: where it lifts at all, it may.
  const bool lifts = double(habits.lifted) > seldom * double(habits.drawn_back);
  extruder.retract_lift_mm = lifts ? habits.lift_mm.value_or(0) : 0;
  extruder.retract_restart_extra_mm = extruder.retract_restart_extra_toolchange_mm = 0;
  extruder.extrusion_multiplier = 1;
}

}  // namespace

Config cura_config(const GcodePrint& print, const AuditMachine& machine, const Config* printer) {
  if (print.facts.volumetric_e)
    throw Error(
        fmt::format("{}: E in mm3 is not re-planned yet; choose another G-code flavour in the slicer", print.name));
  const Reading reading(print);
  const double outer_mm = reading.width_mm(Role::external_perimeter, 0);
  const double height_mm = print.layers[print.layers.size() / 2].height_mm;
  if (outer_mm < std::max(least_wall_mm, height_mm) || outer_mm > most_wall_mm)
    throw Error(
        fmt::format("{}: with filament of {:g} mm its outer walls would be {:.2f} mm wide; the file does not "
                    "say how thick its filament is: export it for filament of 1.75 mm, or put '; "
                    "filament_diameter = 2.85' into the start code",
                    print.name, machine.nozzles.front().filament_diameter_mm, outer_mm));
  if (reading.travel_mm_s().empty())
    throw Error(fmt::format("{}: it never travels, so nothing tells how fast; there is nothing to plan", print.name));
  Config config = printer != nullptr ? *printer : Config{};
  if (printer == nullptr) config.bed_shape_mm = used_bed_mm(print, machine);
  config.travel_speed_mm_s = reading.travel_mm_s().value_or(config.travel_speed_mm_s);
  config.travel_speed_z_mm_s = reading.z_mm_s().value_or(0);
  config.first_layer_height_mm = print.layers.front().height_mm;
  config.external_perimeters_first = reading.begins_with_outer_walls();
  config.layer_height_mm = height_mm;
  config.first_layer_extrusion_width = config.extrusion_width = length(0);
  config.external_perimeter_extrusion_width = length(outer_mm);
  config.perimeter_extrusion_width = length(reading.width_mm(Role::perimeter, outer_mm));
  config.infill_extrusion_width = length(reading.width_mm(Role::internal_infill, outer_mm));
  config.solid_infill_extrusion_width = length(reading.width_mm(Role::solid_infill, outer_mm));
  config.top_infill_extrusion_width = config.solid_infill_extrusion_width;
  const double outer_mm_s = reading.speed_mm_s(Role::external_perimeter, config.perimeter_speed_mm_s);
  config.perimeter_speed_mm_s = reading.speed_mm_s(Role::perimeter, outer_mm_s);
  config.external_perimeter_speed = length(outer_mm_s);
  config.infill_speed_mm_s = reading.speed_mm_s(Role::internal_infill, config.perimeter_speed_mm_s);
  const double solid_mm_s = reading.speed_mm_s(Role::solid_infill, config.infill_speed_mm_s);
  config.solid_infill_speed = config.top_solid_infill_speed = length(solid_mm_s);
  config.first_layer_speed = length(reading.first_speed_mm_s(outer_mm_s));
  while (config.extruders.size() < machine.nozzles.size()) config.extruders.push_back(config.extruders.back());
  for (std::size_t n = 0; n < machine.nozzles.size(); ++n) {
    Extruder& e = config.extruders[n];
    take_habits(e, reading.habits(n), printer != nullptr ? e.nozzle_diameter_mm : outer_mm);
    e.filament_diameter_mm = machine.nozzles[n].filament_diameter_mm;
    e.retract_layer_change = reading.backs_at_layers() > 0;
  }
  return config;
}

std::optional<GcodePrint> with_ironing(const GcodePrint& print) {
  const auto flow_of = [&](std::size_t i) {  // of filament, for each mm of way and of height
    return print.moves[i].filament_mm / way_mm(print, i) / double(print.moves[i].height_mm);
  };
  Frequent wall_flow(0.001);
  for (std::size_t i = 1; i < print.moves.size(); ++i)
    if (print.moves[i].role == Role::external_perimeter && lays_plastic(print, i)) wall_flow.add(flow_of(i));
  const double least = ironing_flow * wall_flow.value_or(0);
  std::optional<GcodePrint> result;
  for (std::size_t i = 1; i < print.moves.size(); ++i) {
    if (print.moves[i].role != Role::solid_infill || !lays_plastic(print, i) || flow_of(i) >= least) continue;
    if (!result) result = print;
    result->moves[i].role = Role::ironing;
  }
  return result;
}

}  // namespace cleancolor
