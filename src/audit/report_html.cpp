#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "audit/comparison.hpp"
#include "audit/html_parts.hpp"
#include "audit/ooze_keys.hpp"
#include "audit/pictures.hpp"
#include "audit/report.hpp"
#include "audit/report_words.hpp"
#include "audit/sides.hpp"
#include "base/duration_text.hpp"

namespace cleancolor {
namespace {

constexpr double layer_width_px = 640;  // two of them fit beside each other

/// How wide pictures are drawn that stand alone, or in the column of a file.
struct PictureWidths {
  int side_px = 420;
  double plot_px = 900;
};
constexpr PictureWidths of_one = {}, of_several = {.side_px = 260, .plot_px = 600};

constexpr std::size_t layers_of_several = 2;  // drawn of each file, so that the page stays small

std::string unit_text(std::string_view unit) {
  return unit == "mm3" ? "mm³" : unit == "cm3" ? "cm³" : unit == "1" ? "" : html_text(unit);
}

const ScenarioResult& shown(const AuditedFile& file, const ReportOptions& options) {
  return file.result->scenarios[options.scenario];
}

std::string card(std::string_view name, const std::string& value, std::string_view unit, const std::string& beside) {
  return fmt::format("<div class=\"card\"><span>{}</span><b>{} <small>{}</small></b><span>{}</span></div>\n", name,
                     value, unit, beside);
}

std::string figure_card(std::string_view name, const AuditedFile& file, const ReportOptions& options,
                        std::string_view figure) {
  const FigureInfo& info = *find_figure(figure);
  std::string beside;
  for (const ScenarioResult& s : file.result->scenarios)
    if (s.name != shown(file, options).name && (s.name == "worst" || s.name == "model"))
      beside = fmt::format("{}: {}", s.name, figure_text(info.of(s.total), info.unit));
  return card(name, figure_text(info.of(shown(file, options).total), info.unit), unit_text(info.unit), beside);
}

std::string cards(const AuditedFile& file, const ReportOptions& options) {
  const AuditResult& result = *file.result;
  double part_g = 0, auxiliary_g = 0, mm = 0;
  for (const NozzleUse& use : result.nozzles) {
    part_g += use.part_g;
    auxiliary_g += use.auxiliary_g;
    mm += use.part_filament_mm + use.auxiliary_filament_mm;
  }
  const auto grams = [](double g) { return fmt::format("{:.1f}", g); };
  return "<div class=\"cards\">\n" + figure_card("smears", file, options, "smear_volume") +
         figure_card("holes", file, options, "hole_volume") +
         card("zippers", figure_text(shown(file, options).total.zippers_visible, "1"), "",
              fmt::format("as visible as they are; {:.0f} in all", shown(file, options).total.zippers)) +
         card("time", duration_text(result.print_time_s), "", "without waiting for heaters") +
         card("filament of the part", grams(part_g), "g", fmt::format("{} in all", metres_text(mm))) +
         card("thrown away", grams(auxiliary_g), "g", fmt::format("{} tool changes", result.tool_changes)) + "</div>\n";
}

std::string verdicts(const AuditedFile& file, const ReportOptions& options) {
  const std::string text = verdict(*file.print, *file.result, options.scenario);
  return fmt::format("<p class=\"verdict\">{} <span class=\"pale\">(scenario {})</span></p>\n", html_text(text),
                     shown(file, options).name);
}

std::string warnings(const AuditedFile& file) {
  if (file.warnings.empty()) return "";
  std::string html = "<div class=\"notice\"><strong>Warnings</strong><ul>\n";
  for (const std::string& w : file.warnings) html += fmt::format("<li>{}</li>\n", html_text(w));
  return html + "</ul></div>\n";
}

std::string side_pictures(const AuditedFile& file, const ReportOptions& options, int width_px) {
  std::string html =
      "<h2>From four sides</h2>\n<p class=\"pale\">Predicted smears in the colour of the nozzle that "
      "leaves them; holes are dark.</p>\n<div class=\"sides\">\n";
  for (const Side& side : sides(*file.print, *file.machine, *file.result, options.scenario, width_px))
    html += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n",
                        html_png(side.png, "the print from the " + side.name), side.name);
  return html + "</div>\n";
}

std::string height_plot(const AuditedFile& file, const ReportOptions& options, double width_px) {
  const auto curves = height_curves(*file.print, *file.machine, *file.result, options.scenario);
  if (curves.empty()) return "";
  return fmt::format("<h2>Over the height</h2>\n<figure>{}</figure>\n",
                     html_picture(height_picture(curves, width_px), "volume of smears and holes in each layer"));
}

std::string layer_pictures(const AuditedFile& file, const ReportOptions& options) {
  const auto layers = worst_layers(shown(file, options), options.worst_layers);
  if (layers.empty()) return "";
  std::string html = "<h2>Worst layers</h2>\n<div class=\"layers\">\n";
  for (const std::uint32_t layer : layers)
    html += fmt::format("<figure>{}</figure>\n",
                        html_picture(layer_picture(*file.print, *file.machine, *file.result, options.scenario, layer,
                                                   {.width_px = layer_width_px}),
                                     fmt::format("layer {} from above", layer + 1)));
  return html + "</div>\n";
}

std::string places(const AuditedFile& file, const ReportOptions& options) {
  HtmlTable table{.head = {"place", "layer", "z, mm", "x, y, mm", "mm³", "while"}, .rows = {}, .left_columns = {5}};
  for (const Place& p : worst_places(shown(file, options), options.places))
    table.rows.push_back({place_text(p), fmt::format("{}", p.layer + 1),
                          fmt::format("{:.2f}", file.print->layers[p.layer].z_mm),
                          fmt::format("{:.1f}, {:.1f}", p.at_mm.x, p.at_mm.y), fmt::format("{:.3f}", p.mm3),
                          p.travel ? "travelling" : "printing"});
  return table.rows.empty() ? "" : "<h2>Worst places</h2>\n" + html_table(table);
}

std::string figures(const AuditedFile& file, bool with_help) {
  HtmlTable table{.head = {"figure"}, .rows = {}};
  for (const ScenarioResult& s : file.result->scenarios) table.head.push_back(html_text(s.name));
  table.head.emplace_back("");
  table.left_columns = {table.head.size() - 1};
  if (with_help) {
    table.left_columns.push_back(table.head.size());
    table.head.emplace_back("what it is");
  }
  for (const FigureInfo& f : figure_table()) {
    std::vector<std::string> row = {fmt::format("<code>{}</code>", f.name)};
    for (const ScenarioResult& s : file.result->scenarios) row.push_back(figure_text(f.of(s.total), f.unit));
    row.push_back(unit_text(f.unit));
    if (with_help) row.push_back(html_text(f.help));
    table.rows.push_back(std::move(row));
  }
  const std::vector<PairFigures>& pairs = file.result->scenarios.front().pairs;
  if (!pairs.empty()) table.rows.push_back({"<code>smear_volume</code> by colours"});
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    std::vector<std::string> row = {fmt::format("T{} over T{}", pairs[i].nozzle, pairs[i].over)};
    for (const ScenarioResult& s : file.result->scenarios)
      row.push_back(figure_text(s.pairs[i].figures.smear_volume(), "mm3"));
    row.push_back(unit_text("mm3"));
    if (with_help) row.emplace_back("");
    table.rows.push_back(std::move(row));
  }
  return "<h2>Figures</h2>\n" + html_table(table);
}

