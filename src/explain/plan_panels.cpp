#include "explain/plan_panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/rows.hpp"
#include "explain/plan_table.hpp"

namespace cleancolor {
namespace {

constexpr double sample_mm = 0.2;  // of ways, to tell what lies below
constexpr double barred_mm = 0.2;  // rows of the barred places
constexpr double most_rows = 1000;
constexpr double detail_mm = 0.01;
constexpr double thinnest_px = 0.8;

using Line = std::vector<Vec2>;

Box<Vec2> with_air(Box<Vec2> box) {
  if (box.empty()) box.add({0, 0});
  const double air_mm = 1 + 0.03 * std::max(box.size().x, box.size().y);
  return {box.min - Vec2{air_mm, air_mm}, box.max + Vec2{air_mm, air_mm}};
}

bool is_visible_foreign(LayerMap::Cell cell, int nozzle) {
  return cell.extruder != LayerMap::air && cell.extruder != nozzle && cell.visibility > 0;
}

/// Pieces of a -> b over visible plastic that another nozzle printed.
void add_foreign_pieces(std::vector<Line>& pieces, const LayerMap& map, Vec2 a, Vec2 b, int nozzle) {
  const int steps = int(distance(a, b) / sample_mm) + 1;
  bool goes_on = false;
  for (int i = 0; i < steps; ++i) {
    const bool is_over = is_visible_foreign(map.at(lerp(a, b, (i + 0.5) / steps)), nozzle);
    const Vec2 from = lerp(a, b, double(i) / steps), to = lerp(a, b, double(i + 1) / steps);
    if (is_over && goes_on) pieces.back().back() = to;
    if (is_over && !goes_on) pieces.push_back({from, to});
    goes_on = is_over;
  }
}

/// Drives one after the other as one line, as the nozzle goes.
struct Way {
  Line points_mm;
  int nozzle = 0;
  bool travel = true;
};

void add_to(std::vector<Way>& ways, const Drive& d, Vec2 offset, int nozzle) {
  const Vec2 from = d.from_mm + offset, to = d.to_mm + offset;
  const bool goes_on = !ways.empty() && ways.back().nozzle == nozzle && ways.back().travel == !d.lays &&
                       ways.back().points_mm.back() == from;
  if (!goes_on) ways.push_back({{from}, nozzle, !d.lays});
  ways.back().points_mm.push_back(to);
}

/// Travel between the runs: of the nozzle in use where the plastic lies, or of the carriage.
std::vector<Way> tour_of(const PlanScenery& s, bool of_carriage) {
  std::vector<Way> ways;
  for (const PrintedRun& run : s.plan.printed.runs) {
    std::vector<Way> hop;
    for (std::size_t i = run.way_begin; i < run.begin; ++i) {
      const Drive& d = s.plan.printed.drives[i];
      add_to(hop, d, of_carriage ? Vec2{} : nozzle_offset_mm(s.machine, d.tool), d.tool);
    }
    std::ranges::move(hop, std::back_inserter(ways));
  }
  return ways;
}

RoadLook look_of(Role role) {
  if (role == Role::refill) return RoadLook::refill;
  if (is_auxiliary(role)) return RoadLook::auxiliary;
  switch (role) {
    case Role::external_perimeter:
    case Role::overhang_perimeter:
      return RoadLook::outer;
    default:
      return RoadLook::inner;
  }
}

/// Segments of one road, as a line.
Line points_of(const Path& path, std::size_t stretch) {
  const std::size_t first = path.stretches[stretch].first_segment;
  const std::size_t end =
      stretch + 1 < path.stretches.size() ? path.stretches[stretch + 1].first_segment : path.segments();
  Line points;
  for (std::size_t i = first; i <= end; ++i) points.push_back(path.points[i % path.points.size()]);
  return points;
}

void draw_zones(const Panel& panel, const PlanScenery& s, double share_of_white) {
  for (const Zone& zone : s.plan.zones) {
    std::vector<Line> rings;
    for (const Ring& ring : zone.region) rings.push_back(to_mm(ring));
    panel.rings(rings, mixed(nozzle_colour(s.machine, zone.nozzle), white, share_of_white));
  }
}

/// The middle of the widest place at half height.
std::optional<Vec2> middle_of(const Zone& zone) {
  const double y = zone.box.center().y;
  const Rows rows(zone.region, {y, 1, 1});
  std::optional<Vec2> middle;
  float widest = 0;
  for (const Interval& i : rows.row(0)) {
    if (i.end_mm - i.begin_mm <= widest) continue;
    widest = i.end_mm - i.begin_mm;
    middle = Vec2{double(i.begin_mm + i.end_mm) / 2, y};
  }
  return middle;
}

void draw_zone_borders(const Panel& panel, const PlanScenery& s, bool in_carriage_frame, double width_px) {
  for (const Zone& zone : s.plan.zones)
    for (const Ring& ring : zone.region) {
      Line line = to_mm(ring);
      line.push_back(line.front());
      for (Vec2& p : line)
        if (in_carriage_frame) p = p - nozzle_offset_mm(s.machine, zone.nozzle);
      panel.line(simplified(line, detail_mm), width_px, nozzle_line(s.machine, zone.nozzle));
    }
}

void draw_roads(const Panel& panel, const PlanScenery& s, bool outer) {
  // All borders first: where two roads overlap, neither looks cut.
  for (const bool core : {false, true})
    for (const PrintedRun& run : s.plan.printed.runs)
      for (std::size_t k = 0; k < run.path.stretches.size(); ++k) {
        const Road& road = run.path.stretches[k].road;
        const RoadLook look = look_of(road.role);
        if ((look == RoadLook::outer || look == RoadLook::refill) != outer) continue;
        const Colour fill = road_colour(s.machine, run.path.extruder, look);
        const double width = std::max(thinnest_px, road.width_mm * panel.scale());
        const Colour edge = mixed(fill, {0, 0, 0, 1}, 0.12);
        panel.line(points_of(run.path, k), core ? std::max(0.5, 0.8 * width) : width, core ? fill : edge);
      }
}

void draw_directions(const Panel& panel, const PlanScenery& s) {
  for (const PrintedRun& run : s.plan.printed.runs)
    for (std::size_t k = 0; k < run.path.stretches.size(); ++k) {
      const Road& road = run.path.stretches[k].road;
      const bool is_outer = look_of(road.role) == RoadLook::outer;
      const double size = std::clamp(road.width_mm * panel.scale(), 5., 9.);
      const Colour dark = mixed(nozzle_line(s.machine, run.path.extruder), {0, 0, 0, 1}, 0.35);
      const bool fill = !is_outer && road.role != Role::perimeter && !is_auxiliary(road.role);
      panel.arrows(points_of(run.path, k), fill ? 1e9 : is_outer ? 130 : 220, is_outer ? 12 : 24, size, dark);
    }
}

void draw_tour(const Panel& panel, const std::vector<Way>& ways, double width_px) {
  for (const Way& way : ways) panel.line(way.points_mm, width_px + 1.6, {1, 1, 1, 0.75});
  for (const Way& way : ways) panel.line(way.points_mm, width_px, tour_ink);
  for (const Way& way : ways) panel.arrows(way.points_mm, 170, 14, 5 + 2.5 * width_px, tour_ink);
}

void draw_pieces(const Panel& panel, const std::vector<Line>& pieces, double width_px) {
  for (const Line& piece : pieces) panel.line(piece, width_px, bad_ink);
}

/// Nozzles that print in the layer, ascending.
std::vector<int> printing_in(const PlanScenery& s) {
  std::vector<int> nozzles;
  for (const int n : s.plan.used)
    if (std::ranges::any_of(s.plan.printed.runs, [&](const PrintedRun& run) { return run.path.extruder == n; }))
      nozzles.push_back(n);
  return nozzles;
}

/// Where a nozzle hangs over visible plastic of another colour when the carriage is there: rows of a raster.
std::vector<Line> barred_places(const Panel& panel, const PlanScenery& s) {
  std::vector<Line> boxes;
  const LayerMap& map = *s.plan.map;
  const Box<Vec2>& view = map.box_mm();
  if (view.empty()) return boxes;
  const double step = std::max(barred_mm, std::max(view.size().x, view.size().y) / most_rows);
  const int rows = int(view.size().y / step) + 1, columns = int(view.size().x / step) + 1;
  for (const int n : s.plan.hanging ? s.plan.used : printing_in(s))
    for (int y = 0; y < rows; ++y)
      for (int x = 0, end = 0; x < columns; x = end + 1) {
        const auto foreign = [&](int i) {
          return is_visible_foreign(map.at(view.min + Vec2{i + 0.5, y + 0.5} * step), n);
        };
        for (end = x; end < columns && foreign(end);) ++end;
        if (end == x) continue;
        const Vec2 a = view.min + Vec2{double(x), double(y)} * step - nozzle_offset_mm(s.machine, n);
        const Vec2 b = a + Vec2{double(end - x), 1.02} * step;  // rows overlap, or gaps would shine through
        if (panel.shows(a) || panel.shows(b)) boxes.push_back({a, {b.x, a.y}, b, {a.x, b.y}});
      }
  return boxes;
}

}  // namespace

Colour nozzle_colour(const AuditMachine& machine, int nozzle) {
  return std::size_t(nozzle) < machine.nozzles.size() ? colour(machine.nozzles[std::size_t(nozzle)].rgb) : pale_ink;
}

Colour nozzle_line(const AuditMachine& machine, int nozzle) {
  return readable_on_white(nozzle_colour(machine, nozzle));
}

Colour road_colour(const AuditMachine& machine, int nozzle, RoadLook look) {
  const Colour own = nozzle_colour(machine, nozzle);
  switch (look) {
    case RoadLook::outer:
      return mixed(own, white, 0.2);
    case RoadLook::inner:
      return mixed(own, white, 0.68);
    case RoadLook::auxiliary:
      return mixed(mixed(own, {0.5, 0.5, 0.5, 1}, 0.55), white, 0.6);
    default:
      return {0.85, 0.2, 0.75, 1};
  }
}

void draw_start(Canvas& canvas, Vec2 at_px) {
  canvas.disc(at_px, 3, {0.05, 0.5, 0.2, 1});
}

void draw_end(Canvas& canvas, Vec2 at_px) {
  constexpr int corners = 24;
  Line ring;
  for (int i = 0; i < corners; ++i) ring.push_back(at_px + turned({5, 0}, 2 * std::numbers::pi * i / corners));
  canvas.line(ring, 3.2, white, true);
  canvas.line(ring, 1.5, bad_ink, true);
}

Box<Vec2> plastic_view(const PlanScenery& s) {
  Box<Vec2> box;
  for (const PrintedRun& run : s.plan.printed.runs)
    for (const Vec2 p : run.path.points) box.add(p);
  return with_air(box);
}

Box<Vec2> carriage_view(const PlanScenery& s) {
  Box<Vec2> box;
  for (const Roadmap& map : s.plan.roadmaps)
    for (const Vec2 p : map.nodes_mm) box.add(p);
  return with_air(box);
}

std::size_t draw_plan(const Panel& panel, const PlanScenery& s) {
  draw_zones(panel, s, 0.86);
  draw_roads(panel, s, false);
  draw_roads(panel, s, true);
  draw_directions(panel, s);
  draw_tour(panel, tour_of(s, false), 1.5);
  std::vector<Line> pieces;
  for (const PrintedRun& run : s.plan.printed.runs)
    for (std::size_t i = run.way_begin; i < run.begin; ++i) {
      const Drive& d = s.plan.printed.drives[i];
      const Vec2 offset = nozzle_offset_mm(s.machine, d.tool);
      add_foreign_pieces(pieces, *s.plan.map, d.from_mm + offset, d.to_mm + offset, d.tool);
    }
  draw_pieces(panel, pieces, 2.2);
  for (const PrintedRun& run : s.plan.printed.runs) {
    const OuterWall wall = outer_wall(run.path);
    if (wall.first == wall.last) continue;
    draw_end(panel.canvas(), panel.at(end_mm(run.path, wall)));
    draw_start(panel.canvas(), panel.at(begin_mm(run.path, wall)));
  }
  Labels labels(panel);
  std::size_t shown = 0;
  for (std::size_t k = 0; k < s.plan.printed.runs.size(); ++k) {
    const Path& path = s.plan.printed.runs[k].path;
    shown += labels.put(path.start(), fmt::format("{}", k + 1), nozzle_line(s.machine, path.extruder));
  }
  for (std::size_t z = 0; z < s.plan.zones.size(); ++z) {
    const Zone& zone = s.plan.zones[z];
    if (const auto middle = middle_of(zone))
      labels.put(*middle, zone_name(int(z)), nozzle_line(s.machine, zone.nozzle), Labels::Look::zone);
  }
  panel.scale_bar();
  return shown;
}

void draw_roadmap(const Panel& panel, const PlanScenery& s) {
  panel.rings(barred_places(panel, s), barred_ink);
  draw_zone_borders(panel, s, true, 0.9);
  std::vector<Line> clean, crossing;
  for (const Roadmap& map : s.plan.roadmaps)
    for (std::uint32_t a = 0; a < map.nodes_mm.size(); ++a)
      for (const Arc& arc : map.arcs_of(a))
        if (a < arc.to) (arc.foreign > 0 ? crossing : clean).push_back({map.nodes_mm[a], map.nodes_mm[arc.to]});
  for (const Line& arc : crossing) panel.line(arc, 0.45, {0.93, 0.55, 0.5, 0.55});
  for (const Line& arc : clean) panel.line(arc, 0.5, road_ink);
  for (const Roadmap& map : s.plan.roadmaps)
    for (const Vec2 p : map.nodes_mm) panel.canvas().disc(panel.at(p), 0.9, mixed(road_ink, {0, 0, 0, 1}, 0.25));
  draw_tour(panel, tour_of(s, true), 1.1);
  panel.scale_bar();
}

void draw_nozzles(const Panel& panel, const PlanScenery& s) {
  draw_zones(panel, s, 0.8);
  draw_zone_borders(panel, s, false, 0.6);
  for (const PrintedRun& run : s.plan.printed.runs)
    if (is_auxiliary(run.path.road().role))
      panel.line(run.path.points, std::max(1., 0.5 * panel.scale() * run.path.road().width_mm),
                 road_colour(s.machine, run.path.extruder, RoadLook::auxiliary));
  std::vector<Line> pieces;
  for (const int n : s.plan.used) {
    const Vec2 offset = nozzle_offset_mm(s.machine, n);
    std::vector<Way> ways;
    for (const Drive& d : s.plan.printed.drives) {
      const bool prints = d.lays && d.feeds == n;
      if (prints || !(s.plan.hanging || d.tool == n)) continue;
      add_to(ways, d, offset, n);
      add_foreign_pieces(pieces, *s.plan.map, d.from_mm + offset, d.to_mm + offset, n);
    }
    Colour faint = nozzle_line(s.machine, n);
    for (const Way& way : ways) {
      faint.a = way.travel ? 0.75 : 0.45;
      if (way.travel)
        panel.dashed(way.points_mm, 1, faint);
      else
        panel.line(way.points_mm, 0.8, faint);
    }
  }
  draw_pieces(panel, pieces, 2);
  panel.scale_bar();
}

}  // namespace cleancolor
