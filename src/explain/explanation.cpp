#include "explain/explanation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "printed/regions.hpp"

namespace cleancolor {
namespace {

constexpr double coarse_mm = 0.1;        // outlines of layers for voxels of 0.5 mm
constexpr double usual_width_mm = 0.4;   // of an outer wall, where the file names none
constexpr double most_entries = 2e4;     // of a roadmap: larger spacings where a layer has more road
constexpr double thickest_layer_mm = 5;  // a larger step is a gap between the layers

using Layers = std::vector<std::vector<LaidRoad>>;

/// The layers that decide what can be seen in one of them.
struct Window {
  std::uint32_t first = 0, last = 0;
};

Window window_around(const GcodePrint& print, std::uint32_t layer, double reach_mm) {
  Window w{layer, layer};
  const double z = print.layers[layer].z_mm;
  while (w.first > 0 && z - print.layers[w.first - 1].z_mm <= reach_mm) --w.first;
  while (w.last + 1 < print.layers.size() && print.layers[w.last + 1].z_mm - z <= reach_mm) ++w.last;
  return w;
}

struct Seen {
  SurfaceVisibility visibility;
  double z_mm;  // of the layer, above the lowest of the window
};

/// Layers without part plastic (a skirt of its own height) are none of the part.
Seen seen_around(const GcodePrint& print, std::uint32_t layer, Window window, const Layers& roads, int nozzles,
                 const ExplainOptions& options, const Progress& progress) {
  std::vector<Polygons> outlines(roads.size());
  parallel_for(int(roads.size()), options.threads, [&](int k) {
    if (progress.interrupted()) throw Error("interrupted");
    Polygons& all = outlines[std::size_t(k)];
    for (int n = 0; n < nozzles; ++n) all = united(all, region(roads[std::size_t(k)], n, coarse_mm));
  });
  std::vector<PackedPolygons> parts;
  std::vector<double> heights_mm;
  double below_mm = 0, top_mm = 0, z_mm = 0;
  for (std::uint32_t k = window.first; k <= window.last; ++k) {
    const Polygons& outline = outlines[k - window.first];
    const bool is_it = k == layer;
    if (outline.empty() && !is_it) continue;
    const GcodeLayer& l = print.layers[k];
    const double step = parts.empty() ? l.height_mm : l.z_mm - below_mm;
    heights_mm.push_back(std::clamp(step, 0.01, thickest_layer_mm));
    top_mm += heights_mm.back();
    below_mm = l.z_mm;
    if (is_it) z_mm = top_mm;
    parts.push_back(outline);
  }
  return {SurfaceVisibility(parts, heights_mm, {.reach_mm = options.reach_mm, .threads = options.threads}, progress),
          z_mm};
}

double outer_width_mm(std::span<const LaidRoad> roads) {
  double area = 0, length = 0;
  for (const LaidRoad& r : roads) {
    if (r.role != Role::external_perimeter) continue;
    const double mm = distance(r.from_mm, r.to_mm);
    length += mm;
    area += mm * r.width_mm;
  }
  return length > 0 ? area / length : usual_width_mm;
}

std::vector<Roadmap> roadmaps_of(const std::vector<Path>& paths, const Explanation& e) {
  double all_mm = 0;
  for (const Path& p : paths) all_mm += length_mm(p);
  RoadmapOptions options{.leads = false};
  options.spacing_mm = std::max(options.spacing_mm, all_mm / most_entries);
  options.pathway_mm = std::max(options.pathway_mm, all_mm / most_entries);
  std::vector<Roadmap> maps;
  for (std::size_t first = 0, last = 0; first < paths.size(); first = last) {
    while (last < paths.size() && (e.hanging || paths[last].extruder == paths[first].extruder)) ++last;
    maps.push_back(roadmap(std::span(paths).subspan(first, last - first), e.cost(paths[first].extruder), options));
  }
  return maps;
}

double foreign_on(const PrintedLayer& layer, std::size_t begin, std::size_t end, const Explanation& e) {
  double most = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const Drive& d = layer.drives[i];
    most = std::max(most, e.cost(d.tool).straight(d.from_mm, d.to_mm).foreign);
  }
  return most;
}

ExplainedRun row_of(const PrintedRun& run, const Explanation& e) {
  ExplainedRun row;
  row.zone = run.path.island;
  row.length_mm = length_mm(run.path);
  row.start_visibility = e.map->at(begin_mm(run.path, outer_wall(run.path))).visibility / 255.;
  for (std::size_t i = run.way_begin; i < run.begin; ++i)
    row.hop_mm += distance(e.printed.drives[i].from_mm, e.printed.drives[i].to_mm);
  row.hop_foreign = foreign_on(e.printed, run.way_begin, run.begin, e);
  if (e.hanging) row.idle_foreign = foreign_on(e.printed, run.begin, run.end, e);
  return row;
}

}  // namespace

