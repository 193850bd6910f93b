// The class itself, and what is written for every layer. Start and end of the file: print_ends.cpp.

#include "gcode/writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <span>

#include "base/output_file.hpp"
#include "gcode/print.hpp"
#include "model/motion_limits.hpp"

namespace cleancolor {
namespace {

bool is_bridge(Role role) {
  return role == Role::bridge_infill || role == Role::overhang_perimeter;
}

bool is_perimeter(Role role) {
  return role == Role::perimeter || role == Role::external_perimeter;
}

bool is_infill(Role role) {
  return role == Role::internal_infill || role == Role::solid_infill || role == Role::top_solid_infill;
}

double road_acceleration_mm_s2(const Config& c, Role role, int layer) {
  const auto chosen = [&](double special) { return special > 0 ? special : c.default_acceleration_mm_s2; };
  if (layer == 0 && c.first_layer_acceleration_mm_s2 > 0) return c.first_layer_acceleration_mm_s2;
  if (is_bridge(role)) return chosen(c.bridge_acceleration_mm_s2);
  if (is_perimeter(role)) return chosen(c.perimeter_acceleration_mm_s2);
  if (is_infill(role)) return chosen(c.infill_acceleration_mm_s2);
  return c.default_acceleration_mm_s2;
}

/// The speed at which no more is melted than the print and the filament allow.
double road_speed_mm_s(const Config& c, const Extruder& e, const Road& road) {
  double speed = road.speed_mm_s;
  const double area = road.area_mm2 * e.extrusion_multiplier;
  for (const double limit : {c.max_volumetric_speed_mm3_s, e.filament_max_volumetric_speed_mm3_s})
    if (limit > 0 && area > 0) speed = std::min(speed, limit / area);
  return speed;
}

}  // namespace

double filament_area_mm2(const Extruder& e) {
  return std::numbers::pi / 4 * e.filament_diameter_mm * e.filament_diameter_mm;
}

GcodeWriter::Print::Print(const Config& c, PrintInfo i, Sink sink)
    : config(c),
      info(std::move(i)),
      text(std::move(sink)),
      clock(motion_limits(config)),
      machine(config, text, clock),
      placeholders(config) {
  assert(info.last_layer.size() == config.extruders.size());
  assert(!words(config.gcode_flavor).e_per_tool || config.extruders.size() <= words(config.gcode_flavor).e_axes.size());
  for (const auto& last : info.last_layer) heated.push_back(last.has_value());
  // A name must not end its comment and become G-code.
  std::replace_if(info.name.begin(), info.name.end(), [](char k) { return k >= 0 && k < ' '; }, '_');
}

void GcodeWriter::Print::layer(const Layer& layer) {
  if (!started) start(layer);
  if (layers_written == 1) first_layer_end = clock.mark();
  placeholders.set("layer_num", layer.index);
  placeholders.set("layer_z", layer.print_z_mm);

  text.line(";LAYER_CHANGE");
  text.line(fmt::format(";Z:{}", number_text(layer.print_z_mm)));
  text.line(fmt::format(";HEIGHT:{}", number_text(layer.height_mm)));
  height_mm = layer.height_mm;
  custom(config.before_layer_gcode, "before_layer_gcode");
  turn_off_finished(layer, 0);
  if (layers_written == 1) later_temperatures();
  if (!layer.paths.empty()) {
    const Extruder& e = config.extruders[std::size_t(machine.tool())];
    if (e.retract_layer_change || layers_written == 0) draw_back();
    machine.set_z(layer.print_z_mm);
  }
  custom(config.layer_gcode, "layer_gcode");
  machine.shorten_count();
  for (std::size_t i = 0; i < layer.paths.size(); ++i) {
    if (layer.paths[i].extruder != machine.tool()) change_tool(layer, i);
    path(layer, layer.paths[i]);
  }
  ++layers_written;
}

void GcodeWriter::Print::draw_back() {
  const Extruder& e = config.extruders[std::size_t(machine.tool())];
  machine.retract(e.retract_length_mm, e.retract_restart_extra_mm);
  if (e.retract_lift_mm > 0 && layers_written > 0) machine.lift(e.retract_lift_mm);
}

void GcodeWriter::Print::path(const Layer& layer, const Path& path) {
  const Extruder& e = config.extruders[std::size_t(path.extruder)];
  lay_out(path, config.gcode_resolution_mm, config.seam_gap_distance.of(e.nozzle_diameter_mm), polyline);
  if (polyline.points.size() < 2) return;
  travel(path);
  machine.lower();
  machine.unretract();

  const bool refills = path.road().role == Role::refill;
  Machine::Feed feed{};
  std::size_t next = 0;
  for (std::size_t i = 0; i + 1 < polyline.points.size(); ++i) {
    if (next < polyline.stretches.size() && polyline.stretches[next].first_segment <= i)
      feed = begin_road(layer, e, polyline.stretches[next++].road);
    if (refills && i == 0) text.line(";REFILL_START");
    machine.extrude(polyline.points[i + 1], feed);
  }
  if (refills) text.line(";REFILL_END");
  progress_mark();
}

void GcodeWriter::Print::travel(const Path& path) {
  const Extruder& e = config.extruders[std::size_t(path.extruder)];
  double length = 0;
  Vec2 from = machine.position_mm();
  for (const Vec2 p : path.travel) length += distance(from, p), from = p;
  length += distance(from, path.start());
  // Half a micrometre of rounding must not decide.
  const bool there_already = machine.position_known() && length < 1e-3;
  const bool far = !machine.position_known() || length > e.retract_before_travel_mm - 1e-3;
  if (far && !there_already) draw_back();
  for (const Vec2 p : path.travel) machine.travel(p);
  machine.travel(path.start());
}

Machine::Feed GcodeWriter::Print::begin_road(const Layer& layer, const Extruder& e, const Road& road) {
  if (role != road.role) {
    role = road.role;
    text.line(fmt::format(";TYPE:{}", role_name(road.role)));
    if (road.role == Role::rampart) text.line(";RAMPART_WALL");  // viewers of others know no such type
  }
  if (width_mm != road.width_mm) {
    width_mm = road.width_mm;
    text.line(fmt::format(";WIDTH:{}", number_text(road.width_mm)));
  }
  if (height_mm != road.height_mm) {
    height_mm = road.height_mm;
    text.line(fmt::format(";HEIGHT:{}", number_text(road.height_mm)));
  }

  const auto tool = std::size_t(machine.tool());
  double fan = tool < layer.fan_by_extruder.size() ? layer.fan_by_extruder[tool] : 0;
  if (is_bridge(road.role) && e.cooling && layer.index >= e.disable_fan_first_layers)
    fan = std::max(fan, e.bridge_fan_speed_percent / 100.0);
  machine.set_fan(fan);
  machine.set_acceleration(road_acceleration_mm_s2(config, road.role, layer.index));
  return {.speed_mm_s = road_speed_mm_s(config, e, road),
          .filament_per_mm = road.area_mm2 * e.extrusion_multiplier / filament_area_mm2(e)};
}

void GcodeWriter::Print::change_tool(const Layer& layer, std::size_t first_path) {
  const int before = machine.tool();
  const int next = layer.paths[first_path].extruder;
  const Extruder& e = config.extruders[std::size_t(before)];
  machine.retract(e.retract_length_toolchange_mm, e.retract_restart_extra_toolchange_mm);
  if (e.retract_lift_mm > 0) machine.lift(e.retract_lift_mm);
  ++tool_changes;

  custom(e.end_filament_gcode, "end_filament_gcode");
  set_tools(before, next);
  placeholders.set("toolchange_z", layer.print_z_mm);
  const std::string code = placeholders.filled_in(config.toolchange_gcode, "toolchange_gcode");
  machine.select(next, code, selects(code, next));
  placeholders.set_current_extruder(next);
  custom(config.extruders[std::size_t(next)].start_filament_gcode, "start_filament_gcode");
  turn_off_finished(layer, first_path);
}

void GcodeWriter::Print::turn_off_finished(const Layer& layer, std::size_t from_path) {
  if (!config.heater_off_after_last_use) return;
  for (std::size_t t = 0; t < heated.size(); ++t) {
    if (!heated[t] || int(t) == machine.tool() || layer.index < *info.last_layer[t]) continue;
    const auto rest = std::span(layer.paths).subspan(from_path);
    if (std::any_of(rest.begin(), rest.end(), [&](const Path& p) { return p.extruder == int(t); })) continue;
    machine.set_nozzle(int(t), 0, false);
    heated[t] = false;
  }
}

void GcodeWriter::Print::later_temperatures() {
  for (std::size_t t = 0; t < config.extruders.size(); ++t) {
    const Extruder& e = config.extruders[t];
    if (heated[t] && e.temperature_c != e.first_layer_temperature_c) machine.set_nozzle(int(t), e.temperature_c, false);
  }
  const Extruder& bed = config.extruders[std::size_t(info.bed_extruder)];
  if (bed.bed_temperature_c != bed.first_layer_bed_temperature_c) machine.set_bed(bed.bed_temperature_c, false);
}

void GcodeWriter::Print::custom(std::string_view code, std::string_view option_name) {
  if (!code.empty()) machine.custom(placeholders.filled_in(code, option_name));
}

GcodeWriter::GcodeWriter(const Config& config, PrintInfo info, Sink sink)
    : print_(std::make_unique<Print>(config, std::move(info), std::move(sink))) {}
GcodeWriter::~GcodeWriter() = default;
void GcodeWriter::layer(const Layer& layer) {
  print_->layer(layer);
}
PrintFigures GcodeWriter::finish() {
  return print_->finish();
}

Sink to_file(OutputFile& file) {
  return {.write = [&file](std::string_view bytes) { file.write(bytes); },
          .patch = [&file](std::uint64_t offset, std::string_view bytes) { file.patch(offset, bytes); }};
}

}  // namespace cleancolor
