#include "audit/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "audit/report_words.hpp"
#include "base/duration_text.hpp"

namespace cleancolor {
namespace {

const ScenarioResult* scenario_named(const AuditedFile& file, std::string_view name) {
  const auto found = std::ranges::find(file.result->scenarios, name, &ScenarioResult::name);
  return found == file.result->scenarios.end() ? nullptr : &*found;
}

void add_figures(std::span<const AuditedFile> files, const std::string& scenario, std::vector<ComparisonRow>& rows) {
  for (const FigureInfo& figure : figure_table()) {
    if (!figure.main || figure.name == "tool_changes") continue;  // those are of the print
    ComparisonRow row{.group = scenario, .name = std::string(figure.name), .unit = std::string(figure.unit)};
    if (row.unit == "1") row.unit.clear();
    for (const AuditedFile& file : files) {
      row.values.push_back(figure.of(scenario_named(file, scenario)->total));
      row.texts.push_back(figure_text(row.values.back(), figure.unit));
    }
    rows.push_back(std::move(row));
  }
}

double part_mm3(const AuditResult& result) {
  double mm3 = 0;
  for (const NozzleUse& use : result.nozzles) mm3 += use.part_mm3;
  return mm3;
}

/// Rows about the print, made of one number of each result.
class PrintRows {
 public:
  PrintRows(std::span<const AuditedFile> files, std::vector<ComparisonRow>& rows) : files_(files), rows_(rows) {}

  void add(std::string name, std::string unit, const std::function<double(const AuditResult&)>& value,
           const std::function<std::string(double)>& text) {
    ComparisonRow row{.group = "print", .name = std::move(name), .unit = std::move(unit)};
    for (const AuditedFile& file : files_) {
      row.values.push_back(value(*file.result));
      row.texts.push_back(text(row.values.back()));
    }
    rows_.push_back(std::move(row));
  }

  void add_filament(std::size_t nozzle, const std::string& kind, double NozzleUse::* mm, double NozzleUse::* g) {
    const auto of = [nozzle](double NozzleUse::* field) {
      return [=](const AuditResult& r) { return nozzle < r.nozzles.size() ? r.nozzles[nozzle].*field : 0.0; };
    };
    const std::string name = fmt::format("T{} {}", nozzle, kind);
    add(name, "m", of(mm), [](double v) { return fmt::format("{:.2f}", v / 1000); });
    add(name, "g", of(g), [](double v) { return fmt::format("{:.2f}", v); });
  }

 private:
  std::span<const AuditedFile> files_;
  std::vector<ComparisonRow>& rows_;
};

}  // namespace

std::vector<ComparisonRow> comparison(std::span<const AuditedFile> files) {
  std::vector<ComparisonRow> rows;
  if (files.empty()) return rows;
  for (const ScenarioResult& scenario : files.front().result->scenarios) {
    const bool everywhere =
        std::ranges::all_of(files, [&](const AuditedFile& f) { return scenario_named(f, scenario.name) != nullptr; });
    if (everywhere) add_figures(files, scenario.name, rows);
  }
  PrintRows print(files, rows);
  const auto whole = [](double v) { return fmt::format("{:.0f}", v); };
  print.add("layers", "", [](const AuditResult& r) { return double(r.layers); }, whole);
  print.add("tool changes", "", [](const AuditResult& r) { return double(r.tool_changes); }, whole);
  print.add("time", "", [](const AuditResult& r) { return r.print_time_s; }, duration_text);
  print.add(
      "travel", "m", [](const AuditResult& r) { return r.travel_mm; },
      [](double mm) { return fmt::format("{:.1f}", mm / 1000); });
  print.add("part plastic", "cm3", part_mm3, [](double mm3) { return fmt::format("{:.3f}", mm3 / 1000); });
  std::size_t nozzles = 0;
  for (const AuditedFile& file : files) nozzles = std::max(nozzles, file.result->nozzles.size());
  for (std::size_t i = 0; i < nozzles; ++i) {
    print.add_filament(i, "part", &NozzleUse::part_filament_mm, &NozzleUse::part_g);
    print.add_filament(i, "auxiliary", &NozzleUse::auxiliary_filament_mm, &NozzleUse::auxiliary_g);
  }
  return rows;
}

double part_difference(std::span<const AuditedFile> files) {
  if (files.empty()) return 0;
  double least = part_mm3(*files.front().result), most = least;
  for (const AuditedFile& file : files) {
    least = std::min(least, part_mm3(*file.result));
    most = std::max(most, part_mm3(*file.result));
  }
  if (most <= 0) return 0;
  return least > 0 ? most / least - 1 : 1;
}

std::string same_part_text(std::span<const AuditedFile> files) {
  const double percent = 100 * part_difference(files);
  if (part_difference(files) <= same_part_share)
    return fmt::format("The files print the same part: its plastic differs by {:.1f} %.", percent);
  return fmt::format(
      "The files do not print the same part: its plastic differs by {:.1f} %, more than {:.0f} %. Compare files of the "
      "same meshes, layers, shells and infill.",
      percent, 100 * same_part_share);
}

}  // namespace cleancolor
