#include "replan/change_places.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace cleancolor {
namespace {

constexpr double step_mm = 0.25;
constexpr double past_border_mm = 0.25;  // the border: about half a nozzle's tip

bool hangs_over_others(const std::vector<Polygons>& regions, int extruder, Vec2 at) {
  for (int e = 0; e < int(regions.size()); ++e)
    if (e != extruder && contains(regions[std::size_t(e)], to_nm(at))) return true;
  return false;
}

/// So far along the way; nothing where it is clear from the beginning, or nowhere.
std::optional<double> clear_from_mm(const std::vector<Vec2>& way, int extruder, const std::vector<Polygons>& regions,
                                    const std::vector<Polygons>& below) {
  double gone = 0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const double length = distance(way[i], way[i + 1]);
    const int steps = int(length / step_mm) + 1;
    for (int s = 0; s < steps; ++s) {
      const Vec2 at = lerp(way[i], way[i + 1], double(s) / steps);
      if (!hangs_over_others(regions, extruder, at) && !hangs_over_others(below, extruder, at))
        return i == 0 && s == 0 ? std::nullopt : std::optional(gone + length * s / steps);
    }
    gone += length;
  }
  return std::nullopt;
}

/// The way is cut there.
void change_at(Path& path, const std::vector<Vec2>& way, double at_mm) {
  double gone = 0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const double length = distance(way[i], way[i + 1]);
    if (gone + length > at_mm) {
      const Vec2 place = lerp(way[i], way[i + 1], (at_mm - gone) / length);
      path.travel.insert(path.travel.begin() + std::ptrdiff_t(i), place);
      path.travel_before_change = i + 1;
      return;
    }
    gone += length;
  }
}

}  // namespace

Layer with_change_places(Layer layer, const std::vector<Polygons>& regions, const std::vector<Polygons>& below,
                         const Path* before) {
  const std::vector<Polygons> none;
  for (Path& path : layer.paths) {
    const Path* from = std::exchange(before, &path);
    if (from == nullptr || from->extruder == path.extruder) continue;
    const bool is_first = &path == &layer.paths.front();  // it comes from the layer below
    std::vector<Vec2> way{from->end()};
    way.insert(way.end(), path.travel.begin(), path.travel.end());
    way.push_back(path.start());
    if (const auto clear = clear_from_mm(way, path.extruder, regions, is_first ? below : none))
      change_at(path, way, *clear + past_border_mm);
  }
  return layer;
}

}  // namespace cleancolor
