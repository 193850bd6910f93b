// The text of values, as PrusaSlicer writes them: parse_option, split_list, set_option and back again.

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>

#include "base/error.hpp"
#include "model/options.hpp"
#include "model/text_scan.hpp"

namespace cleancolor {
namespace {

[[noreturn]] void fail(const Option& option, std::string_view where, const std::string& reason) {
  throw Error(fmt::format("{}{}: {}", where, option.name, reason));
}

// "20%" -> 0.2
std::optional<double> share(std::string_view text) {
  text = trimmed(text);
  if (!text.ends_with('%')) return std::nullopt;
  const auto value = number<double>(trimmed(text.substr(0, text.size() - 1)));
  return value ? std::optional(*value / 100) : std::nullopt;
}

std::optional<Vec2> point(std::string_view text) {
  const std::size_t x = text.find('x');
  if (x == text.npos) return std::nullopt;
  const auto a = number<double>(trimmed(text.substr(0, x)));
  const auto b = number<double>(trimmed(text.substr(x + 1)));
  return a && b ? std::optional(Vec2{*a, *b}) : std::nullopt;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> pieces;
  for (std::size_t end; (end = text.find(separator)) != text.npos; text.remove_prefix(end + 1)) {
    pieces.push_back(text.substr(0, end));
  }
  pieces.push_back(text);
  return pieces;
}

std::optional<std::vector<Vec2>> polygon(std::string_view text) {
  std::vector<Vec2> points;
  if (trimmed(text).empty()) return points;
  for (const std::string_view piece : split(text, ',')) {
    const auto p = point(piece);
    if (!p) return std::nullopt;
    points.push_back(*p);
  }
  return points;
}

// Backslash n and r; a backslash before anything else stands for that.
std::string unescaped(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      plain += text[i];
      continue;
    }
    const char c = text[++i];
    plain += c == 'n' ? '\n' : c == 'r' ? '\r' : c;
  }
  return plain;
}

std::string escaped(std::string_view plain, bool quotes) {
  std::string text;
  // Readers cut off space before a value.
  if (!quotes && (plain.starts_with(' ') || plain.starts_with('\t'))) text += '\\';
  for (const char c : plain) {
    if (c == '\n') {
      text += "\\n";
    } else if (c == '\r') {
      text += "\\r";
    } else if (c == '\\' || (quotes && c == '"')) {
      text += '\\';
      text += c;
    } else {
      text += c;
    }
  }
  return text;
}

// "a;\"b;c\";d" -> a, b;c, d. A quoted text ends at the next quote that no backslash precedes.
std::optional<std::vector<std::string>> split_texts(std::string_view text) {
  std::vector<std::string> texts;
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    if (!text.starts_with('"')) {
      const std::size_t end = std::min(text.find(';'), text.size());
      texts.emplace_back(unescaped(trimmed(text.substr(0, end))));
      text.remove_prefix(end);
    } else {
      std::size_t end = 1;
      while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
      if (end >= text.size()) return std::nullopt;
      texts.push_back(unescaped(text.substr(1, end - 1)));
      text = trimmed(text.substr(end + 1));
      if (!text.empty() && !text.starts_with(';')) return std::nullopt;
    }
    if (text.empty()) return texts;
    text.remove_prefix(1);
  }
}

std::string quoted_where_needed(const std::string& plain) {
  if (!plain.empty() && plain.find_first_of(" \t\r\n\\\";") == plain.npos) return plain;
  return '"' + escaped(plain, true) + '"';
}

std::string choices_text(const Option& option) {
  return fmt::format("{}", fmt::join(option.choices(), ", "));
}

OptionValue parse_percent(const Option& option, std::string_view text, std::string_view where) {
  if (const auto value = share(text)) return *value;
  const auto value = number<double>(text);
  if (!value) fail(option, where, fmt::format("'{}' is not a percentage such as 20%", text));
  // Older files say 0.2 for 20%, newer ones 20. Between the two nobody can tell.
  if (*value > 0 && *value <= 1) {
    fail(option, where, fmt::format("'{}' may mean {:g}% or {:g}%; write it with %", text, *value, *value * 100));
  }
  return *value / 100;
}

OptionValue parse_choice(const Option& option, std::string_view text, std::string_view where) {
  const auto choices = option.choices();
  const auto found = std::ranges::find(choices, text);
  if (found == choices.end()) {
    fail(option, where, fmt::format("'{}' is none of the possible values {}", text, choices_text(option)));
  }
  return static_cast<int>(found - choices.begin());
}

template <class T>
OptionValue required(const Option& option, std::string_view text, std::string_view where, const std::optional<T>& value,
                     std::string_view what) {
  if (!value) fail(option, where, fmt::format("'{}' is not {}", text.substr(0, 60), what));
  return *value;
}

}  // namespace

