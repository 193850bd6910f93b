// What a file tells of tools, temperatures and limits.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/error.hpp"
#include "model/text_scan.hpp"
#include "reader/interpreter.hpp"
#include "reader/known_commands.hpp"

namespace cleancolor {
namespace {

constexpr double most_per_s = 1e6;  // mm/s, mm/s2
constexpr double hottest_c = 1000;

/// "1" of "extruder1", 0 of "extruder": how Klipper names its tools. Nothing: this is no extruder.
std::optional<double> klipper_extruder(std::string_view arguments) {
  constexpr std::string_view extruder = "extruder";
  const std::size_t at = arguments.find(extruder);
  if (at == arguments.npos) return std::nullopt;
  std::string_view digits = arguments.substr(at + extruder.size());
  digits = digits.substr(0, std::min(digits.find_first_not_of("0123456789"), digits.size()));
  return number<double>(digits).value_or(0);
}

}  // namespace

void Interpreter::command_m(const GcodeLine& line) {
  if (line.fraction > 0 && !is_harmless(line)) return unknown(line);  // Bambu's M204.2 is not M204
  switch (line.number) {
    case 6:
    case 108:
    case 135:
      if (!line.has_value('T')) return;
      if (line.number != 6) filament_.one_for_each_tool(tool_);
      return select(checked_tool(line['T']), false);
    case 82:
    case 83:
      return filament_.m82_or_m83(line.number == 83);
    case 104:
      return temperature(line, false);
    case 109:
      return temperature(line, true);
    case 116:
    case 133:
      return wait_for_heaters(line);
    case 132:
      return forget_position(line);
    case 200:
      return volumetric(line);
    case 201:
      return limits(line, GcodeEvent::Kind::max_acceleration);
    case 203:
      return limits(line, GcodeEvent::Kind::max_speed);
    case 204:
      return accelerations(line);
    case 205:
    case 566:
      return limits(line, GcodeEvent::Kind::max_jerk);
    case 207:
      if (line.has_value('S')) filament_.set_drawn_back_mm(std::clamp(line['S'] * unit_mm_, 0.0, 100.0));
      if (line.has_value('R')) filament_.set_extra_mm(std::clamp(line['R'] * unit_mm_, -100.0, 100.0));
      return;
    case 208:
      if (line.has_value('S')) filament_.set_extra_mm(std::clamp(line['S'] * unit_mm_, -100.0, 100.0));
      return;
    case 218:
      return firmware_offset(line);
    case 220:
      if (line.has_value('S') && line['S'] > 0) speed_factor_ = std::clamp(line['S'] / 100, 0.01, 10.0);
      return;
    case 568:
      return two_temperatures(line);
    default:
      if (!is_harmless(line)) unknown(line);
  }
}

void Interpreter::command_in_words(const GcodeLine& line) {
  if (line.word.find('_') != line.word.npos) filament_.g90_is_not_about_e();  // only Klipper's are written so
  if (is_keyword(line.word, "set_velocity_limit")) {
    velocity_limit(line);
  } else if (is_keyword(line.word, "activate_extruder")) {
    if (const auto tool = klipper_extruder(line.arguments)) select(checked_tool(*tool), false);
  } else if (is_keyword(line.word, "set_heater_temperature")) {
    const auto target = word_argument(line.arguments, "TARGET");
    const auto tool = klipper_extruder(line.arguments);
    if (target && tool) heat(checked_tool(*tool), *target, false);
  } else if (is_keyword(line.word, "set_gcode_offset")) {
    // Macros that change tools use it to make up for the offsets of nozzles: positions stay those that the file tells.
  } else if (!is_harmless(line)) {
    unknown(line);
  }
}

void Interpreter::velocity_limit(const GcodeLine& line) {
  if (const auto told = word_argument(line.arguments, "ACCEL"); told && *told > 0) {
    const double value = std::min(*told, most_per_s);
    acceleration_ = {.print = value, .travel = value, .retract = acceleration_.retract};
  }
  const auto tell = [&](std::string_view key, GcodeEvent::Kind kind) {
    const auto told = word_argument(line.arguments, key);
    if (!told || !(*told > 0)) return;
    for (std::uint8_t axis = 0; axis < 2; ++axis)
      event({.kind = kind, .axis = axis, .value = std::min(*told, most_per_s)});
  };
  tell("VELOCITY", GcodeEvent::Kind::max_speed);
  tell("SQUARE_CORNER_VELOCITY", GcodeEvent::Kind::max_jerk);
}

void Interpreter::tool_word(const GcodeLine& line) {
  // T-1 of RepRapFirmware puts the tool away, T? and Tx of Prusa's MMU ask the user; Bambu's T255, T1000 and T1100
  // select nothing that prints.
  if (line.number < 0 || line.number == 255 || line.number >= 1000) return;
  select(checked_tool(line.number), line.present == 0);
}

void Interpreter::select(int tool, bool bare) {
  if (tool == tool_) return;
  const Heater &before = heaters_[std::size_t(tool_)], &now = heaters_[std::size_t(tool)];
  const int left = std::exchange(tool_, tool);
  print_.tools = std::max(print_.tools, tool + 1);
  event({.kind = GcodeEvent::Kind::tool_change, .tool = std::uint8_t(tool), .jumps = bare && print_.facts.marlin});
  if (!std::isnan(before.standby_c)) heat(left, before.standby_c, false);
  if (!std::isnan(now.in_use_c)) heat(tool, now.in_use_c, false);
}

void Interpreter::temperature(const GcodeLine& line, bool waits) {
  const double told = line.value_or('S', line.value_or('R', -1));
  const double tool = line.value_or('T', tool_);
  if (tool < 0 || tool >= max_tools) return unknown(line);
  if (told >= 0) heat(int(tool), told, waits);
}

void Interpreter::two_temperatures(const GcodeLine& line) {
  const int tool = line.has_value('P') ? checked_tool(line['P']) : tool_;
  Heater& heater = heaters_[std::size_t(tool)];
  if (line.has_value('S')) heater.in_use_c = line['S'];
  if (line.has_value('R')) heater.standby_c = line['R'];
  const double target = tool == tool_ ? heater.in_use_c : heater.standby_c;
  if ((line.has_value('S') || line.has_value('R')) && !std::isnan(target)) heat(tool, target, false);
}

void Interpreter::heat(int tool, double target_c, bool waits) {
  double& target = heaters_[std::size_t(tool)].target_c;
  target = std::clamp(target_c, 0.0, hottest_c);
  event({.kind = GcodeEvent::Kind::target_temperature, .tool = std::uint8_t(tool), .waits = waits, .value = target});
}

void Interpreter::wait_for_heaters(const GcodeLine& line) {
  const char letter = line.number == 133 ? 'T' : 'P';
  for (int tool = 0; tool < max_tools; ++tool) {
    if (line.has_value(letter) && line[letter] != tool) continue;
    if (const double target = heaters_[std::size_t(tool)].target_c; target > 0) heat(tool, target, true);
  }
}

void Interpreter::limits(const GcodeLine& line, GcodeEvent::Kind kind) {
  const bool per_minute = print_.facts.per_minute_limits && kind != GcodeEvent::Kind::max_acceleration;
  for (std::uint8_t axis = 0; axis < 4; ++axis) {
    const char letter = "XYZE"[axis];
    if (!line.has_value(letter) || !(line[letter] > 0)) continue;
    event({.kind = kind, .axis = axis, .value = std::min(line[letter] / (per_minute ? 60 : 1), most_per_s)});
  }
}

void Interpreter::accelerations(const GcodeLine& line) {
  const auto tell = [&](char letter, double& acceleration) {
    if (line.has_value(letter) && line[letter] > 0) acceleration = std::min(line[letter], most_per_s);
  };
  tell('S', acceleration_.print);
  tell('S', acceleration_.travel);
  tell('P', acceleration_.print);
  tell('T', acceleration_.travel);
  tell('R', acceleration_.retract);
}

void Interpreter::volumetric(const GcodeLine& line) {
  if (!line.has_value('D')) return;
  const int tool = line.has_value('T') ? checked_tool(line['T']) : tool_;
  const double diameter = line['D'] * unit_mm_;
  if (diameter < 0 || diameter > 10 || (diameter > 0 && diameter < 0.1))
    fail(fmt::format("a filament of {:g} mm; the file is damaged", diameter));
  filament_.volumetric(tool, diameter);
  if (diameter <= 0) return;
  // Lengths were made of volumes with these diameters: whoever makes volumes of lengths again must use the same.
  std::vector<double>& told = print_.facts.filament_diameter_mm;
  told.clear();
  for (const double area_mm2 : filament_.area_mm2()) told.push_back(2 * std::sqrt(area_mm2 / std::numbers::pi));
}

/// M218 T1 X33, or G10 P1 X33: the nozzle is 33 mm to the right of the carriage's zero.
void Interpreter::firmware_offset(const GcodeLine& line) {
  const char letter = line.letter == 'M' ? 'T' : 'P';
  if (!line.has_value(letter) || !(line.has_value('X') || line.has_value('Y'))) return;
  const auto tool = std::size_t(checked_tool(line[letter]));
  std::vector<Vec2>& offsets = print_.facts.firmware_offset_mm;
  offsets.resize(std::max(offsets.size(), tool + 1));
  Vec2& offset = offsets[tool];  // what is not named stays
  if (line.has_value('X')) offset.x = line['X'] * unit_mm_;
  if (line.has_value('Y')) offset.y = line['Y'] * unit_mm_;
  if (std::max(std::abs(offset.x), std::abs(offset.y)) > 2000) fail("a nozzle more than 2 m away; the file is damaged");
}

void Interpreter::event(GcodeEvent event) {
  event.before_move = std::uint32_t(print_.moves.size());
  event.offset = offset_;
  print_.events.push_back(event);
}

int Interpreter::checked_tool(double number) const {
  if (!(number >= 0) || number >= max_tools)
    fail(fmt::format("there is no tool {:g}; up to {} are supported, T0 to T{}", number, max_tools, max_tools - 1));
  return int(number);
}

}  // namespace cleancolor
