#include <fmt/format.h>

#include <algorithm>

#include "audit/comparison.hpp"
#include "audit/report.hpp"
#include "audit/report_words.hpp"
#include "base/duration_text.hpp"
#include "base/printable.hpp"

namespace cleancolor {
namespace {

constexpr std::size_t line_length = 100;

/// Words on lines of at most line_length, those after the first indented.
std::string wrapped(std::string_view text, std::size_t indent) {
  std::string lines;
  std::size_t column = 0;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    if (column > indent && column + 1 + word.size() > line_length) {
      lines += '\n' + std::string(indent, ' ');
      column = indent;
    } else if (column > 0) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += word.size();
  }
  return lines + '\n';
}

std::string row(std::string_view name, std::string_view text) {
  return wrapped(fmt::format("{:<13} {}", name, text), 14);
}

std::string offsets_text(const AuditMachine& machine) {
  std::string text;
  for (std::size_t i = 0; i < machine.nozzles.size(); ++i) {
    const Vec2 at = machine.nozzles[i].offset_mm;
    text += fmt::format("{}T{} at {:g},{:g}", i == 0 ? "" : "; ", i, at.x, at.y);
  }
  return text;
}

std::string nozzles_text(const AuditMachine& machine) {
  if (machine.nozzles.size() < 2) return row("nozzles", "one");
  return row("nozzles", fmt::format("{} mm, by {}; idle ones {}", offsets_text(machine),
                                    printable(machine.offsets_source), idle_nozzle_text(machine.idle_nozzle))) +
         row("offsets in",
             fmt::format("{}, by {}", offsets_in_text(machine.offsets_in), printable(machine.offsets_in_source)));
}

std::string head(const AuditedFile& file) {
  const AuditResult& result = *file.result;
  const double top_mm = file.print->layers.empty() ? 0 : file.print->layers.back().z_mm;
  return printable(file.name) + "\n" + row("written by", producer_text(*file.print)) +
         row("layers",
             fmt::format("{}, up to {:.2f} mm; {} tool changes", result.layers, top_mm, result.tool_changes)) +
         row("time", fmt::format("{} without waiting for heaters; {} of travel", duration_text(result.print_time_s),
                                 metres_text(result.travel_mm))) +
         nozzles_text(*file.machine);
}

std::string filament_table(const AuditResult& result) {
  std::string table = fmt::format("\n{:<10}{:>24}{:>30}\n", "filament", "part", "thrown away");
  for (std::size_t i = 0; i < result.nozzles.size(); ++i) {
    const NozzleUse& use = result.nozzles[i];
    if (use.part_filament_mm + use.auxiliary_filament_mm == 0) continue;
    table += fmt::format("T{:<9}{:>12}{:>10.2f} g{:>18}{:>10.2f} g\n", i, metres_text(use.part_filament_mm), use.part_g,
                         metres_text(use.auxiliary_filament_mm), use.auxiliary_g);
  }
  return table;
}

/// The scenarios in the order of the table: the chosen one, then worst and model. Variants have a table of their own.
std::vector<std::size_t> shown_scenarios(const AuditedFile& file, std::size_t chosen) {
  std::vector<std::size_t> shown = {chosen};
  for (std::size_t i = 0; i < file.result->scenarios.size(); ++i) {
    const std::string& name = file.result->scenarios[i].name;
    if (i != chosen && (name == "worst" || name == "model")) shown.push_back(i);
  }
  return shown;
}

std::string figures_table(const AuditedFile& file, const std::vector<std::size_t>& shown) {
  std::string table = fmt::format("\n{:<34}", "figure");
  for (const std::size_t s : shown) table += fmt::format("{:>12}", file.result->scenarios[s].name);
  table += '\n';
  for (const FigureInfo& figure : figure_table()) {
    if (!figure.main || figure.name == "tool_changes") continue;
    table += fmt::format("{:<34}", figure.name);
    for (const std::size_t s : shown)
      table += fmt::format("{:>12}", figure_text(figure.of(file.result->scenarios[s].total), figure.unit));
    table += figure.unit == "1" ? "\n" : fmt::format(" {}\n", figure.unit);
  }
  return table;
}

/// Nothing where there is only one pair of colours each way, or none.
std::string pairs_table(const AuditedFile& file, const std::vector<std::size_t>& shown) {
  const std::vector<PairFigures>& pairs = file.result->scenarios[shown.front()].pairs;
  if (pairs.empty()) return "";
  std::string table = fmt::format("\n{:<34}", "smear_volume by colours");
  for (const std::size_t s : shown) table += fmt::format("{:>12}", file.result->scenarios[s].name);
  table += '\n';
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    table += fmt::format("{:<34}", fmt::format("T{} over T{}", pairs[i].nozzle, pairs[i].over));
    for (const std::size_t s : shown)
      table += fmt::format("{:>12}", figure_text(file.result->scenarios[s].pairs[i].figures.smear_volume(), "mm3"));
    table += " mm3\n";
  }
  return table;
}

