#include "replan/found_roles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "model/text_scan.hpp"
#include "printed/regions.hpp"
#include "replan/closed_runs.hpp"
#include "replan/file_parts.hpp"

namespace cleancolor {
namespace {

constexpr double role_detail_mm = 0.05;
constexpr double outer_widths = 0.8;   // middles of outer walls are nearer than that to the border
constexpr double skirt_room_mm = 0.6;  // between a skirt and all else
constexpr std::size_t samples = 24;    // places of a loop that are asked how deep it lies

/// Moves [first, last) of one nozzle without a break.
struct UntoldRun {
  std::size_t first = 0, last = 0;
  int tool = 0;
  std::vector<Vec2> points;  // where the plastic lies
  double width_mm = 0;
  bool closed = false;
};

std::vector<std::vector<UntoldRun>> runs_by_layer(const GcodePrint& print, const AuditMachine& machine,
                                                  std::size_t begin) {
  std::vector<std::vector<UntoldRun>> layers(print.layers.size());
  std::size_t last = 0;
  for (std::size_t i = 1; i < print.moves.size(); ++i) {
    const GcodeMove& move = print.moves[i];
    if (move.offset < begin || !lays_plastic(print, i)) continue;
    std::vector<UntoldRun>& runs = layers[move.layer];
    const auto place = [&](Vec3 p) { return plastic_mm(machine, {p.x, p.y}, move.feeds); };
    if (runs.empty() || last + 1 != i || runs.back().tool != move.feeds)
      runs.push_back({i, i, move.feeds, {place(print.moves[i - 1].to_mm)}, road_width_mm(move), false});
    runs.back().points.push_back(place(move.to_mm));
    runs.back().last = i + 1;
    last = i;
  }
  for (std::vector<UntoldRun>& runs : layers)
    for (UntoldRun& run : runs) {
      const double gap = distance(run.points.front(), run.points.back());
      double length = 0;
      for (std::size_t i = 0; i + 1 < run.points.size(); ++i) length += distance(run.points[i], run.points[i + 1]);
      run.closed = run.points.size() > 3 && comes_back(gap, length, run.width_mm);
    }
  return layers;
}

Box<Vec2> box_of(const UntoldRun& run) {
  Box<Vec2> box;
  for (const Vec2 p : run.points) box.add(p);
  return box;
}

/// How many of the first runs are loops around all that follow.
std::size_t skirts(const std::vector<UntoldRun>& runs) {
  std::vector<Box<Vec2>> rest(runs.size() + 1);  // of the runs from there on
  for (std::size_t i = runs.size(); i-- > 0;) {
    rest[i] = rest[i + 1];
    for (const Vec2 p : runs[i].points) rest[i].add(p);
  }
  std::size_t count = 0;
  for (; count + 1 < runs.size() && runs[count].closed; ++count) {
    const Box<Vec2> own = box_of(runs[count]), inner = rest[count + 1];
    const double room =
        std::min({inner.min.x - own.min.x, inner.min.y - own.min.y, own.max.x - inner.max.x, own.max.y - inner.max.y});
    if (room < skirt_room_mm) break;
  }
  return count;
}

bool is_outer(const UntoldRun& run, const Polygons& region) {
  std::vector<Vec2> places;
  const std::size_t step = std::max<std::size_t>(1, run.points.size() / samples);
  for (std::size_t i = 0; i + 1 < run.points.size(); i += step)
    places.push_back(lerp(run.points[i], run.points[i + 1], 0.5));
  return median_depth_mm(places, region) < outer_widths * run.width_mm;
}

}  // namespace

bool tells_roles(const GcodePrint& print) {
  for (std::size_t i = 0; i < print.moves.size(); ++i)
    if (lays_plastic(print, i) && print.moves[i].role != Role::unknown && !is_auxiliary(print.moves[i].role))
      return true;
  return false;
}

GcodePrint with_found_roles(GcodePrint print, const AuditMachine& machine) {
  for (const std::string_view key : {"support_material", "raft_layers", "brim_width", "interior_brim_width"})
    if (is_set(last_value(print.facts, key)))
      throw Error(
          fmt::format("{}: {} = {}, and the file does not say which roads are that; switch on verbose G-code "
                      "(gcode_comments), or slice without",
                      print.name, key, last_value(print.facts, key)));
  const bool ooze = last_value(print.facts, "ooze_prevention") == "1";
  const bool all_layers = ooze || last_value(print.facts, "skirt_height") == "-1";
  const auto height = number<std::size_t>(last_value(print.facts, "skirt_height")).value_or(1);
  const bool has_skirts = ooze || is_set(last_value(print.facts, "skirts"));
  const std::size_t begin = print.text->find("\n;LAYER_CHANGE");
  auto layers = runs_by_layer(print, machine, begin == std::string::npos ? 0 : begin);
  for (std::size_t k = 0; k < layers.size(); ++k) {
    std::vector<UntoldRun>& runs = layers[k];
    const std::size_t skirted = has_skirts && (all_layers || k < height) ? skirts(runs) : 0;
    std::map<int, std::vector<LaidRoad>> roads;
    for (std::size_t n = skirted; n < runs.size(); ++n)
      for (std::size_t i = 0; i + 1 < runs[n].points.size(); ++i)
        roads[runs[n].tool].push_back({runs[n].points[i], runs[n].points[i + 1], runs[n].width_mm, runs[n].tool,
                                       runs[n].closed ? Role::external_perimeter : Role::internal_infill});
    std::map<int, Polygons> regions;
    for (const auto& [tool, own] : roads) regions[tool] = region(own, tool, role_detail_mm);
    for (std::size_t n = 0; n < runs.size(); ++n) {
      const Role role = n < skirted                                ? Role::skirt_brim
                        : !runs[n].closed                          ? Role::internal_infill
                        : is_outer(runs[n], regions[runs[n].tool]) ? Role::external_perimeter
                                                                   : Role::perimeter;
      for (std::size_t i = runs[n].first; i < runs[n].last; ++i)
        if (lays_plastic(print, i)) print.moves[i].role = role;
    }
  }
  return print;
}

}  // namespace cleancolor
