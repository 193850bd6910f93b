#include "replan/told_filament.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <optional>
#include <string_view>

#include "model/text_scan.hpp"
#include "replan/file_parts.hpp"

namespace cleancolor {
namespace {

constexpr std::size_t end_bytes = 1 << 18;  // figures stand behind the last road, before or in the configuration block

/// A figure within a text, as "1885.1" of "1885.1mm (4.5cm3)".
struct Figure {
  std::size_t begin = 0, size = 0;
  double value = 0;
};

std::vector<Figure> figures(std::string_view text, std::size_t begin, std::size_t end) {
  const auto is_digit = [&](std::size_t i) { return std::isdigit(static_cast<unsigned char>(text[i])) != 0; };
  std::vector<Figure> found;
  end = std::min(end, text.size());
  for (std::size_t i = begin; i < end; ++i) {
    if (!is_digit(i) || (i > begin && std::isalpha(static_cast<unsigned char>(text[i - 1])) != 0)) continue;
    std::size_t last = i;
    while (last < end && (is_digit(last) || text[last] == '.')) ++last;
    if (const auto value = number<double>(text.substr(i, last - i))) found.push_back({i, last - i, *value});
    i = last;
  }
  return found;
}

/// With as many digits behind the point as before.
std::string retold(std::string_view told, double value) {
  const std::size_t point = told.find('.');
  return fmt::format("{:.{}f}", value, point == told.npos ? 0 : told.size() - point - 1);
}

void retell(std::string& text, const Figure& figure, double value) {
  text.replace(figure.begin, figure.size, retold(std::string_view(text).substr(figure.begin, figure.size), value));
}

/// The shares that the figures of a line are of: of each tool, or of each that prints.
std::optional<std::vector<double>> shares_of(std::size_t count, const std::vector<double>& share) {
  if (count >= share.size()) {  // tools that print nothing may stand at the end, too
    std::vector<double> all = share;
    all.resize(count, 0.);
    return all;
  }
  std::vector<double> printing;
  std::ranges::copy_if(share, std::back_inserter(printing), [](double s) { return s > 0; });
  if (count == printing.size()) return printing;
  return std::nullopt;
}

struct Sums {
  double before = 0, after = 0;
};

/// The line at `at`, behind its tag. Returns: its sums; nothing where it stays.
std::optional<Sums> retell_list(std::string& text, std::size_t at, const std::vector<double>& share) {
  std::vector<Figure> list = figures(text, at, text.find('\n', at));
  const auto by = shares_of(list.size(), share);
  if (!by) return std::nullopt;
  Sums sums;
  for (std::size_t i = list.size(); i-- > 0;) {
    sums.before += list[i].value;
    sums.after += list[i].value * (*by)[i];
    retell(text, list[i], list[i].value * (*by)[i]);
  }
  return sums;
}

void retell_total(std::string& text, std::size_t search_from, std::string_view tag, const Sums& sums) {
  const std::size_t at = text.find(tag, search_from);
  if (at == text.npos || sums.before <= 0) return;
  const std::vector<Figure> total = figures(text, at + tag.size(), text.find('\n', at + 1));
  if (total.size() == 1) retell(text, total.front(), total.front().value * sums.after / sums.before);
}

/// PrusaSlicer: a line for each unit, with a figure for each tool.
void retell_lists(std::string& text, const std::vector<double>& share) {
  constexpr std::array<std::string_view, 3> tags = {
      "\n; filament used [mm] =", "\n; filament used [cm3] =", "\n; filament used [g] ="};
  const std::size_t from = text.size() - std::min(text.size(), end_bytes);
  std::optional<Sums> used, cost;
  for (const std::string_view tag : tags)
    if (const std::size_t at = text.find(tag, from); at != text.npos) used = retell_list(text, at + tag.size(), share);
  constexpr std::string_view cost_tag = "\n; filament cost =";
  if (const std::size_t at = text.find(cost_tag, from); at != text.npos)
    cost = retell_list(text, at + cost_tag.size(), share);
  if (used) retell_total(text, from, "\n; total filament used [g] =", *used);
  if (cost || used) retell_total(text, from, "\n; total filament cost =", cost ? *cost : *used);
}

/// Slic3r: a line for each tool that prints, with a figure for each unit.
void retell_lines(std::string& text, const std::vector<double>& share) {
  constexpr std::string_view tag = "\n; filament used =";
  std::vector<std::size_t> lines;
  for (std::size_t at = text.find(tag, text.size() - std::min(text.size(), end_bytes)); at != text.npos;
       at = text.find(tag, at + 1))
    lines.push_back(at + tag.size());
  const auto by = shares_of(lines.size(), share);
  if (!by) return;
  for (std::size_t i = lines.size(); i-- > 0;) {
    const std::vector<Figure> line = figures(text, lines[i], text.find('\n', lines[i]));
    for (std::size_t k = line.size(); k-- > 0;) retell(text, line[k], line[k].value * (*by)[i]);
  }
}

/// Cura and BambuStudio.
void retell_head(std::string& text, const std::vector<double>& share) {
  constexpr std::array<std::string_view, 4> tags = {
      ";Filament used:", "; total filament length [mm] :", "; total filament volume [cm^3] :",
      "; total filament weight [g] :"};
  for (const std::string_view tag : tags) {
    const std::size_t at = std::string_view(text).substr(0, head_bytes).find(tag);
    if (at != text.npos) retell_list(text, at + tag.size(), share);
  }
}

}  // namespace

std::vector<double> filament_of_tools_mm(const GcodePrint& print) {
  std::vector<double> sums;
  for (const GcodeMove& move : print.moves) {
    if (move.filament_mm == 0) continue;
    const auto tool = std::size_t(move.feeds);
    if (tool >= sums.size()) sums.resize(tool + 1, 0.);
    sums[tool] += move.filament_mm;
  }
  return sums;
}

void correct_filament(std::string& text, const GcodePrint& before, const GcodePrint& after) {
  std::vector<double> share = filament_of_tools_mm(after);
  const std::vector<double> old_mm = filament_of_tools_mm(before);
  share.resize(old_mm.size(), 0.);
  for (std::size_t tool = 0; tool < share.size(); ++tool)
    share[tool] = old_mm[tool] > 0 ? share[tool] / old_mm[tool] : 0;
  retell_lists(text, share);
  retell_lines(text, share);
  retell_head(text, share);
}

}  // namespace cleancolor
