#include "explain/plan_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace cleancolor {
namespace {

constexpr double plainly_seen = 0.1;

std::string visibility_text(double v) {
  return v == 0 ? "-" : fmt::format("{:.2f}", v);
}

/// Each once, in the order in which they come.
std::vector<std::string_view> roles_of(const Path& run) {
  std::vector<std::string_view> names;
  for (const Stretch& s : run.stretches) {
    const std::string_view name = s.road.role == Role::rampart  ? "Rampart"
                                  : s.road.role == Role::refill ? "Refill"
                                                                : role_name(s.road.role);
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

double rounded(double v, double step) {
  return std::round(v / step) * step;
}

}  // namespace

std::string zone_name(int zone) {
  std::string name;
  for (int z = zone; z >= 0; z = z / 26 - 1) name.insert(name.begin(), char('A' + z % 26));
  return name;
}

PlanTotals totals(const Explanation& plan) {
  PlanTotals t;
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    const ExplainedRun& run = plan.runs[k];
    t.printed_mm += run.length_mm;
    t.hops_mm += run.hop_mm;
    t.longest_hop_mm = std::max(t.longest_hop_mm, run.hop_mm);
    t.hops_over_foreign += run.hop_foreign > 0;
    const OuterWall wall = outer_wall(plan.printed.runs[k].path);
    t.outer_walls += wall.last > wall.first;
    t.visible_starts += wall.last > wall.first && run.start_visibility > plainly_seen;
  }
  for (const Roadmap& map : plan.roadmaps) {
    t.nodes += map.nodes_mm.size();
    t.arcs += map.arcs.size() / 2;
    t.arcs_over_foreign += std::size_t(std::ranges::count_if(map.arcs, [](const Arc& a) { return a.foreign > 0; })) / 2;
  }
  return t;
}

std::string plan_text(const Explanation& plan, const GcodePrint& print) {
  const PlanTotals t = totals(plan);
  std::string text =
      fmt::format("{}, layer {} of {}, z {:.2f} mm\n\n", print.name, plan.layer + 1, print.layers.size(), plan.z_mm);
  text += fmt::format("{:>4}  {:>8}  {:>4}  {:<36}  {:>9}  {:>5}  {:>8}  {:>8}  {:>8}\n", "path", "extruder", "zone",
                      "role", "length mm", "start", "hop mm", "on hop", "idle");
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    const ExplainedRun& run = plan.runs[k];
    const Path& path = plan.printed.runs[k].path;
    text +=
        fmt::format("{:>4}  {:>8}  {:>4}  {:<36}  {:>9.1f}  {:>5}  {:>8.1f}  {:>8}  {:>8}\n", k + 1, path.extruder + 1,
                    run.zone < 0 ? "-" : zone_name(run.zone), fmt::format("{}", fmt::join(roles_of(path), ", ")),
                    run.length_mm, visibility_text(run.start_visibility), run.hop_mm, visibility_text(run.hop_foreign),
                    visibility_text(run.idle_foreign));
  }
  text += fmt::format("\n{} paths, {:.0f} mm of road; hops {:.0f} mm, the longest {:.0f} mm\n", plan.runs.size(),
                      t.printed_mm, t.hops_mm, t.longest_hop_mm);
  text += fmt::format("{} of {} hops cross visible plastic of another colour; {} of {} outer walls begin in sight\n",
                      t.hops_over_foreign, plan.runs.size(), t.visible_starts, t.outer_walls);
  text += fmt::format("roadmap: {} nodes, {} arcs, {} of them over visible plastic of another colour\n", t.nodes,
                      t.arcs, t.arcs_over_foreign);
  text +=
      "start: visibility where the path, or the outer wall in it, begins, from 0 to 1; on hop, idle: the largest\n"
      "visibility of another colour's plastic under any nozzle on the way there, under idle nozzles while it is "
      "printed\n";
  return text;
}

std::string plan_json(const Explanation& plan, const GcodePrint& print) {
  const PlanTotals t = totals(plan);
  nlohmann::ordered_json json;
  json["file"] = print.name;
  json["layer"] = plan.layer + 1;
  json["layers"] = print.layers.size();
  json["z_mm"] = plan.z_mm;
  auto& paths = json["paths"] = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    const ExplainedRun& run = plan.runs[k];
    const Path& path = plan.printed.runs[k].path;
    nlohmann::ordered_json row;
    row["path"] = k + 1;
    row["extruder"] = path.extruder + 1;
    row["zone"] = run.zone < 0 ? "" : zone_name(run.zone);
    row["roles"] = roles_of(path);
    row["length_mm"] = rounded(run.length_mm, 1e-3);
    row["start_mm"] = {rounded(path.start().x, 1e-3), rounded(path.start().y, 1e-3)};
    row["start_visibility"] = rounded(run.start_visibility, 1e-3);
    row["hop_mm"] = rounded(run.hop_mm, 1e-3);
    row["hop_foreign"] = rounded(run.hop_foreign, 1e-3);
    row["idle_foreign"] = rounded(run.idle_foreign, 1e-3);
    paths.push_back(std::move(row));
  }
  json["totals"] = {{"printed_mm", rounded(t.printed_mm, 1e-3)},
                    {"hops_mm", rounded(t.hops_mm, 1e-3)},
                    {"longest_hop_mm", rounded(t.longest_hop_mm, 1e-3)},
                    {"hops_over_foreign", t.hops_over_foreign},
                    {"outer_walls", t.outer_walls},
                    {"visible_starts", t.visible_starts}};
  json["roadmap"] = {{"nodes", t.nodes}, {"arcs", t.arcs}, {"arcs_over_foreign", t.arcs_over_foreign}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace cleancolor
