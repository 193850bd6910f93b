#include "reader/interpreter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "model/text_scan.hpp"
#include "reader/arc.hpp"
#include "reader/known_commands.hpp"

namespace cleancolor {
namespace {

constexpr double largest_mm = 10000;
constexpr double largest_count_mm = 1e9;
constexpr std::array<char, 3> axis_letters = {'X', 'Y', 'Z'};
constexpr std::size_t most_unknown = 200;  // a text that is no G-code has thousands

constexpr std::uint32_t bits(std::string_view letters) {
  std::uint32_t all = 0;
  for (const char letter : letters) all |= std::uint32_t{1} << (letter - 'A');
  return all;
}

std::string name_of(const GcodeLine& line) {
  if (!line.word.empty()) return shown(line.word);
  std::string name(1, line.letter);
  if (line.number >= 0) name += std::to_string(line.number);
  if (line.fraction > 0) name += fmt::format(".{}", line.fraction);
  return name;
}

}  // namespace

Interpreter::Interpreter(GcodePrint& print) : print_(print), comments_(print.facts), filament_(print.facts) {}

void Interpreter::fail(const std::string& what) const {
  throw Error(fmt::format("{}:{}: {}", print_.name, line_number(*print_.text, offset_), what));
}

void Interpreter::run(const GcodeLine& line, std::uint32_t offset) {
  offset_ = offset;
  const bool empty = line.letter == 0 && line.word.empty() && line.present == 0;
  if (line.has_comment) {
    if (empty) {
      comments_.comment(line.comment);
    } else {
      comments_.comment_behind_command(line.comment);
    }
  }
  if (empty) return;
  if (line.letter == 'G') return command_g(line);
  if (line.letter == 'M') return command_m(line);
  if (line.letter == 'T') return tool_word(line);
  if (!line.word.empty()) return command_in_words(line);
  if (line.letter == 0 && motion_ >= 0) return go(line);
  unknown(line);
}

void Interpreter::command_g(const GcodeLine& line) {
  const int number = line.number;
  if (line.fraction > 0 && number != 90 && number != 91 && number != 92) return unknown(line);
  switch (number) {
    case 0:
    case 1:
    case 2:
    case 3:
      motion_ = number;
      return go(line);
    case 4:
      return dwell(line);
    case 10:
      // With P: a tool of RepRapFirmware, with L: a workspace.
      if (!line.has('P') && !line.has('L')) return firmware_retraction(true);
      two_temperatures(line);
      return firmware_offset(line);
    case 11:
      return firmware_retraction(false);
    case 17:
    case 18:
    case 19:
      plane_ = number;
      return;
    case 20:
    case 21:
      unit_mm_ = number == 20 ? 25.4 : 1;
      return;
    case 12:  // wiping
    case 27:  // parking
    case 28:
    case 29:
    case 30:  // probing and levelling
    case 32:
    case 33:
    case 34:
    case 35:
    case 80:
    case 161:
    case 162:
      return forget_position(line);
    case 90:
    case 91:
      if (line.fraction == 1) {
        absolute_centers_ = number == 90;
      } else {
        relative_ = number == 91;
        filament_.g90_or_g91(relative_);
      }
      return;
    case 92:
      return set_position(line);
    default:
      if (!is_harmless(line)) unknown(line);
  }
}

void Interpreter::go(const GcodeLine& line) {
  require_numbers(line);
  set_speed(line);
  if (motion_ >= 2) {
    arc(line);
  } else {
    straight(line);
  }
}

void Interpreter::require_numbers(const GcodeLine& line) const {
  constexpr std::string_view letters = "XYZEFIJRAB";
  const std::uint32_t missing = line.present & ~line.valued & bits(letters);
  if (missing == 0) return;
  const char letter = *std::ranges::find_if(letters, [&](char c) { return (missing & bits({&c, 1})) != 0; });
  fail(fmt::format("{} has no number; the file is {}: export or download it again", letter,
                   on_last_line() ? "cut off" : "damaged"));
}

bool Interpreter::on_last_line() const {
  return print_.text->find_first_of("\r\n", offset_) == std::string::npos;
}

void Interpreter::set_speed(const GcodeLine& line) {
  if (line.has_value('F') && line['F'] > 0) speed_mm_s_ = std::clamp(line['F'] * unit_mm_ / 60, 0.01, 1e5);
}

double Interpreter::target_mm(const GcodeLine& line, int axis) const {
  const Axis& a = axes_[std::size_t(axis)];
  const char letter = axis_letters[std::size_t(axis)];
  if (!line.has(letter)) return a.at_mm;
  return (relative_ ? a.at_mm : a.origin_mm) + line[letter] * unit_mm_;
}

/// An axis that is told where to go is known from then on.
void Interpreter::arrive(const GcodeLine& line) {
  if (relative_) return;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (line.has(axis_letters[axis])) axes_[axis].known = true;
}

double Interpreter::filament_mm(const GcodeLine& line, int& feeds) {
  feeds = tool_;
  if ((line.present & bits("EAB")) == 0) return 0;
  if (line.has('A') || line.has('B')) filament_.one_for_each_tool(tool_);
  double filament = 0;
  const auto add = [&](char letter, int tool) {
    if (!line.has(letter)) return;
    const double told = line[letter] * unit_mm_;
    if (std::abs(told) > largest_count_mm) fail(fmt::format("{} is too large; the file is damaged", letter));
    const double pushed = filament_.pushed_mm(tool, told);
    if (filament != 0 && pushed != 0 && tool != feeds)
      move_to({axes_[0].at_mm, axes_[1].at_mm, axes_[2].at_mm}, std::exchange(filament, 0), feeds);
    if (pushed != 0) feeds = tool;
    filament += pushed;
  };
  add('A', 0);
  add('B', 1);
  add('E', tool_);
  return filament;
}

void Interpreter::straight(const GcodeLine& line) {
  int feeds = tool_;
  const double filament = filament_mm(line, feeds);
  if (filament == 0 && (line.present & bits("XYZ")) == 0) return;
  const Vec3 to = {target_mm(line, 0), target_mm(line, 1), target_mm(line, 2)};
  arrive(line);
  move_to(to, filament, feeds);
  print_.moves.back().names_xy = line.has('X') || line.has('Y');
}

void Interpreter::arc(const GcodeLine& line) {
  if (plane_ != 17) fail("arcs in other planes than XY are not supported; switch off arcs in the slicer");
  if (!axes_[0].known || !axes_[1].known) return straight(line);
  Arc way{.from_mm = {axes_[0].at_mm, axes_[1].at_mm},
          .to_mm = {target_mm(line, 0), target_mm(line, 1)},
          .clockwise = motion_ == 2,
          .center_mm = std::nullopt,
          .radius_mm = line.value_or('R', 0) * unit_mm_};
  if (line.has('I') || line.has('J')) {
    const Vec2 told = Vec2{line.value_or('I', 0), line.value_or('J', 0)} * unit_mm_;
    way.center_mm = told + (absolute_centers_ ? Vec2{axes_[0].origin_mm, axes_[1].origin_mm} : way.from_mm);
  }
  const Vec2 center = way.center_mm.value_or(way.from_mm);
  if (std::max({std::abs(center.x), std::abs(center.y), std::abs(way.radius_mm)}) > largest_mm)
    fail("the centre of the arc is more than 10 m away; the file is damaged");
  const std::vector<ArcPoint> points = chords(way);
  if (points.empty()) return straight(line);
  if (print_.moves.size() > 1'000'000 + print_.text->size() / 2) fail("too many large arcs; the file is damaged");

  int feeds = tool_;
  const double filament = filament_mm(line, feeds);
  const double z = axes_[2].at_mm, end_z = target_mm(line, 2);
  arrive(line);
  double share = 0;
  for (const ArcPoint& p : points) {
    const double height = p.share < 1 ? z + (end_z - z) * p.share : end_z;
    move_to({p.at_mm.x, p.at_mm.y, height}, filament * (p.share - share), feeds, true);
    share = p.share;
  }
}

void Interpreter::move_to(Vec3 to, double filament, int feeds, bool is_arc) {
  if (std::max({std::abs(to.x), std::abs(to.y), std::abs(to.z)}) > largest_mm)
    fail("this is more than 10 m away; the file is damaged");
  if (std::abs(filament) > largest_mm) fail("this is more than 10 m of filament; the file is damaged");
  const bool across = to.x != axes_[0].at_mm || to.y != axes_[1].at_mm;
  const bool lays = filament > 0 && across;
  const double acceleration = lays                               ? acceleration_.print
                              : across || to.z != axes_[2].at_mm ? acceleration_.travel
                                                                 : acceleration_.retract;
  const CommentState& said = comments_.state();
  const bool stale = lays && !said.object && !is_auxiliary(said.role);  // what belongs to no object is no part of it
  print_.moves.push_back({.to_mm = to,
                          .filament_mm = filament,
                          .speed_mm_s = float(speed_mm_s_ * speed_factor_),
                          .acceleration_mm_s2 = float(acceleration),
                          .width_mm = float(lays ? std::clamp(said.width_mm, 0.0, 100.0) : 0),
                          .height_mm = float(lays ? std::clamp(said.height_mm, 0.0, 100.0) : 0),
                          .offset = offset_,
                          .tool = std::uint8_t(tool_),
                          .feeds = std::uint8_t(feeds),
                          .role = stale ? Role::custom : said.role,
                          .known_start = end_known_,
                          .names_xy = is_arc,
                          .arc = is_arc});
  axes_[0].at_mm = to.x, axes_[1].at_mm = to.y, axes_[2].at_mm = to.z;
  end_known_ = axes_[0].known && axes_[1].known;
  print_.tools = std::max({print_.tools, tool_ + 1, feeds + 1});
}

void Interpreter::firmware_retraction(bool back) {
  const double filament = filament_.drawn_back_mm(tool_, back);
  if (filament != 0) move_to({axes_[0].at_mm, axes_[1].at_mm, axes_[2].at_mm}, filament, tool_);
}

void Interpreter::set_position(const GcodeLine& line) {
  require_numbers(line);
  if (line.fraction == 1) {  // G92.1: what the file says is physical again
    for (Axis& axis : axes_) axis.origin_mm = 0;
    return;
  }
  const bool bare = line.present == 0;  // all axes are at zero
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!bare && !line.has(axis_letters[axis])) continue;
    const double told = bare ? 0 : line[axis_letters[axis]] * unit_mm_;
    if (std::abs(told) > largest_mm) fail("this is more than 10 m away; the file is damaged");
    Axis& a = axes_[axis];
    if (a.known) {
      a.origin_mm = a.at_mm - told;
      if (std::abs(a.origin_mm) > 2 * largest_mm) fail("this is more than 10 m away; the file is damaged");
    } else {
      a = {.at_mm = told, .origin_mm = 0, .known = true};
    }
  }
  if (bare) filament_.set_all_to_zero();
  if (line.has('A') || line.has('B')) filament_.one_for_each_tool(tool_);
  if (line.has('E')) filament_.set(tool_, line['E'] * unit_mm_);
  if (line.has('A')) filament_.set(0, line['A'] * unit_mm_);
  if (line.has('B')) filament_.set(1, line['B'] * unit_mm_);
}

void Interpreter::forget_position(const GcodeLine& line) {
  const bool all = (line.present & bits("XYZ")) == 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (all || line.has(axis_letters[axis])) axes_[axis] = {};
  end_known_ = end_known_ && axes_[0].known && axes_[1].known;
}

void Interpreter::dwell(const GcodeLine& line) {
  const double value = line.has_value('S') ? line['S'] : line.value_or('P', 0) / 1000;
  if (value > 0) event({.kind = GcodeEvent::Kind::dwell, .value = std::min(value, 1e6)});
}

void Interpreter::unknown(const GcodeLine& line) {
  // Where a command that nobody knows has driven an axis is not known either.
  if (line.letter == 'G' && (line.present & bits("XYZ")) != 0) forget_position(line);
  std::string name = name_of(line);
  const auto found = unknown_.find(name);
  if (found != unknown_.end()) {
    ++found->second.count;
  } else if (unknown_.size() < most_unknown) {
    unknown_.emplace(name, UnknownCommand{name, 1, line_number(*print_.text, offset_)});
  }
}

void Interpreter::finish() {
  for (auto& [name, command] : unknown_) print_.unknown.push_back(std::move(command));
  unknown_.clear();
}

}  // namespace cleancolor