Explanation explained(const GcodePrint& print, const AuditMachine& machine, std::uint32_t layer,
                      const ExplainOptions& options, const Progress& progress) {
  assert(layer < print.layers.size());
  progress.advance("layer", 0);
  const Timeline time = timeline(print, machine);
  Explanation e;
  e.layer = layer;
  e.z_mm = print.layers[layer].z_mm;
  e.hanging = machine.idle_nozzle == IdleNozzle::same_height;
  e.printed = printed_layer(print, machine, time, layer);
  for (std::size_t n = 0; n < machine.nozzles.size(); ++n)
    if (time.used[n]) e.used.push_back(int(n));

  // What lies in the layer and on it; what of it can be seen.
  const auto nozzles = int(machine.nozzles.size());
  const Window window = window_around(print, layer, options.reach_mm);
  const Layers roads = laid_roads(print, machine, time, window.first, window.last);
  const std::vector<LaidRoad>& own = roads[layer - window.first];
  e.regions.resize(machine.nozzles.size());
  parallel_for(nozzles, options.threads, [&](int n) { e.regions[std::size_t(n)] = region(own, n); });
  Polygons outline, above;
  for (const Polygons& r : e.regions) outline = united(outline, r);
  for (std::size_t k = layer - window.first + 1; k < roads.size() && above.empty(); ++k)
    if (has_part(roads[k]))
      for (int n = 0; n < nozzles; ++n) above = united(above, region(roads[k], n));
  const Seen seen = seen_around(print, layer, window, roads, nozzles, options, progress);

  // The planner's view of it.
  e.zones = zones_of(e.regions);
  std::vector<Path> paths, walls;
  for (PrintedRun& run : e.printed.runs) {
    run.path.island = zone_of(run.path, e.zones);
    if (run.path.road().role == Role::rampart) walls.push_back(run.path);
    paths.push_back(taken_apart(run.path));
  }
  e.map = std::make_unique<LayerMap>(LayerScene{.regions = e.regions,
                                                .outline = outline,
                                                .above = above,
                                                .z_mm = seen.z_mm,
                                                .wall_width_mm = outer_width_mm(own)},
                                     walls, seen.visibility);
  for (int tool = 0; tool < nozzles; ++tool) {
    std::vector<TravelCost::Nozzle> at_height;
    for (int n = 0; n < nozzles; ++n)
      if (n == tool || (e.hanging && time.used[std::size_t(n)]))
        at_height.push_back({n, machine.nozzles[std::size_t(n)].offset_mm, {}});
    e.costs.emplace_back(*e.map, std::move(at_height), TravelWeights{});
  }
  if (progress.interrupted()) throw Error("interrupted");
  progress.advance("layer", 0.7);
  e.roadmaps = roadmaps_of(paths, e);
  for (const PrintedRun& run : e.printed.runs) e.runs.push_back(row_of(run, e));
  return e;
}

}  // namespace cleancolor
