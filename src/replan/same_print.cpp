#include "replan/same_print.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "base/parallel.hpp"

namespace cleancolor {
namespace {

constexpr double same_share = 1e-4;
constexpr double rounding_mm = 0.01;  // of filament
constexpr double seam_share = 0.02;   // of the roads' cells at most differ, where seams moved,
constexpr double seam_mm = 0.1;       // or so much of each run

using ToolRole = std::pair<int, Role>;

bool is_kept(const GcodeMove& move) {
  return move.role != Role::rampart && move.role != Role::refill;
}

/// Of one tool, at one height, um.
using ToolHeight = std::pair<int, std::int64_t>;

ToolHeight tool_height(const GcodeMove& move) {
  return {move.feeds, um_of(move.to_mm.z)};
}

/// What is kept, summed by what key_of(move) gives.
template <class KeyOf>
auto filament_mm(const GcodePrint& print, const std::set<Role>& without, KeyOf key_of) {
  std::map<decltype(key_of(print.moves.front())), double> sums;
  for (std::size_t i = 0; i < print.moves.size(); ++i)
    if (lays_plastic(print, i) && is_kept(print.moves[i]) && !without.contains(print.moves[i].role))
      sums[key_of(print.moves[i])] += print.moves[i].filament_mm;
  return sums;
}

template <class Key>
double value_of(const std::map<Key, double>& all, const Key& key) {
  const auto found = all.find(key);
  return found == all.end() ? 0 : found->second;
}

/// The first layer of a tool that takes another amount; nothing where all is the same but for rounding.
std::optional<std::string> changed_layer(const GcodePrint& before, const GcodePrint& after,
                                         const std::set<Role>& without) {
  const auto old_mm = filament_mm(before, without, tool_height), new_mm = filament_mm(after, without, tool_height);
  for (const auto& [place, mm] : old_mm) {
    const double now = value_of(new_mm, place);
    if (std::abs(now - mm) > same_share * mm + rounding_mm)
      return fmt::format("extruder {} pushes {:.3f} mm of filament at z {:.3f} instead of {:.3f}", place.first + 1, now,
                         double(place.second) * 1e-3, mm);
  }
  return std::nullopt;
}

/// 0.4 mm; more where roads are that long that there would be more of them than the text has bytes.
double cell_size_mm(const GcodePrint& print) {
  double sum_mm = 0, roads = 0;
  for (std::size_t i = 1; i < print.moves.size(); ++i)
    if (lays_plastic(print, i)) sum_mm += way_mm(print, i), ++roads;
  return 0.4 * std::max(1., sum_mm / (4e5 + 100 * roads));
}

/// Length of road in each cell of one tool and layer height, in cells that roads pass through their middles; ascending.
using Cell = std::pair<std::int64_t, std::int64_t>;
using LayerCells = std::vector<std::pair<Cell, double>>;
using Cells = std::map<ToolHeight, LayerCells>;

void join_same(LayerCells& cells) {
  std::ranges::sort(cells);
  std::size_t kept = 0;
  for (const auto& [cell, mm] : cells) {
    if (kept > 0 && cells[kept - 1].first == cell)
      cells[kept - 1].second += mm;
    else
      cells[kept++] = {cell, mm};
  }
  cells.resize(kept);
}

Cells cells(const GcodePrint& print, const std::set<Role>& without, double cell_mm) {
  const double step_mm = cell_mm / 4;
  Cells all;
  for (std::size_t i = 1; i < print.moves.size(); ++i) {
    if (!lays_plastic(print, i) || !is_kept(print.moves[i])) continue;
    if (without.contains(print.moves[i].role)) continue;
    const Vec3 a = print.moves[i - 1].to_mm, b = print.moves[i].to_mm;
    LayerCells& layer = all[tool_height(print.moves[i])];
    const double length = way_mm(print, i);
    const int steps = int(length / step_mm) + 1;
    for (int s = 0; s < steps; ++s) {
      const double t = (s + 0.5) / steps;
      const Cell cell{std::int64_t(std::floor((a.x + (b.x - a.x) * t) / cell_mm)),
                      std::int64_t(std::floor((a.y + (b.y - a.y) * t) / cell_mm))};
      if (!layer.empty() && layer.back().first == cell)
        layer.back().second += length / steps;
      else
        layer.emplace_back(cell, length / steps);
    }
  }
  for (auto& [place, layer] : all) join_same(layer);
  return all;
}

/// Roads that follow no other one.
int runs_of(const GcodePrint& print) {
  int runs = 0;
  for (std::size_t i = 1; i < print.moves.size(); ++i) runs += lays_plastic(print, i) && !lays_plastic(print, i - 1);
  return runs;
}

/// How much road the cells have that the others do not have.
double beyond_mm(const LayerCells& all, const LayerCells& others) {
  double sum = 0;
  auto other = others.begin();
  for (const auto& [cell, mm] : all) {
    while (other != others.end() && other->first < cell) ++other;
    const double there = other != others.end() && other->first == cell ? other->second : 0;
    sum += std::max(0., mm - there);
  }
  return sum;
}

double beyond_mm(const Cells& all, const Cells& others) {
  double sum = 0;
  for (const auto& [place, layer] : all) {
    const auto found = others.find(place);
    sum += found != others.end() ? beyond_mm(layer, found->second) : beyond_mm(layer, LayerCells{});
  }
  return sum;
}

double sum_mm(const Cells& all) {
  return beyond_mm(all, {});
}

/// The line of a road that is laid while filament is drawn back; nothing where there is none.
std::optional<std::size_t> starved_line(const GcodePrint& print) {
  std::vector<double> back_mm(max_tools, 0.);
  for (std::size_t i = 0; i < print.moves.size(); ++i) {
    const GcodeMove& move = print.moves[i];
    if (lays_plastic(print, i) && back_mm[move.feeds] > rounding_mm && is_kept(move))
      return line_number(*print.text, move.offset);
    back_mm[move.feeds] = std::max(0., back_mm[move.feeds] - move.filament_mm);
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> difference(const GcodePrint& before, const GcodePrint& after, const AuditMachine& machine,
                                      const ComparisonOptions& options) {
  if (after.tools > int(machine.nozzles.size())) return "another tool is in use";
  const auto of_tool_role = [](const GcodeMove& move) { return ToolRole(move.feeds, move.role); };
  auto old_mm = filament_mm(before, {}, of_tool_role);
  const auto new_mm = filament_mm(after, {}, of_tool_role);
  std::set<Role> without;
  for (const auto& [what, mm] : options.removed) {
    old_mm[what] -= mm;
    without.insert(what.second);
  }
  for (const auto& [what, mm] : old_mm) {
    const double now = value_of(new_mm, what);
    if (std::abs(now - mm) > same_share * mm + rounding_mm)
      return fmt::format("extruder {} pushes {:.3f} mm of filament for {} instead of {:.3f}", what.first + 1, now,
                         role_name(what.second), mm);
  }
  for (const auto& [what, mm] : new_mm)
    if (!old_mm.contains(what)) return fmt::format("there is {} that was not there", role_name(what.second));
  if (auto what = changed_layer(before, after, without)) return what;
  const double cell_mm = cell_size_mm(before);
  Cells old_cells, new_cells;
  parallel_for(2, options.threads,
               [&](int i) { (i == 0 ? old_cells : new_cells) = cells(i == 0 ? before : after, without, cell_mm); });
  const double all = sum_mm(old_cells), lost = beyond_mm(old_cells, new_cells), added = beyond_mm(new_cells, old_cells);
  if (std::max(lost, added) > std::max(seam_share * all, seam_mm * runs_of(before)))
    return fmt::format("{:.1f} mm of road are missing and {:.1f} mm were not there, of {:.0f} mm", lost, added, all);
  if (const auto line = starved_line(after))
    return fmt::format("line {} would lay plastic while filament is drawn back", *line);
  return std::nullopt;
}

}  // namespace cleancolor
