#include "replan/heaters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "audit/timeline.hpp"
#include "replan/file_parts.hpp"

namespace cleancolor {
namespace {

constexpr double same_c = 0.5;
constexpr double least_idle_s = 1;  // beside the time that it takes to heat up

/// A stretch of the print in which one tool is in use; the last ends with its last road.
struct ToolUse {
  int tool = 0;
  std::size_t offset = 0;          // of the line that takes it
  std::size_t begin = 0, end = 0;  // moves
};

std::vector<ToolUse> uses_of(const GcodePrint& print, std::size_t begin) {
  std::vector<ToolUse> uses(1, {.offset = begin});
  for (const GcodeEvent& e : print.events) {
    if (e.kind != GcodeEvent::Kind::tool_change) continue;
    if (e.offset < begin) {
      uses.front().tool = e.tool;
    } else if (e.tool != uses.back().tool) {
      uses.back().end = e.before_move;
      uses.push_back({.tool = e.tool, .offset = e.offset, .begin = e.before_move});
    }
  }
  for (std::size_t i = uses.back().begin; i < print.moves.size(); ++i)
    if (lays_plastic(print, i)) uses.back().end = i + 1;
  const auto first =
      std::ranges::find_if(print.moves, [&](const GcodeMove& m) { return m.offset >= begin; }) - print.moves.begin();
  uses.front().begin = std::size_t(first);
  return uses;
}

/// When each move begins, s; one more for the end.
std::vector<double> begins_s(const Timeline& time) {
  std::vector<double> at(1, 0.);
  for (const double s : time.duration_s) at.push_back(at.back() + s);
  return at;
}

bool is_target(const GcodeEvent& e) {
  return e.kind == GcodeEvent::Kind::target_temperature;
}

std::vector<GcodeEvent> targets_among_layers(const RecoveredPrint& recovered, const GcodePrint& print) {
  std::vector<GcodeEvent> targets;
  for (const GcodeEvent& e : print.events)
    if (is_target(e) && e.offset >= recovered.begin && e.offset < recovered.end) targets.push_back(e);
  return targets;
}

/// What a file does with the heater of one tool.
struct HeaterHabits {
  double begin_c = 0;                       // where the layers begin
  std::map<std::uint32_t, double> print_c;  // by layer, where it differs from what held before
  std::optional<double> idle_c;
  double least_cooled_s = INFINITY;  // of idling
  double lead_s = 0;
  bool is_switched_off = false;
};

/// By tool.
using AllHabits = std::map<int, HeaterHabits>;

/// How hot a tool prints is the hottest that it is while it lays plastic in a layer.
void learn_printing(const RecoveredPrint& recovered, const GcodePrint& print, AllHabits& all) {
  std::map<int, double> target_c;
  std::size_t next = 0;
  const auto take = [&](const GcodeEvent& e) {
    if (is_target(e)) target_c[e.tool] = e.value;
  };
  for (; next < print.events.size() && print.events[next].offset < recovered.begin; ++next) take(print.events[next]);
  for (const auto& [tool, c] : target_c) all[tool].begin_c = c;
  std::map<int, std::map<std::uint32_t, double>> hottest;
  for (std::size_t i = 0; i < print.moves.size(); ++i) {
    for (; next < print.events.size() && print.events[next].before_move <= i; ++next) take(print.events[next]);
    const GcodeMove& move = print.moves[i];
    if (move.offset < recovered.begin || !lays_plastic(print, i)) continue;
    double& most = hottest[move.tool][move.layer];
    most = std::max(most, target_c[move.tool]);
  }
  for (const auto& [tool, by_layer] : hottest)
    for (const auto& [layer, c] : by_layer) {
      auto& own = all[tool].print_c;
      if (own.empty() || std::abs(own.rbegin()->second - c) >= same_c) own[layer] = c;
    }
}

/// Between two uses: how cool it becomes, and when it is told to be hot again.  Requires: what it prints at is known.
void learn_idling(const RecoveredPrint& recovered, const GcodePrint& print, const Timeline& time, AllHabits& all) {
  const std::vector<double> at_s = begins_s(time);
  std::map<int, std::vector<GcodeEvent>> targets_of;
  for (const GcodeEvent& e : targets_among_layers(recovered, print)) {
    targets_of[e.tool].push_back(e);
    if (e.value <= 0) all[e.tool].is_switched_off = true;
  }
  std::map<int, std::size_t> told;  // so many of them
  std::map<int, double> left_s;
  for (const ToolUse& use : uses_of(print, recovered.begin)) {
    HeaterHabits& habits = all[use.tool];
    const double taken_s = at_s[use.begin];
    const bool was_used = left_s.contains(use.tool);
    std::optional<double> coolest_c, heats_s;
    if (!was_used) coolest_c = habits.begin_c;
    const std::vector<GcodeEvent>& own = targets_of[use.tool];
    for (std::size_t& i = told[use.tool]; i < own.size() && own[i].before_move < use.begin; ++i) {
      const GcodeEvent& e = own[i];
      if (was_used && at_s[e.before_move] < left_s[use.tool]) continue;  // while it printed
      if (coolest_c && e.value > *coolest_c + same_c) heats_s = at_s[e.before_move];
      if (!coolest_c || e.value < *coolest_c) coolest_c = e.value, heats_s.reset();
    }
    if (heats_s) habits.lead_s = std::max(habits.lead_s, taken_s - *heats_s);
    const double hot_c = habits.print_c.empty() ? habits.begin_c : habits.print_c.begin()->second;
    if (coolest_c && *coolest_c > 0 && *coolest_c < hot_c - same_c) {
      habits.idle_c = std::min(habits.idle_c.value_or(*coolest_c), *coolest_c);
      if (was_used) habits.least_cooled_s = std::min(habits.least_cooled_s, taken_s - left_s[use.tool]);
    }
    left_s[use.tool] = at_s[use.end];
  }
}

double print_c(const HeaterHabits& habits, std::uint32_t layer) {
  if (habits.print_c.empty()) return habits.begin_c;
  const auto after = habits.print_c.upper_bound(layer);
  return after == habits.print_c.begin() ? after->second : std::prev(after)->second;
}

/// Lines to be put in, by the byte that they stand before.
using Insertions = std::multimap<std::size_t, std::string>;

std::string with_lines(std::string_view text, const Insertions& insertions) {
  std::string result;
  std::size_t at = 0;
  for (const auto& [offset, line] : insertions) {
    result += text.substr(at, offset - at);
    result += line;
    result += '\n';
    at = offset;
  }
  result += text.substr(at);
  return result;
}

}  // namespace

bool sets_temperatures(const RecoveredPrint& recovered, const GcodePrint& print) {
  return !targets_among_layers(recovered, print).empty();
}

std::string with_heaters(const RecoveredPrint& recovered, const GcodePrint& print, const GcodePrint& after,
                         const AuditMachine& machine, std::string_view layer_mark) {
  AllHabits all;
  learn_printing(recovered, print, all);
  learn_idling(recovered, print, timeline(print, machine), all);
  const std::string_view text = *after.text;
  const std::size_t first = text.find(fmt::format("\n{}", layer_mark)) + 1;
  const std::vector<double> at_s = begins_s(timeline(after, machine));
  const std::vector<ToolUse> uses = uses_of(after, first);
  const auto move_at = [&](double s) {
    const auto found = std::ranges::lower_bound(at_s, s) - at_s.begin();
    return std::min(std::max(std::size_t(found), uses.front().begin), after.moves.size() - 1);
  };
  Insertions lines;
  std::map<int, double> target_c;
  for (const auto& [tool, habits] : all) target_c[tool] = habits.begin_c;
  for (std::size_t u = 0; u < uses.size(); ++u) {
    const ToolUse& use = uses[u];
    const auto known = all.find(use.tool);
    if (known == all.end()) continue;
    const HeaterHabits& habits = known->second;
    double& c = target_c[use.tool];
    for (std::size_t i = use.begin; i < use.end; ++i) {
      const double want_c = print_c(habits, after.moves[i].layer);
      if (std::abs(want_c - c) < same_c) continue;
      if (i == use.begin && u > 0) {
        const std::size_t heats = move_at(at_s[use.begin] - habits.lead_s);
        if (want_c > c && heats < use.begin)
          lines.emplace(after.moves[heats].offset, fmt::format("M104 T{} S{:g}", use.tool, want_c));
        lines.emplace(line_end(text, use.offset), fmt::format("{} S{:g}", want_c > c ? "M109" : "M104", want_c));
      } else {
        lines.emplace(after.moves[i].offset, fmt::format("M104 S{:g}", want_c));
      }
      c = want_c;
    }
    if (u + 1 == uses.size()) break;
    const auto again = std::ranges::find(uses.begin() + std::ptrdiff_t(u) + 1, uses.end(), use.tool, &ToolUse::tool);
    std::optional<double> idle_c;
    if (again == uses.end()) {
      if (habits.is_switched_off) idle_c = 0;
    } else if (habits.idle_c) {
      const double idle_s = at_s[again->begin] - at_s[use.end];
      if (idle_s >= habits.least_cooled_s && idle_s > habits.lead_s + least_idle_s) idle_c = habits.idle_c;
    }
    if (!idle_c) continue;
    lines.emplace(line_end(text, uses[u + 1].offset), fmt::format("M104 T{} S{:g}", use.tool, *idle_c));
    c = *idle_c;
  }
  return with_lines(text, lines);
}

}  // namespace cleancolor
