#include "replan/staged_layer.hpp"

#include <algorithm>
#include <iterator>
#include <ranges>
#include <utility>

namespace cleancolor {

namespace {

bool is_stop(const Path& path, const std::vector<Stop>& stops) {
  return std::ranges::find(stops, path.source, &Stop::source) != stops.end();
}

/// Each before the first paths of its extruder.
void add_walls(std::vector<Path> walls, std::vector<Layer>& parts, const std::vector<Stop>& stops) {
  for (Path& wall : std::views::reverse(walls)) {
    const auto is_own = [&](const Layer& part) {
      return part.paths.front().extruder == wall.extruder && !is_stop(part.paths.front(), stops);
    };
    const auto part = std::ranges::find_if(parts, is_own);
    std::vector<Path>& paths = (part == parts.end() ? parts.front() : *part).paths;
    paths.insert(paths.begin(), std::move(wall));
  }
}

}  // namespace

std::vector<Layer> parts_of(Layer layer, const std::vector<Stop>& stops) {
  std::vector<Path> paths = std::exchange(layer.paths, {});
  std::vector<Path> walls;
  std::vector<Layer> parts;
  bool begins = true;
  for (Path& path : paths) {
    if (!stops.empty() && path.source < 0) {
      walls.push_back(std::move(path));
      continue;
    }
    const bool stops_here = is_stop(path, stops);
    if (begins || stops_here) parts.push_back(layer);
    parts.back().paths.push_back(std::move(path));
    begins = stops_here;
  }
  add_walls(std::move(walls), parts, stops);
  return parts;
}

StagedLayer::StagedLayer(Layer layer, int first, const std::vector<Stop>& stops, const Config& config,
                         const PlanScene& scene, const SurfaceVisibility& visibility) {
  for (const Stop& stop : stops) {
    if (stop.lays) {
      stops_.push_back(stop);
      continue;
    }
    const auto path = std::ranges::find(layer.paths, stop.source, &Path::source);
    const bool begins = std::ranges::all_of(layer.paths.begin(), path, [](const Path& p) { return p.source < 0; });
    if (begins) first = stop.leaving.extruder;
    asides_.push_back({.stop = std::move(*path), .leaving = stop.leaving, .travel = {}});
    layer.paths.erase(path);
  }
  for (Layer& part : parts_of(std::move(layer), stops_)) {
    OrderState state{.extruder = parts_.empty() ? first : part.paths.front().extruder, .at = {}, .seams = {}};
    parts_.emplace_back(std::move(part), state, config, scene, visibility);
  }
}

/// Between `from` and the path after it; nothing where the file has no such stop.
StagedLayer::Aside* StagedLayer::stand(std::size_t part, std::size_t before, const Path& from, int next) {
  const auto aside = std::ranges::find_if(asides_, [&](const Aside& a) {
    return !a.used && a.stop.extruder == from.extruder && a.leaving.extruder == next;
  });
  if (from.points.empty() || from.extruder == next || aside == asides_.end()) return nullptr;
  aside->used = true;
  aside->part = part;
  aside->before = before;
  aside->stop.travel = parts_[part].way(from.extruder, from.end(), aside->stop.start());
  return &*aside;
}

bool StagedLayer::arrive_from(const Path& below) {
  last_ = below;
  for (std::size_t n = 0; n < parts_.size(); ++n) {
    PlannedLayer& part = parts_[n];
    if (const Aside* aside = stand(n, 0, last_, part.layer().paths.front().extruder)) last_ = aside->leaving;
    Layer before;
    before.paths.push_back(last_);
    if (!last_.points.empty()) part.arrive_from(before);
    const std::vector<Path>& paths = part.layer().paths;
    for (std::size_t i = 1; i < paths.size(); ++i)
      if (Aside* aside = stand(n, i, paths[i - 1], paths[i].extruder))
        aside->travel = part.way(paths[i].extruder, aside->leaving.end(), paths[i].start());
    last_ = paths.back();
    const auto stop = std::ranges::find(stops_, last_.source, &Stop::source);
    if (stop != stops_.end()) last_ = stop->leaving;
  }
  return std::ranges::all_of(asides_, &Aside::used);
}

Layer StagedLayer::release() && {
  Layer all;
  for (std::size_t n = 0; n < parts_.size(); ++n) {
    Layer part = std::move(parts_[n]).release();
    std::vector<Path> paths = std::move(part.paths);
    if (n == 0) all = std::move(part), all.paths.clear();
    for (std::size_t i = 0; i < paths.size(); ++i) {
      for (Aside& aside : asides_) {
        if (!aside.used || aside.part != n || aside.before != i) continue;
        all.paths.push_back(std::move(aside.stop));
        if (i > 0) paths[i].travel = std::move(aside.travel);
      }
      all.paths.push_back(std::move(paths[i]));
    }
  }
  return all;
}

}  // namespace cleancolor
