#include "replan/kept_shield.hpp"

#include <algorithm>

#include "replan/closed_runs.hpp"

namespace cleancolor {
namespace {

constexpr std::size_t skirt_layers = 5;  // a skirt in more is a shield

bool is_skirt(const RecoveredRun& run, const GcodePrint& print) {
  return std::ranges::all_of(run.roads,
                             [&](const RunRoad& road) { return print.moves[road.move].role == Role::skirt_brim; }) &&
         !run.roads.empty();
}

}  // namespace

std::vector<std::vector<std::size_t>> shield_runs(const RecoveredPrint& recovered, const GcodePrint& print) {
  std::vector<std::vector<std::size_t>> runs(recovered.layers.size());
  std::size_t layers = 0;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const std::vector<RecoveredRun>& all = recovered.layers[k].runs;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (is_skirt(all[i], print)) runs[k].push_back(i);
    layers += runs[k].empty() ? 0 : 1;
  }
  if (layers <= skirt_layers) return {};
  if (runs[0].size() > runs[1].size()) runs[0].clear();
  return runs;
}

Path as_wall(Path path) {
  for (Stretch& s : path.stretches) s.road.role = Role::rampart;
  return closed_where_it_comes_back(std::move(path));
}

}  // namespace cleancolor
