#include "reader/interpreter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "model/text_scan.hpp"
#include "reader/arc.hpp"
#include "reader/known_commands.hpp"

namespace cleancolor {
namespace {

constexpr double largest_mm = 10000;
constexpr std::array<char, 3> axis_letters = {'X', 'Y', 'Z'};

/// A value of the configuration block for a tool; the first one where the list is shorter.
double config_number(const GcodeFacts& facts, std::string_view key, std::size_t tool, double otherwise) {
  double found = otherwise;
  for (const IniEntry& entry : facts.config) {
    if (entry.key != key) continue;
    std::string_view values = entry.value;
    for (std::size_t i = 0; i <= tool; ++i) {
      const std::size_t comma = values.find_first_of(",;");
      if (const auto value = number<double>(values.substr(0, comma))) found = *value;
      if (comma == std::string_view::npos) break;
      values.remove_prefix(comma + 1);
    }
  }
  return found;
}

}  // namespace

Interpreter::Interpreter(GcodePrint& print) : print_(print), comments_(print.facts) {
  const std::vector<double>& told = print.facts.filament_diameter_mm;
  for (std::size_t t = 0; t < max_tools; ++t) {
    const double d = told.empty() ? 1.75 : told[std::min(t, told.size() - 1)];
    filament_area_mm2_[t] = std::numbers::pi / 4 * d * d;
  }
  volumetric_ = print.facts.volumetric_e;
  retract_mm_ = config_number(print.facts, "retract_length", 0, 1);
}

void Interpreter::fail(const std::string& what) const {
  throw Error(fmt::format("{}:{}: {}", print_.name, line_number(*print_.text, offset_), what));
}

void Interpreter::run(const GcodeLine& line, std::uint32_t offset) {
  offset_ = offset;
  if (line.has_comment) {
    if (line.letter == 0 && line.word.empty()) {
      comments_.comment(line.comment);
    } else {
      comments_.comment_behind_command(line.comment);
    }
  }
  switch (line.letter) {
    case 'G':
      command_g(line);
      break;
    case 'M':
      command_m(line);
      break;
    case 'T':
      if (line.number >= 0) {
        // Bambu's T255, T1000 and T1100 select nothing; RepRapFirmware's T-1 puts the tool away.
        if (line.number >= 255) break;
        select(checked_tool(line.number), line.present == 0, false);
      }
      break;
    case 0:
      if (!line.word.empty()) command_in_words(line);
      break;
    default:
      unknown(line);
  }
}

void Interpreter::command_g(const GcodeLine& line) {
  switch (line.number) {
    case 0:
    case 1:
      straight(line);
      break;
    case 2:
    case 3:
      arc(line);
      break;
    case 4:
      event({.kind = GcodeEvent::Kind::dwell,
             .value = std::clamp(line.value_or('P', 0) / 1000 + line.value_or('S', 0), 0.0, 1e6)});
      break;
    case 10:
      if (line.has('P') || line.has('L')) {
        if (line.has_value('P') && (line.has_value('S') || line.has_value('R'))) {
          event({.kind = GcodeEvent::Kind::target_temperature,
                 .tool = std::uint8_t(checked_tool(line['P'])),
                 .value = line.value_or('S', line.value_or('R', 0))});
        }
      } else {
        firmware_retraction(true);
      }
      break;
    case 11:
      firmware_retraction(false);
      break;
    case 20:
      unit_mm_ = 25.4;
      break;
    case 21:
      unit_mm_ = 1;
      break;
    case 18:
    case 19:
      fail("arcs in planes other than XY are not supported; switch off arc fitting for this file");
    case 28:
    case 29:
    case 161:
    case 162:
      home(line);
      break;
    case 90:
    case 91:
      relative_ = line.number == 91;
      if (!e_mode_told_) relative_e_ = relative_;
      break;
    case 92:
      set_position(line);
      break;
    default:
      if (!is_harmless(line)) unknown(line);
  }
}

void Interpreter::command_m(const GcodeLine& line) {
  switch (line.number) {
    case 82:
    case 83:
      relative_e_ = line.number == 83;
      e_mode_told_ = true;
      break;
    case 104:
      temperature(line, false);
      break;
    case 109:
      temperature(line, true);
      break;
    case 116:
    case 133:
      event({.kind = GcodeEvent::Kind::target_temperature,
             .tool = std::uint8_t(line.has_value('T') ? checked_tool(line['T']) : tool_),
             .waits = true,
             .value = -1});
      break;
    case 568:
      if (line.has_value('P') && line.has_value('S'))
        event({.kind = GcodeEvent::Kind::target_temperature,
               .tool = std::uint8_t(checked_tool(line['P'])),
               .value = line['S']});
      break;
    case 6:
      if (line.has_value('T')) select(checked_tool(line['T']), false, false);
      break;
    case 108:
    case 135:
      if (line.has_value('T')) select(checked_tool(line['T']), false, true);
      break;
    case 132:
      for (Axis& axis : axes_) axis.known = false;
      break;
    case 200:
      if (line.has_value('D')) {
        volumetric_ = line['D'] > 0;
        const std::size_t tool = std::size_t(line.has_value('T') ? checked_tool(line['T']) : tool_);
        if (volumetric_) filament_area_mm2_[tool] = std::numbers::pi / 4 * line['D'] * line['D'];
      }
      break;
    case 201:
      limits(line, GcodeEvent::Kind::max_acceleration);
      break;
    case 203:
      limits(line, GcodeEvent::Kind::max_speed);
      break;
    case 204:
      accelerations(line);
      break;
    case 205:
    case 566:
      limits(line, GcodeEvent::Kind::max_jerk);
      break;
    case 207:
      retract_mm_ = std::clamp(line.value_or('S', retract_mm_), 0.0, 100.0);
      break;
    case 218:
      if (line.has_value('T') && line['T'] >= 0 && line['T'] < max_tools) {
        auto& offsets = print_.facts.firmware_offset_mm;
        offsets.resize(std::max(offsets.size(), std::size_t(line['T']) + 1));
        offsets[std::size_t(line['T'])] = {line.value_or('X', 0) * unit_mm_, line.value_or('Y', 0) * unit_mm_};
      }
      break;
    case 220:
      if (line.has_value('S') && line['S'] > 0) speed_factor_ = std::clamp(line['S'] / 100, 0.01, 10.0);
      break;
    case 620:
    case 621:  // Bambu: "S1A", then T1 follows
      break;
    default:
      if (!is_harmless(line)) unknown(line);
  }
}

void Interpreter::command_in_words(const GcodeLine& line) {
  if (is_keyword(line.word, "set_velocity_limit")) {
    if (const auto value = word_argument(line.arguments, "ACCEL"); value && *value > 0)
      acceleration_print_ = acceleration_travel_ = *value;
    if (const auto value = word_argument(line.arguments, "VELOCITY"); value && *value > 0)
      for (const std::uint8_t axis : {std::uint8_t{0}, std::uint8_t{1}}) event({.kind = GcodeEvent::Kind::max_speed, .axis = axis, .value = *value});
  } else if (is_keyword(line.word, "activate_extruder")) {
    const std::size_t at = line.arguments.find("extruder");
    const std::size_t digits = line.arguments.find_first_of("0123456789", at == std::string_view::npos ? 0 : at);
    if (digits == std::string_view::npos) return select(0, false, false);
    std::string_view word = line.arguments.substr(digits);
    word = word.substr(0, word.find_first_not_of("0123456789"));
    select(checked_tool(number<double>(word).value_or(0)), false, false);
  } else if (is_keyword(line.word, "set_heater_temperature")) {
    const auto value = word_argument(line.arguments, "TARGET");
    const std::size_t at = line.arguments.find("extruder");
    if (!value || at == std::string_view::npos) return;
    std::string_view word = line.arguments.substr(at + 8);
    word = word.substr(0, word.find_first_not_of("0123456789"));
    event({.kind = GcodeEvent::Kind::target_temperature,
           .tool = std::uint8_t(checked_tool(number<double>(word).value_or(0))),
           .value = *value});
  } else if (is_keyword(line.word, "set_gcode_offset")) {
    // Moves the frame, not the nozzle: a macro of the printer's, which the audit is told of by the offsets.
  } else if (!is_harmless(line)) {
    unknown(line);
  }
}

double Interpreter::target_mm(const GcodeLine& line, char letter, int axis) const {
  const Axis& a = axes_[std::size_t(axis)];
  if (!line.has(letter)) return a.at_mm;
  const double value = line[letter] * unit_mm_;
  return relative_ ? a.at_mm + value : a.origin_mm + value;
}

double Interpreter::to_filament_mm(double e, int tool) const {
  return volumetric_ ? e * unit_mm_ / filament_area_mm2_[std::size_t(tool)] : e * unit_mm_;
}

double Interpreter::filament_mm(const GcodeLine& line, int& feeds) {
  double total = 0;
  const auto add = [&](char letter, int tool) {
    if (!line.has_value(letter)) return;
    double& count = count_mm_[std::size_t(tool)];
    const double value = line[letter];
    const double delta = relative_e_ ? value : value - count;
    count = relative_e_ ? count + value : value;
    if (!counts_per_tool_ && letter == 'E') count_mm_.fill(count);
    total += to_filament_mm(delta, tool);
    feeds = tool;
  };
  add('E', tool_);
  add('A', 0);
  add('B', 1);
  return total;
}

void Interpreter::straight(const GcodeLine& line) {
  constexpr std::uint32_t numbers = 1u << ('X' - 'A') | 1u << ('Y' - 'A') | 1u << ('Z' - 'A') | 1u << ('E' - 'A') |
                                    1u << ('F' - 'A') | 1u << ('I' - 'A') | 1u << ('J' - 'A') | 1u << ('R' - 'A');
  if (const std::uint32_t missing = line.present & ~line.valued & numbers; missing != 0) {
    char letter = 'A';
    while (!(missing >> (letter - 'A') & 1)) ++letter;
    const bool last = print_.text->find('\n', offset_) == std::string::npos;
    fail(fmt::format("{} has no number{}", letter,
                     last ? "; the file is cut off: export or download it again" : "; the file is damaged"));
  }
  if (line.has_value('F') && line['F'] > 0) feed_mm_s_ = std::clamp(line['F'] * unit_mm_ / 60, 0.01, 1e5);
  int feeds = tool_;
  const double filament = filament_mm(line, feeds);
  const Vec3 to = {target_mm(line, 'X', 0), target_mm(line, 'Y', 1), target_mm(line, 'Z', 2)};
  bool moves = filament != 0;
  for (int axis = 0; axis < 3; ++axis) moves = moves || line.has(axis_letters[std::size_t(axis)]);
  if (!moves) return;
  const bool known_before = axes_[0].known && axes_[1].known;
  for (int axis = 0; axis < 3; ++axis)
    if (line.has(axis_letters[std::size_t(axis)]) && !relative_) axes_[std::size_t(axis)].known = true;
  move_to(to, filament, feeds, false);
  print_.moves.back().known_start = known_before;
}

void Interpreter::arc(const GcodeLine& line) {
  if (!axes_[0].known || !axes_[1].known) return straight(line);
  Arc way{.from_mm = {axes_[0].at_mm, axes_[1].at_mm},
          .to_mm = {target_mm(line, 'X', 0), target_mm(line, 'Y', 1)},
          .clockwise = line.number == 2,
          .center_mm = std::nullopt,
          .radius_mm = line.value_or('R', 0) * unit_mm_};
  if (line.has_value('I') || line.has_value('J'))
    way.center_mm = way.from_mm + Vec2{line.value_or('I', 0), line.value_or('J', 0)} * unit_mm_;
  if (way.center_mm && std::max(std::abs(way.center_mm->x), std::abs(way.center_mm->y)) > largest_mm)
    fail("the centre of the arc is more than 10 m away; the file is damaged");
  const std::vector<ArcPoint> points = chords(way);
  if (points.empty()) return straight(line);
  if (print_.moves.size() > 1'000'000 + print_.text->size() / 4) fail("too many large arcs; the file is damaged");
  if (line.has_value('F') && line['F'] > 0) feed_mm_s_ = std::clamp(line['F'] * unit_mm_ / 60, 0.01, 1e5);
  int feeds = tool_;
  const double filament = filament_mm(line, feeds);
  const double z0 = axes_[2].at_mm, z1 = target_mm(line, 'Z', 2);
  double share = 0;
  for (const ArcPoint& p : points) {
    move_to({p.at_mm.x, p.at_mm.y, z0 + (z1 - z0) * p.share}, filament * (p.share - share), feeds, true);
    share = p.share;
  }
}

void Interpreter::move_to(Vec3 to, double filament, int feeds, bool is_arc) {
  if (std::max({std::abs(to.x), std::abs(to.y), std::abs(to.z)}) > largest_mm || std::abs(filament) > largest_mm)
    fail("this is more than 10 m away; the file is damaged");
  const bool lays = filament > 0 && (to.x != axes_[0].at_mm || to.y != axes_[1].at_mm);
  const CommentState& said = comments_.state();
  print_.moves.push_back({.to_mm = to,
                          .filament_mm = filament,
                          .speed_mm_s = float(feed_mm_s_ * speed_factor_),
                          .acceleration_mm_s2 = float(lays ? acceleration_print_ : acceleration_travel_),
                          .width_mm = float(lays ? std::clamp(said.width_mm, 0.0, 100.0) : 0),
                          .height_mm = float(lays ? std::clamp(said.height_mm, 0.0, 100.0) : 0),
                          .offset = offset_,
                          .tool = std::uint8_t(tool_),
                          .feeds = std::uint8_t(feeds),
                          .role = said.role,
                          .arc = is_arc});
  axes_[0].at_mm = to.x, axes_[1].at_mm = to.y, axes_[2].at_mm = to.z;
  if (lays) print_.tools = std::max(print_.tools, feeds + 1);
}

void Interpreter::firmware_retraction(bool back) {
  bool& drawn = drawn_back_[std::size_t(tool_)];
  if (drawn == back) return;
  drawn = back;
  move_to({axes_[0].at_mm, axes_[1].at_mm, axes_[2].at_mm}, back ? -retract_mm_ : retract_mm_, tool_, false);
  print_.moves.back().speed_mm_s = 30;
}

void Interpreter::set_position(const GcodeLine& line) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!line.has_value(axis_letters[axis])) continue;
    Axis& a = axes_[axis];
    const double told = line[axis_letters[axis]] * unit_mm_;
    if (std::abs(told) > largest_mm) fail("this is more than 10 m away; the file is damaged");
    if (a.known) {
      a.origin_mm = a.at_mm - told;
    } else {
      a = {.at_mm = told, .origin_mm = 0, .known = true};
    }
  }
  if (line.has_value('E')) {
    count_mm_[std::size_t(tool_)] = line['E'];
    if (!counts_per_tool_) count_mm_.fill(line['E']);
  }
  if (line.has_value('A')) count_mm_[0] = line['A'];
  if (line.has_value('B')) count_mm_[1] = line['B'];
  if (line.present == 0) {  // bare: all zero
    for (Axis& a : axes_) a.origin_mm = a.at_mm;
    count_mm_.fill(0);
  }
}

