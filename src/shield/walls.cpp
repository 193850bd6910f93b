#include "shield/walls.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

namespace cleancolor {
namespace {

constexpr double overlap_mm = 1;  // of two halves at each joint

Path wall_path(std::vector<Vec2> points, bool closed, const WallPrinter& printer) {
  Path path;
  path.extruder = printer.extruder;
  path.island = -1;
  path.closed = closed;
  path.points = std::move(points);
  path.stretches = {{0, printer.road}};
  return path;
}

/// The pieces of a ring where dot(p, along) >= least; the whole ring where all of it does.
std::vector<std::vector<Vec2>> pieces_beyond(const std::vector<Vec2>& ring, Vec2 along, double least) {
  const std::size_t n = ring.size();
  const auto beyond = [&](std::size_t i) { return dot(ring[i % n], along) - least; };
  std::size_t first = 0;  // a point that lies below, so that no piece goes on over the end
  while (first < n && beyond(first) >= 0) ++first;
  if (first == n) return {ring};
  const auto cut = [&](std::size_t i) {
    return lerp(ring[i % n], ring[(i + 1) % n], beyond(i) / (beyond(i) - beyond(i + 1)));
  };
  std::vector<std::vector<Vec2>> pieces;
  for (std::size_t i = first; i < first + n; ++i) {
    const bool in = beyond(i) >= 0, next_in = beyond(i + 1) >= 0;
    if (!in && next_in) pieces.push_back({cut(i)});
    if (next_in) pieces.back().push_back(ring[(i + 1) % n]);
    if (in && !next_in) pieces.back().push_back(cut(i));
  }
  return pieces;
}

/// From the inside out.
std::vector<Polygons> brim_loops(const Polygons& wall, double width_mm, double spacing_mm) {
  std::vector<Polygons> result;
  for (int i = 1; i <= int(width_mm / spacing_mm); ++i) {
    result.emplace_back();
    for (const Ring& ring : offset(wall, spacing_mm * i, Corners::round))
      if (ClipperLib::Orientation(ring)) result.back().push_back(ring);
  }
  return result;
}

}  // namespace

std::vector<Path> wall_paths(std::span<const Polygons> walls, std::span<const WallPrinter> printers) {
  assert(printers.size() >= walls.size());
  std::vector<Path> paths;
  for (std::size_t k = 0; k < walls.size(); ++k)
    for (const Ring& ring : walls[k]) paths.push_back(wall_path(to_mm(ring), true, printers[k]));
  return paths;
}

std::vector<Path> half_wall_paths(const Polygons& wall, const std::array<WallPrinter, 2>& printers, Vec2 to_second) {
  assert(to_second != Vec2{});
  std::vector<Path> paths;
  Vec2 along = to_second * (1 / length(to_second));
  for (const WallPrinter& printer : printers) {
    for (const Ring& ring : wall) {
      const std::vector<Vec2> points = to_mm(ring);
      const auto [least, most] = std::ranges::minmax(points, {}, [&](Vec2 p) { return dot(p, along); });
      const double middle = dot(least + most, along) / 2;
      const auto pieces = pieces_beyond(points, along, middle - overlap_mm / 2);
      const bool whole = pieces.size() == 1 && pieces.front() == points;
      if (whole && &printer != &printers[0]) continue;
      for (const std::vector<Vec2>& piece : pieces) paths.push_back(wall_path(piece, whole, printer));
    }
    along = along * -1;
  }
  return paths;
}

std::vector<Path> wall_brims(std::span<const Polygons> walls, std::span<const WallPrinter> printers, double width_mm,
                             double gap_mm, double spacing_mm) {
  assert(spacing_mm > 0);
  std::vector<Path> paths;
  for (std::size_t k = 0; k < walls.size(); ++k) {
    const double width = k + 1 < walls.size() ? std::min(width_mm, (gap_mm - spacing_mm) / 2) : width_mm;
    for (const Polygons& loops : brim_loops(walls[k], width, spacing_mm))
      for (const Ring& ring : loops) paths.push_back(wall_path(to_mm(ring), true, printers[k]));
  }
  return paths;
}

std::vector<Path> half_wall_brims(const Polygons& wall, const std::array<WallPrinter, 2>& printers, double width_mm,
                                  double spacing_mm, Vec2 to_second) {
  std::vector<Path> paths;
  for (const Polygons& loops : brim_loops(wall, width_mm, spacing_mm))
    std::ranges::move(half_wall_paths(loops, printers, to_second), std::back_inserter(paths));
  return paths;
}

}  // namespace cleancolor
