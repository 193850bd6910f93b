#include "toolpath/perimeters.hpp"

#include <algorithm>
#include <cmath>

#include "base/edge_rows.hpp"
#include "toolpath/medial.hpp"

namespace cleancolor {
namespace {

// Loops may overlap by this share of their spacing before one of them is left out.
constexpr double tolerated_overlap = 0.4;
// Offsets to and fro end up a little short rather than a little long.
constexpr double hair_mm = 1e-5;
// A loop up to this long is small: a circle of 6.5 mm radius, as in PrusaSlicer.
constexpr double small_loop_mm = 2 * 3.14159265358979323846 * 6.5;

Polygons shrunk_where_room(const Polygons& region, double distance_mm, double room_mm) {
  return offset(offset(region, -(distance_mm + room_mm / 2 - hair_mm)), room_mm / 2 - hair_mm);
}

/// All loops of an island, outermost first; gaps collects what lies between two loops and in neither.
struct Nest {
  std::vector<Polygons> loops;
  Polygons thin;  // too narrow for the outermost loop
  Polygons gaps;
};

Nest nest(const Polygons& region, const Roads& roads, const PerimeterOptions& options) {
  const double outer_width = roads.external_perimeter.width_mm;
  const double outer_spacing = spacing_mm(roads.external_perimeter);
  const double inner_spacing = spacing_mm(roads.perimeter);
  Nest result;
  Polygons last = region;
  for (int i = 0; i < options.count && !last.empty(); ++i) {
    const double distance = i == 0 ? outer_width / 2 : i == 1 ? (outer_spacing + inner_spacing) / 2 : inner_spacing;
    const double room = (i == 0 ? outer_spacing : inner_spacing) * (1 - tolerated_overlap);
    Polygons loops;
    // Without thin walls a loop is laid wherever its line fits at all, even if it comes to lie on its own other side:
    // rather too much plastic in a narrow wall than a hole in it.
    loops = options.thin_walls ? shrunk_where_room(last, distance, room) : offset(last, -distance);
    if (i == 0 && options.thin_walls)
      result.thin = difference(region, offset(loops, distance + hair_mm));
    else if (i > 0 && options.gap_fill)
      append(result.gaps, difference(offset(last, -distance / 2), offset(loops, distance / 2 + hair_mm)));
    last = loops;
    if (!loops.empty()) result.loops.push_back(std::move(loops));
  }
  return result;
}

Path loop_path(const Ring& ring, int depth, const Roads& roads, const PerimeterOptions& options) {
  const Road& road = depth == 0 ? roads.external_perimeter : roads.perimeter;
  Path path;
  path.depth = depth;
  path.closed = true;
  path.points = to_mm(ring);
  path.stretches = {{0, road}};
  if (length_mm(ring) <= small_loop_mm)
    path.stretches[0].road.speed_mm_s = std::min(road.speed_mm_s, options.small_perimeter_speed.of(road.speed_mm_s));
  return path;
}

/// What the loops leave to the infill, grown under the innermost loop by infill_overlap.
Polygons fill_region(const Polygons& region, const Nest& nest, const Roads& roads, const PerimeterOptions& options) {
  const double infill_spacing = spacing_mm(roads.solid_infill);
  if (options.count == 0) return region;
  if (nest.loops.size() < std::size_t(options.count)) return {};
  const double half = spacing_mm(options.count == 1 ? roads.external_perimeter : roads.perimeter) / 2;
  const double inset = half - options.infill_overlap.of(half + infill_spacing / 2);
  const Polygons fill = shrunk_where_room(nest.loops.back(), inset, infill_spacing * (1 - tolerated_overlap));
  // However much overlap is asked for, infill stays within the line of the outermost loop.
  return inset >= 0 ? fill : intersection(fill, nest.loops.front());
}

}  // namespace

void mark_overhangs(Path& loop, const Polygons& overhang, const Road& road) {
  if (overhang.empty()) return;
  const EdgeRows border(overhang);

  // Walk round the loop, cut each segment where it crosses the border, and ask for the middle of each piece.
  const Road plain = loop.road();
  std::vector<Vec2> points;
  std::vector<char> hangs;
  std::vector<double> cuts;
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const Vec2 a = loop.points[i], b = loop.points[(i + 1) % loop.points.size()];
    cuts.assign({0.0});
    border.crossings(a, b, cuts);
    cuts.push_back(1);
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
      if ((cuts[c + 1] - cuts[c]) * distance(a, b) < hair_mm && cuts.size() > 2) continue;
      points.push_back(lerp(a, b, cuts[c]));
      hangs.push_back(border.contains(lerp(a, b, (cuts[c] + cuts[c + 1]) / 2)));
    }
  }
  loop.points = std::move(points);
  loop.stretches.clear();
  for (std::size_t i = 0; i < hangs.size(); ++i)
    if (i == 0 || hangs[i] != hangs[i - 1]) loop.stretches.push_back({std::uint32_t(i), hangs[i] ? road : plain});
}

Shell perimeters(const Island& island, const Polygons& overhang, const Roads& roads, const PerimeterOptions& options) {
  const Polygons region = polygons(island);
  const Nest loops = nest(region, roads, options);
  Shell shell;
  for (std::size_t depth = loops.loops.size(); depth-- > 0;)
    for (const Ring& ring : loops.loops[depth]) {
      Path path = loop_path(ring, int(depth), roads, options);
      mark_overhangs(path, overhang, roads.overhang_perimeter);
      shell.paths.push_back(std::move(path));
    }
  if (options.external_first) std::reverse(shell.paths.begin(), shell.paths.end());
  shell.fill = fill_region(region, loops, roads, options);

  if (options.thin_walls && !loops.thin.empty()) {
    // From a quarter of the nozzle on, a wall can be printed at all; from two roads on, loops fit.
    const MedialOptions walls{options.nozzle_diameter_mm / 4, 2 * roads.external_perimeter.width_mm};
    for (Path& path : medial_roads(loops.thin, roads.external_perimeter, walls)) {
      path.depth = 0;
      shell.paths.push_back(std::move(path));
    }
  }
  if (options.gap_fill && !loops.gaps.empty()) {
    const double spacing = spacing_mm(roads.perimeter);
    const MedialOptions gaps{0.2 * roads.perimeter.width_mm * (1 - tolerated_overlap), 2 * spacing,
                             roads.perimeter.width_mm - spacing};
    for (Path& path : medial_roads(united(loops.gaps), roads.gap_fill, gaps)) shell.paths.push_back(std::move(path));
  }
  return shell;
}

}  // namespace cleancolor