std::string filament(const AuditResult& result) {
  HtmlTable table{.head = {"nozzle", "part, m", "g", "thrown away, m", "g"}, .rows = {}};
  for (std::size_t i = 0; i < result.nozzles.size(); ++i) {
    const NozzleUse& u = result.nozzles[i];
    table.rows.push_back({fmt::format("T{}", i), fmt::format("{:.2f}", u.part_filament_mm / 1000),
                          fmt::format("{:.2f}", u.part_g), fmt::format("{:.2f}", u.auxiliary_filament_mm / 1000),
                          fmt::format("{:.2f}", u.auxiliary_g)});
  }
  return fmt::format(
             "<h2>Time and filament</h2>\n<p>{} without waiting for heaters; {} of travel, {} tool changes.</p>\n",
             duration_text(result.print_time_s), metres_text(result.travel_mm), result.tool_changes) +
         html_table(table);
}

std::string numbers_of(const OozeParameters& ooze, const OozeKey& key) {
  const double value = key.of(ooze);
  if (key.unit.empty()) return value != 0 ? "yes" : "no";
  return std::isinf(value) ? "any" : fmt::format("{:g}", value);
}

std::string assumptions(const AuditedFile& file) {
  const AuditMachine& machine = *file.machine;
  HtmlTable nozzles{.head = {"nozzle", "X, mm", "Y, mm", "filament, mm", "g/cm³"}, .rows = {}};
  for (std::size_t i = 0; i < machine.nozzles.size(); ++i) {
    const AuditNozzle& n = machine.nozzles[i];
    nozzles.rows.push_back({fmt::format("T{}", i), fmt::format("{:g}", n.offset_mm.x),
                            fmt::format("{:g}", n.offset_mm.y), fmt::format("{:g}", n.filament_diameter_mm),
                            fmt::format("{:g}", n.filament_density_g_cm3)});
  }
  HtmlTable numbers{.head = {"ooze"}, .rows = {}};
  for (const Scenario& s : *file.scenarios)
    for (std::size_t i = 0; i < s.ooze.size(); ++i)
      numbers.head.push_back(html_text(s.ooze.size() > 1 ? fmt::format("{}, T{}", s.name, i) : s.name));
  for (const OozeKey& key : ooze_keys()) {
    std::vector<std::string> row = {
        fmt::format("{}{}", html_text(key.help), key.unit.empty() ? "" : fmt::format(", {}", unit_text(key.unit)))};
    for (const Scenario& s : *file.scenarios)
      for (const OozeParameters& ooze : s.ooze) row.push_back(numbers_of(ooze, key));
    numbers.rows.push_back(std::move(row));
  }
  std::string html = fmt::format(
      "<h2>What was assumed</h2>\n<p>Where the nozzles are: by {}. Made up for in {}: by {}. Idle nozzles are "
      "{}.</p>\n",
      html_text(machine.offsets_source.empty() ? "the only nozzle" : machine.offsets_source),
      offsets_in_text(machine.offsets_in), html_text(machine.offsets_in_source), idle_nozzle_text(machine.idle_nozzle));
  html += html_table(nozzles) + "<h3>Scenarios</h3>\n<ul>\n";
  for (const Scenario& s : *file.scenarios)
    html += fmt::format("<li><strong>{}</strong>: {}</li>\n", html_text(s.name), html_text(s.help));
  return html + "</ul>\n" + html_table(numbers);
}