std::string variants_table(const AuditedFile& file, const std::vector<std::size_t>& shown) {
  std::string table;
  for (std::size_t i = 0; i < file.result->scenarios.size(); ++i) {
    if (std::ranges::find(shown, i) != shown.end()) continue;
    const ScenarioResult& s = file.result->scenarios[i];
    if (table.empty())
      table = fmt::format("\n{:<34}{:>12}{:>12}{:>12}{:>12}\n", "sensitivity, mm3", "smear", "inner", "hole", "wiped");
    table += fmt::format("{:<34}{:>12.2f}{:>12.2f}{:>12.2f}{:>12.2f}\n", s.name, s.total.smear_volume(),
                         s.total.inner_volume(), s.total.hole_volume, s.total.wiped_volume);
  }
  return table;
}

std::string places_table(const AuditedFile& file, const ReportOptions& options) {
  const ScenarioResult& scenario = file.result->scenarios[options.scenario];
  const std::vector<Place> places = worst_places(scenario, options.places);
  if (places.empty()) return "";
  std::string table = fmt::format("\n{:<24}{:>8}{:>10}{:>10}{:>10}{:>10}  {}\n", "worst places", "layer", "z mm",
                                  "x mm", "y mm", "mm3", "while");
  for (const Place& p : places) {
    table += fmt::format("{:<24}{:>8}{:>10.2f}{:>10.1f}{:>10.1f}{:>10.3f}  {}\n", place_text(p), p.layer + 1,
                         file.print->layers[p.layer].z_mm, p.at_mm.x, p.at_mm.y, p.mm3,
                         p.travel ? "travelling" : "printing");
  }
  return table;
}

std::string unknown_commands(const GcodePrint& print) {
  constexpr std::size_t most = 12;
  if (print.unknown.empty()) return "";
  std::string text = "unknown commands:";
  for (std::size_t i = 0; i < std::min(most, print.unknown.size()); ++i) {
    const UnknownCommand& u = print.unknown[i];
    text += fmt::format("{} {} ({})", i == 0 ? "" : ",", printable(u.name).substr(0, 60), u.count);
  }
  if (print.unknown.size() > most) text += fmt::format(" and {} more", print.unknown.size() - most);
  return "\n" + wrapped(text, 2);
}

}  // namespace

std::string audit_text(const AuditedFile& file, const ReportOptions& options) {
  const std::vector<std::size_t> shown = shown_scenarios(file, options.scenario);
  return head(file) + filament_table(*file.result) + figures_table(file, shown) + pairs_table(file, shown) +
         variants_table(file, shown) + places_table(file, options) + unknown_commands(*file.print) + "\n" +
         wrapped(fmt::format("{}: {}", file.result->scenarios[options.scenario].name,
                             verdict(*file.print, *file.result, options.scenario)),
                 2);
}

std::string comparison_text(std::span<const AuditedFile> files) {
  constexpr std::size_t name_width = 34, column = 13;
  constexpr std::size_t columns = (line_length - name_width) / column;
  std::string text;
  for (std::size_t i = 0; i < files.size(); ++i)
    text += fmt::format("{:>3}  {}, {}\n", i + 1, printable(files[i].name), producer_text(*files[i].print));
  const std::vector<ComparisonRow> rows = comparison(files);
  for (std::size_t first = 0; first < files.size(); first += columns) {
    const std::size_t last = std::min(files.size(), first + columns);
    std::string group;
    for (const ComparisonRow& r : rows) {
      if (r.group != group) {
        group = r.group;
        text += fmt::format("\n{:<{}}", group, name_width);
        for (std::size_t i = first; i < last; ++i) text += fmt::format("{:>{}}", i + 1, column);
        text += '\n';
      }
      text += fmt::format("  {:<{}}", r.unit.empty() ? r.name : fmt::format("{}, {}", r.name, r.unit), name_width - 2);
      for (std::size_t i = first; i < last; ++i) text += fmt::format("{:>{}}", r.texts[i], column);
      text += '\n';
    }
  }
  return text + "\n" + wrapped(same_part_text(files), 0);
}

}  // namespace cleancolor