void Interpreter::home(const GcodeLine& line) {
  const bool all = !line.has('X') && !line.has('Y') && !line.has('Z');
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (all || line.has(axis_letters[axis])) axes_[axis] = {.at_mm = axes_[axis].at_mm, .origin_mm = 0, .known = false};
}

void Interpreter::select(int tool, bool bare, bool per_tool_counts) {
  counts_per_tool_ = counts_per_tool_ || per_tool_counts;
  event({.kind = GcodeEvent::Kind::tool_change,
         .tool = std::uint8_t(tool),
         .jumps = bare && print_.facts.marlin && tool != tool_});
  tool_ = tool;
}

void Interpreter::temperature(const GcodeLine& line, bool waits) {
  const double value = line.value_or('S', line.value_or('R', -1));
  if (value < 0 && !waits) return;
  event({.kind = GcodeEvent::Kind::target_temperature,
         .tool = std::uint8_t(line.has_value('T') ? checked_tool(line['T']) : tool_),
         .waits = waits,
         .value = std::min(value, 1000.0)});
}

void Interpreter::limits(const GcodeLine& line, GcodeEvent::Kind kind) {
  const double scale = print_.facts.per_minute_limits && kind != GcodeEvent::Kind::max_acceleration ? 1.0 / 60 : 1;
  for (std::uint8_t axis = 0; axis < 4; ++axis) {
    const char letter = "XYZE"[axis];
    if (line.has_value(letter) && line[letter] > 0)
      event({.kind = kind, .axis = axis, .value = std::min(line[letter] * scale, 1e6)});
  }
}

