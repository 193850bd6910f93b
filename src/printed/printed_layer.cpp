#include "printed/printed_layer.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace cleancolor {
namespace {

constexpr double same_place_mm = 0.005;  // of rounded coordinates
constexpr double same_width_mm = 0.02;

Road road_of(const GcodePrint& print, const Drive& d) {
  const GcodeMove& move = print.moves[d.move];
  return {.role = d.role,
          .width_mm = road_width_mm(print.moves[d.move]),
          .height_mm = double(move.height_mm),
          .area_mm2 = d.pushed_mm3 / distance(d.from_mm, d.to_mm),
          .speed_mm_s = double(move.speed_mm_s)};
}

bool lays(const AuditMachine& machine, const Drive& d) {
  return d.lays && d.known && d.feeds < machine.nozzles.size();
}

/// Whether the nozzle stops: what is drawn back or fed without a way, another tool, a pause.
bool is_break(const Drive& d) {
  return d.moves_xy() || d.filament_mm != 0 || d.event != Drive::no_event;
}

/// Visits the drives of layers [first, last] in their order.
template <class Visit>
void for_drives(const GcodePrint& print, const AuditMachine& machine, const Timeline& time, std::uint32_t first,
                std::uint32_t last, Visit visit) {
  const auto count = std::uint32_t(print.moves.size());
  const auto inside = [&](std::uint32_t i) { return print.moves[i].layer >= first && print.moves[i].layer <= last; };
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!inside(i)) continue;
    const std::uint32_t begin = i;
    while (i < count && inside(i)) ++i;
    for (const Drive& d : drives(print, machine, time, begin, i)) visit(d);
  }
}

class RunCollector {
 public:
  RunCollector(const GcodePrint& print, const AuditMachine& machine) : print_(print), machine_(machine) {}

  void add(const Drive& d) {
    if (lays(machine_, d)) {
      lay(d);
      return;
    }
    if (!d.known || is_break(d)) goes_on_ = false;
    if (d.known && d.moves_xy()) layer_.drives.push_back(d);
  }

  PrintedLayer layer() && {
    for (PrintedRun& run : layer_.runs) close(run.path);
    return std::move(layer_);
  }

 private:
  void lay(const Drive& d) {
    const Vec2 offset = nozzle_offset_mm(machine_, d.feeds);
    const Vec2 from = d.from_mm + offset, to = d.to_mm + offset;
    std::vector<PrintedRun>& runs = layer_.runs;
    if (!goes_on_ || runs.back().path.extruder != d.feeds || distance(runs.back().path.points.back(), from) > 0) {
      PrintedRun run;
      run.way_begin = runs.empty() ? 0 : runs.back().end;
      run.begin = run.end = layer_.drives.size();
      run.path.extruder = d.feeds;
      run.path.points.push_back(from);
      runs.push_back(std::move(run));
    }
    PrintedRun& run = runs.back();
    const Road road = road_of(print_, d);
    std::vector<Stretch>& stretches = run.path.stretches;
    if (stretches.empty() || stretches.back().road.role != road.role ||
        std::abs(stretches.back().road.width_mm - road.width_mm) > same_width_mm)
      stretches.push_back({std::uint32_t(run.path.points.size() - 1), road});
    run.path.points.push_back(to);
    layer_.drives.push_back(d);
    run.end = layer_.drives.size();
    goes_on_ = true;
  }

  static void close(Path& path) {
    if (path.points.size() < 4 || distance(path.points.front(), path.points.back()) > same_place_mm) return;
    path.points.pop_back();
    path.closed = true;
  }

  const GcodePrint& print_;
  const AuditMachine& machine_;
  PrintedLayer layer_;
  bool goes_on_ = false;
};

bool is_outer(Role role) {
  return role == Role::external_perimeter;
}