std::string unknown_commands_html(const GcodePrint& print) {
  constexpr std::size_t most = 200;
  if (print.unknown.empty()) return "";
  HtmlTable table{.head = {"command", "times", "first in line"}, .rows = {}};
  for (const UnknownCommand& u : print.unknown) {
    if (table.rows.size() == most) {
      table.rows.push_back({fmt::format("and {} more", print.unknown.size() - most)});
      break;
    }
    table.rows.push_back({fmt::format("<code>{}</code>", html_text(u.name)), fmt::format("{}", u.count),
                          fmt::format("{}", u.first_line)});
  }
  return "<h2>Unknown commands</h2>\n<p class=\"pale\">They were passed over.</p>\n" + html_table(table);
}

std::string summary_part(const AuditedFile& file, const ReportOptions& options) {
  return fmt::format("<h1>{}</h1>\n<p class=\"pale\">{}; {} layers, {:.2f} mm high</p>\n", html_text(file.name),
                     html_text(producer_text(*file.print)), file.print->layers.size(),
                     file.print->layers.empty() ? 0 : file.print->layers.back().z_mm) +
         verdicts(file, options) + cards(file, options) + warnings(file);
}

std::string pictures_part(const AuditedFile& file, const ReportOptions& options, bool alone) {
  const PictureWidths widths = alone ? of_one : of_several;
  return side_pictures(file, options, widths.side_px) + height_plot(file, options, widths.plot_px) +
         layer_pictures(file, options) + places(file, options) + figures(file, alone) + filament(*file.result) +
         assumptions(file) + unknown_commands_html(*file.print);
}