void Interpreter::accelerations(const GcodeLine& line) {
  if (line.has_value('S') && line['S'] > 0) acceleration_print_ = acceleration_travel_ = std::min(line['S'], 1e6);
  if (line.has_value('P') && line['P'] > 0) acceleration_print_ = std::min(line['P'], 1e6);
  if (line.has_value('T') && line['T'] > 0) acceleration_travel_ = std::min(line['T'], 1e6);
}

void Interpreter::event(GcodeEvent event) {
  event.before_move = std::uint32_t(print_.moves.size());
  event.offset = offset_;
  print_.events.push_back(event);
}

int Interpreter::checked_tool(double number) const {
  if (!(number >= 0) || number >= max_tools)
    fail(fmt::format("tool T{} is beyond the {} tools that are supported", number, max_tools));
  return int(number);
}

void Interpreter::unknown(const GcodeLine& line) {
  const std::string name = line.word.empty()
                               ? fmt::format("{}{}{}", line.letter, line.number < 0 ? "" : std::to_string(line.number),
                                             line.fraction > 0 ? fmt::format(".{}", line.fraction) : "")
                               : std::string(line.word.substr(0, 40));
  const auto found = unknown_.find(name);
  if (found != unknown_.end()) {
    ++found->second.count;
  } else if (unknown_.size() < 200) {  // a text that is no G-code has thousands
    unknown_.emplace(name, UnknownCommand{name, 1, line_number(*print_.text, offset_)});
  }
}

void Interpreter::finish() {
  for (auto& [name, command] : unknown_) print_.unknown.push_back(std::move(command));
}

}  // namespace cleancolor
