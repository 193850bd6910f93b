#include "replan/modal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "model/text_scan.hpp"

namespace cleancolor {
namespace {

constexpr std::string_view label_prefix = "0 ";
constexpr std::string_view object_key = "0 ; object", exclude_key = "0 EXCLUDE_OBJECT", m624_key = "0 M624",
                           m486_key = "0 M486";

/// Names of the arguments of a command in words; of those that say which extruder is meant also their values.
std::string names_in(std::string_view arguments) {
  std::string names;
  while (!arguments.empty()) {
    const std::string_view word = arguments.substr(0, arguments.find(' '));
    arguments.remove_prefix(std::min(arguments.size(), word.size() + 1));
    const bool says_which = word.starts_with("EXTRUDER=") || word.starts_with("FAN=");
    names += fmt::format(" {}", says_which ? word : word.substr(0, word.find('=')));
  }
  return names;
}

/// Letters that are there; with the values of those that say which one is meant.
std::string letters_in(const GcodeLine& line, std::string_view which) {
  std::string letters;
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    if (!line.has(letter)) continue;
    letters += fmt::format(" {}", letter);
    if (which.find(letter) != which.npos && line.has_value(letter)) letters += fmt::format("{:g}", line[letter]);
  }
  return letters;
}

std::optional<ModalLine> of_comment(std::string_view comment) {
  const std::string_view text = trimmed(comment);
  constexpr std::array<std::pair<std::string_view, std::string_view>, 8> told = {{{"TYPE:", type_key},
                                                                                  {"FEATURE:", type_key},
                                                                                  {"WIDTH:", width_key},
                                                                                  {"LINE_WIDTH:", width_key},
                                                                                  {"HEIGHT:", height_key},
                                                                                  {"LAYER_HEIGHT:", height_key},
                                                                                  {"MESH:", mesh_key},
                                                                                  {"OBJECT_ID:", object_id_key}}};
  for (const auto& [begin, key] : told)
    if (text.starts_with(begin)) return ModalLine{std::string(key)};
  if (text.starts_with("printing object ") || text.starts_with("start printing object"))
    return ModalLine{std::string(object_key)};
  if (text.starts_with("stop printing object")) return ModalLine{std::string(object_key), true};
  return std::nullopt;
}

std::optional<ModalLine> of_m(const GcodeLine& line) {
  switch (line.number) {
    case 106:
    case 107:
      return ModalLine{line.has_value('P') ? fmt::format("fan {:g}", line['P']) : std::string("fan")};
    case 126:
    case 127:
      return ModalLine{fmt::format("valve{}", letters_in(line, "TP"))};
    case 201:
    case 203:
    case 204:
    case 205:
    case 566:
      return ModalLine{fmt::format("M{}{}", line.number, letters_in(line, ""))};
    case 220:
    case 221:
    case 572:
    case 900:
      return ModalLine{fmt::format("M{}{}", line.number, letters_in(line, "TD"))};
    case 624:
    case 625:
      return ModalLine{std::string(m624_key), line.number == 625};
    case 486:
      if (!line.has_value('S')) return std::nullopt;
      return ModalLine{std::string(m486_key), line['S'] < 0};
    default:
      return std::nullopt;
  }
}

/// The line that ends what this one begins.
std::string end_of_label(std::string_view key, std::string_view line) {
  if (key == m624_key) return "M625";
  if (key == m486_key) return "M486 S-1";
  const auto behind = [&](std::string_view words) { return line.substr(std::min(line.find(words), line.size())); };
  if (key == object_key) return fmt::format("; stop {}", behind("printing object"));
  const std::string_view name = behind("_START");
  return fmt::format("EXCLUDE_OBJECT_END{}", name.substr(std::min(name.find(' '), name.size())));
}

}  // namespace

std::optional<ModalLine> modal_line(const GcodeLine& line) {
  if (line.letter == 'M') return of_m(line);
  if (line.word == "SET_VELOCITY_LIMIT" || line.word == "SET_PRESSURE_ADVANCE")
    return ModalLine{std::string(line.word) + names_in(trimmed(line.arguments))};
  if (line.word == "EXCLUDE_OBJECT_START") return ModalLine{std::string(exclude_key)};
  if (line.word == "EXCLUDE_OBJECT_END") return ModalLine{std::string(exclude_key), true};
  const bool alone = line.letter == 0 && line.word.empty() && line.present == 0;
  return alone && line.has_comment ? of_comment(line.comment) : std::nullopt;
}

ModalState of_moving(const ModalState& state) {
  constexpr std::array<std::string_view, 5> keys = {"M201", "M204", "M205", "M566", "SET_VELOCITY_LIMIT"};
  ModalState moving;
  for (const auto& [key, text] : state)
    if (std::ranges::any_of(keys, [&](std::string_view begin) { return key.starts_with(begin); })) moving[key] = text;
  return moving;
}

bool is_of_tool(std::string_view key) {
  constexpr std::array<std::string_view, 4> keys = {"M221", "M572", "M900", "SET_PRESSURE_ADVANCE"};
  const auto begins = [&](std::string_view begin) { return key.starts_with(begin); };
  const bool names_one = key.find(" T") != key.npos || key.find(" D") != key.npos || key.find("EXTRUDER=") != key.npos;
  return std::ranges::any_of(keys, begins) && !names_one;
}

ModalState of_no_object(ModalState state) {
  for (auto& [key, text] : state)
    if (key.starts_with(label_prefix)) text.clear();
  state.erase(std::string(object_id_key));
  return state;
}

void take(ModalState& state, const ModalLine& what, std::string_view text) {
  state[what.key] = what.ends ? std::string() : std::string(text);
}

std::vector<std::string> lines_between(const ModalState& from, const ModalState& to) {
  std::vector<std::string> ends, lines;
  for (const auto& [key, text] : to) {
    const auto before = from.find(key);
    if (before != from.end() && before->second == text) continue;
    if (key.starts_with(label_prefix) && before != from.end() && !before->second.empty())
      ends.push_back(end_of_label(key, before->second));
    if (!text.empty()) lines.push_back(text);
  }
  std::ranges::move(lines, std::back_inserter(ends));
  return ends;
}

void StateLog::take(const ModalLine& what, std::string_view text) {
  cleancolor::take(now_, what, text);
  changed_ = true;
}

void StateLog::set(std::string_view key, std::string_view text) {
  std::string& now = now_[std::string(key)];
  changed_ = changed_ || now != text;
  now = text;
}

void StateLog::set_first(std::string_view key, std::string_view text) {
  if (!now_.contains(key)) set(key, text);
}

void StateLog::change_tool(int from, int to) {
  if (from == to) return;
  for (auto entry = now_.begin(); entry != now_.end();) {
    const auto next = std::next(entry);
    if (is_of_tool(entry->first)) of_tool_[from].insert(now_.extract(entry));
    entry = next;
  }
  now_.merge(of_tool_[to]);
  of_tool_[to].clear();
  changed_ = true;
}

std::uint32_t StateLog::index() {
  if (!std::exchange(changed_, false)) return index_;
  const auto [found, is_new] = known_.try_emplace(now_, std::uint32_t(known_.size()));
  if (is_new)
    for (const auto& [key, text] : now_) bytes_ += text.size();
  return index_ = found->second;
}

std::vector<ModalState> StateLog::all() && {
  std::vector<ModalState> states(known_.size());
  while (!known_.empty()) {
    auto one = known_.extract(known_.begin());
    states[one.mapped()] = std::move(one.key());
  }
  return states;
}

}  // namespace cleancolor