/// Points [first, last] of an open run as a closed path, where they come back to where they began.
std::optional<Path> loop_of(const Path& run, std::size_t first, std::size_t last) {
  constexpr double most_apart_widths = 3, least_round = 6;
  if (last < first + 3) return std::nullopt;
  Path loop;
  loop.extruder = run.extruder;
  loop.island = run.island;
  loop.points.assign(run.points.begin() + std::ptrdiff_t(first), run.points.begin() + std::ptrdiff_t(last) + 1);
  for (const Stretch& s : run.stretches) {
    const std::uint32_t from = s.first_segment > first ? std::uint32_t(s.first_segment - first) : 0;
    if (s.first_segment >= last) break;
    if (!loop.stretches.empty() && from == 0) loop.stretches.clear();
    loop.stretches.push_back({from, s.road});
  }
  const double apart = distance(loop.points.front(), loop.points.back());
  if (apart > most_apart_widths * loop.road().width_mm || length_mm(loop) < least_round * apart) return std::nullopt;
  if (apart < same_place_mm && loop.points.size() > 3) loop.points.pop_back();
  loop.closed = true;
  return loop;
}

}  // namespace

PrintedLayer printed_layer(const GcodePrint& print, const AuditMachine& machine, const Timeline& time,
                           std::uint32_t layer) {
  assert(layer < print.layers.size());
  RunCollector collector(print, machine);
  for_drives(print, machine, time, layer, layer, [&](const Drive& d) { collector.add(d); });
  return std::move(collector).layer();
}

std::vector<std::vector<LaidRoad>> laid_roads(const GcodePrint& print, const AuditMachine& machine,
                                              const Timeline& time, std::uint32_t first, std::uint32_t last) {
  assert(first <= last && last < print.layers.size());
  std::vector<std::vector<LaidRoad>> layers(last - first + 1);
  for_drives(print, machine, time, first, last, [&](const Drive& d) {
    if (!lays(machine, d)) return;
    const Vec2 offset = nozzle_offset_mm(machine, d.feeds);
    layers[d.layer - first].push_back(
        {d.from_mm + offset, d.to_mm + offset, road_width_mm(print.moves[d.move]), int(d.feeds), d.role});
  });
  return layers;
}

OuterWall outer_wall(const Path& run) {
  const std::vector<Stretch>& all = run.stretches;
  const auto outer = [](const Stretch& s) { return is_outer(s.road.role); };
  const auto first = std::ranges::find_if(all, outer);
  if (first == all.end()) return {};
  OuterWall wall{.first = first->first_segment, .last = run.segments()};
  const auto overhangs = [](const Stretch& s) { return s.road.role == Role::overhang_perimeter; };
  const auto after = std::find_if(first, all.end(), [&](const Stretch& s) { return !outer(s) && !overhangs(s); });
  if (after != all.end()) wall.last = after->first_segment;
  // What overhangs just before may be the wall's, too, or the end of the loop inside it: a wall begins where it ends.
  auto before = first;
  while (before != all.begin() && overhangs(*std::prev(before))) --before;
  const auto apart = [&](std::size_t segment) { return distance(run.points[segment], end_mm(run, wall)); };
  for (std::size_t i = first->first_segment; i-- > before->first_segment;)
    if (apart(i) <= apart(wall.first)) wall.first = i;
  return wall;
}

Path taken_apart(const Path& run) {
  if (run.closed) return run;
  const bool walls = std::ranges::all_of(run.stretches, [](const Stretch& s) { return is_wall(s.road.role); });
  if (!walls) return run;
  const OuterWall wall = outer_wall(run);
  if (wall.first < wall.last && wall.first > 0) {
    auto inner = loop_of(run, 0, wall.first);
    auto outer = loop_of(run, wall.first, wall.last);
    if (!inner || !outer) return run;
    outer->inner.push_back(std::move(*inner));
    return std::move(*outer);
  }
  return loop_of(run, 0, run.points.size() - 1).value_or(run);
}

}  // namespace cleancolor