std::string comparison_table(std::span<const AuditedFile> files) {
  HtmlTable table{.head = {""}, .rows = {}};
  for (const AuditedFile& file : files) table.head.push_back(html_text(file.name));
  std::string group;
  for (const ComparisonRow& r : comparison(files)) {
    if (r.group != group) table.rows.push_back({html_text(group = r.group)});
    std::vector<std::string> row = {
        fmt::format("{}{}{}", html_text(r.name), r.unit.empty() ? "" : ", ", unit_text(r.unit))};
    for (const std::string& text : r.texts) row.push_back(html_text(text));
    table.rows.push_back(std::move(row));
  }
  return html_table(table);
}

/// Smears of all nozzles together, one curve a file.
std::string common_height_plot(std::span<const AuditedFile> files, const ReportOptions& options) {
  constexpr std::array<std::uint32_t, 8> palette = {0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7,
                                                    0x555555, 0xE69F00, 0x56B4E9, 0x8F3B00};
  std::vector<HeightCurve> curves;
  for (std::size_t i = 0; i < files.size(); ++i) {
    HeightCurve curve{files[i].name.substr(files[i].name.rfind('/') + 1), colour(palette[i % palette.size()]), {}};
    const ScenarioResult& s = shown(files[i], options);
    for (std::size_t l = 0; l < s.layers.size(); ++l)
      curve.points.push_back({files[i].print->layers[l].z_mm, s.layers[l].smear_volume()});
    curves.push_back(std::move(curve));
  }
  return fmt::format("<h2>Smears over the height <span class=\"pale\">(scenario {})</span></h2>\n<figure>{}</figure>\n",
                     shown(files.front(), options).name,
                     html_picture(height_picture(curves, 1200), "volume of smears in each layer of every file"));
}

}  // namespace

std::string audit_html(std::span<const AuditedFile> files, const ReportOptions& options, const ReportScene& scene) {
  const HtmlScript script{.sha256 = scene.script_sha256, .style = scene.style};
  const auto sheet = [](const std::string& html) { return "<div class=\"sheet\">\n" + html + "</div>\n"; };
  if (files.size() == 1)
    return html_page("Ooze audit of " + files[0].name,
                     "<body>\n" + sheet(summary_part(files[0], options)) + scene.place +
                         sheet(pictures_part(files[0], options, /*alone=*/true)) + scene.scripts + "</body>\n",
                     script);
  ReportOptions each = options;
  each.worst_layers = std::min(options.worst_layers, layers_of_several);
  std::string common = "<h1>Ooze audit</h1>\n";
  if (!files.empty())
    common += fmt::format("<p class=\"{}\">{}</p>\n", part_difference(files) > same_part_share ? "notice" : "pale",
                          html_text(same_part_text(files))) +
              comparison_table(files) + common_height_plot(files, options);
  std::string parts = "<h2>File by file</h2>\n<div class=\"files\">\n";
  for (const AuditedFile& file : files)
    parts += "<article>\n" + summary_part(file, each) + pictures_part(file, each, /*alone=*/false) + "</article>\n";
  return html_page("Ooze audit",
                   "<body class=\"several\">\n" + sheet(common) + scene.place + sheet(parts + "</div>\n") +
                       scene.scripts + "</body>\n",
                   script);
}

}  // namespace cleancolor