OptionValue parse_option(const Option& option, std::string_view text, std::string_view where) {
  if (option.kind() == OptionKind::text) return std::string(text);
  text = trimmed(text);
  switch (option.kind()) {
    case OptionKind::flag:
      if (text != "0" && text != "1") fail(option, where, fmt::format("'{}' is neither 0 (no) nor 1 (yes)", text));
      return text == "1";
    case OptionKind::integer:
      return required(option, text, where, number<int>(text), "a whole number");
    case OptionKind::number:
      return required(option, text, where, number<double>(text), "a number");
    case OptionKind::percent:
      return parse_percent(option, text, where);
    case OptionKind::choice:
      return parse_choice(option, text, where);
    case OptionKind::point:
      return required(option, text, where, point(text), "a point such as 33x0");
    case OptionKind::polygon:
      return required(option, text, where, polygon(text), "a list of points such as 0x0,200x0,200x200");
    case OptionKind::length_or_share: {
      if (const auto value = share(text)) return LengthOrShare{*value, true};
      const auto value = number<double>(text);
      if (!value) fail(option, where, fmt::format("'{}' is neither a number nor a percentage such as 50%", text));
      return LengthOrShare{*value, false};
    }
    case OptionKind::text:
      break;
  }
  return std::string(text);
}

std::vector<std::string> split_list(const Option& option, std::string_view text, std::string_view where) {
  text = trimmed(text);
  if (!option.per_extruder()) {
    return {option.kind() == OptionKind::text ? unescaped(text) : std::string(text)};
  }
  if (option.kind() != OptionKind::text && option.kind() != OptionKind::polygon) {
    const auto pieces = split(text, ',');
    return {pieces.begin(), pieces.end()};
  }
  auto texts = split_texts(text);
  if (!texts) fail(option, where, "a quoted text does not end; quotes within it are written \\\"");
  return *std::move(texts);
}

void set_option(Config& config, std::string_view name, std::string_view text, std::string_view where) {
  const Option* option = find_option(name);
  if (!option) throw Error(fmt::format("{}there is no option '{}'{}", where, name, did_you_mean(name)));

  std::vector<OptionValue> values;
  for (const std::string& piece : split_list(*option, text, where)) {
    values.push_back(parse_option(*option, piece, where));
  }
  if (!option->per_extruder()) return store_option(config, *option, 0, values.front(), where);

  if (values.size() > max_extruders) {
    fail(*option, where, fmt::format("{} values; there can be at most {} extruders", values.size(), max_extruders));
  }
  if (name == "nozzle_diameter" && values.size() > config.extruders.size()) set_extruder_count(config, values.size());
  if (values.size() != 1 && values.size() != config.extruders.size()) {
    fail(*option, where,
         fmt::format("{} values for {} extruder{}; give one for all or one for each", values.size(),
                     config.extruders.size(), config.extruders.size() == 1 ? "" : "s"));
  }
  for (std::size_t i = 0; i < config.extruders.size(); ++i) {
    store_option(config, *option, i, values.size() == 1 ? values.front() : values[i], where);
  }
}

namespace {

std::string number_text(double value) {
  return fmt::format("{}", value + 0.0);
}  // never "-0"

std::string share_text(double share) {
  return fmt::format("{:.10g}%", share * 100 + 0.0);
}

std::string point_text(Vec2 p) {
  return number_text(p.x) + "x" + number_text(p.y);
}

}  // namespace

std::string value_text(const Option& option, const OptionValue& value) {
  switch (option.kind()) {
    case OptionKind::flag:
      return std::get<bool>(value) ? "1" : "0";
    case OptionKind::integer:
      return fmt::format("{}", std::get<int>(value));
    case OptionKind::number:
      return number_text(std::get<double>(value));
    case OptionKind::percent:
      return share_text(std::get<double>(value));
    case OptionKind::choice:
      return std::string(option.choices()[static_cast<std::size_t>(std::get<int>(value))]);
    case OptionKind::text:
      return std::get<std::string>(value);
    case OptionKind::point:
      return point_text(std::get<Vec2>(value));
    case OptionKind::length_or_share: {
      const auto v = std::get<LengthOrShare>(value);
      return v.is_share ? share_text(v.value) : number_text(v.value);
    }
    case OptionKind::polygon: {
      std::vector<std::string> points;
      for (const Vec2 p : std::get<std::vector<Vec2>>(value)) points.push_back(point_text(p));
      return fmt::format("{}", fmt::join(points, ","));
    }
  }
  return "";
}

std::string option_text(const Config& config, std::string_view name) {
  const Option* option = find_option(name);
  assert(option);
  const bool is_text = option->kind() == OptionKind::text;
  if (!option->per_extruder()) {
    const std::string text = value_text(*option, option_value(config, *option));
    return is_text ? escaped(text, false) : text;
  }
  std::vector<std::string> values;
  for (std::size_t i = 0; i < config.extruders.size(); ++i) {
    const std::string text = value_text(*option, option_value(config, *option, i));
    values.push_back(is_text ? quoted_where_needed(text) : text);
  }
  const bool by_semicolon = is_text || option->kind() == OptionKind::polygon;
  return fmt::format("{}", fmt::join(values, by_semicolon ? ";" : ","));
}

std::vector<std::pair<std::string, std::string>> config_block(const Config& config) {
  std::vector<std::pair<std::string, std::string>> block;
  for (const Option& option : options()) {
    block.emplace_back(option.name, option_text(config, option.name));
    if (option.name != "nozzle_offset") continue;
    std::string offsets = block.back().second;
    if (config.offsets_in == OffsetsIn::firmware) {
      const std::vector<std::string> zeroes(config.extruders.size(), "0x0");
      offsets = fmt::format("{}", fmt::join(zeroes, ","));
    }
    block.emplace_back("extruder_offset", offsets);
  }
  return block;
}

}  // namespace cleancolor
