#include "replan/times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/duration_text.hpp"
#include "model/text_scan.hpp"
#include "reader/dialect.hpp"
#include "replan/dialect_words.hpp"
#include "replan/file_parts.hpp"

namespace cleancolor {
namespace {

/// Cura: whole seconds in the head; its engine alone writes the same number each time.
void correct_cura_head(std::string& text, double share) {
  constexpr std::string_view placeholder = "6666";
  for (const std::string_view tag : {";TIME:", ";PRINT.TIME:"}) {
    const std::size_t at = text.substr(0, head_bytes).find(tag);
    if (at == text.npos) continue;
    const std::size_t begin = at + tag.size(), end = std::min(text.find('\n', begin), text.size());
    const auto told_s = number<double>(std::string_view(text).substr(begin, end - begin));
    if (!told_s || text.compare(begin, end - begin, placeholder) == 0) continue;
    text.replace(begin, end - begin, fmt::format("{}", std::lround(*told_s * share)));
  }
}

/// The slicer's own estimates, longer by as much as the print is.
void correct_config_estimates(std::string& text, double share) {
  constexpr std::array<std::string_view, 4> tags = {
      "\n; estimated printing time (normal mode) = ", "\n; estimated printing time (silent mode) = ",
      "\n; model printing time: ", "; total estimated time: "};
  for (const std::string_view tag : tags) {
    const std::size_t at = text.rfind(tag);
    if (at == text.npos) continue;
    const std::size_t begin = at + tag.size(), end = std::min(text.find_first_of("\n;", begin), text.size());
    const double told_s = seconds_of(std::string_view(text).substr(begin, end - begin));
    if (told_s > 0) text.replace(begin, end - begin, duration_in_slicers_words(told_s * share));
  }
}

/// Minutes of the printer's quiet mode for each usual one, as the file tells them first.
double silent_share(std::string_view text) {
  const auto first = [&](std::string_view line, std::string_view word) {
    const std::size_t at = text.find(line), end = std::min(text.find('\n', at), text.size());
    const std::size_t found = at == text.npos ? at : text.substr(0, end).find(word, at);
    return found == text.npos ? std::nullopt : number<double>(trimmed(text.substr(found + 2, end - found - 2)));
  };
  const auto usual = first("M73 P", " R"), silent = first("M73 Q", " S");
  return usual && silent && *usual > 0 && *silent > 0 ? *silent / *usual : 1;
}

}  // namespace

std::string with_progress(const GcodePrint& after, const Timeline& time, double share) {
  const std::string_view elapsed = words_of(after)->elapsed;
  const std::string_view text = *after.text;
  const double silent = silent_share(text);
  std::string result;
  result.reserve(text.size());
  double done_s = 0;
  std::size_t move = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    const bool tells_elapsed = !elapsed.empty() && line.starts_with(elapsed);
    const bool is_silent = line.starts_with("M73 Q"), tells_rest = is_silent || line.starts_with("M73 P");
    if (tells_elapsed || tells_rest)
      for (; move < after.moves.size() && after.moves[move].offset < at; ++move) done_s += time.duration_s[move];
    if (tells_elapsed) {
      result += fmt::format("{}{:.6f}", elapsed, done_s * share);
    } else if (tells_rest) {
      const double left_s = std::max(0., time.print_time_s - done_s);
      const bool ends = move == after.moves.size() || left_s < 1;
      const std::string_view rest = is_silent ? " S" : " R";
      result += fmt::format("M73 {}{}", is_silent ? 'Q' : 'P',
                            ends ? 100 : std::min(99, int(100 * done_s / time.print_time_s)));
      if (line.find(rest) != line.npos)
        result += fmt::format("{}{}", rest, ends ? 0 : std::lround(left_s * share * (is_silent ? silent : 1) / 60));
    } else {
      result += line;
    }
    if (end < text.size()) result += '\n';
    at = end + 1;
  }
  return result;
}

void correct_estimates(std::string& text, const GcodePrint& before, double longer) {
  correct_config_estimates(text, longer);
  if (before.facts.dialect == Dialect::cura) correct_cura_head(text, longer);
}

}  // namespace cleancolor
