#include "replan/columns.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cleancolor {
namespace {

bool are_near(const Box<Vec2>& a, const Box<Vec2>& b, double apart_mm) {
  return a.min.x < b.max.x + apart_mm && b.min.x < a.max.x + apart_mm && a.min.y < b.max.y + apart_mm &&
         b.min.y < a.max.y + apart_mm;
}

void join(std::vector<Box<Vec2>>& boxes, Box<Vec2> box, double apart_mm) {
  const auto is_near = [&](const Box<Vec2>& other) { return are_near(box, other, apart_mm); };
  for (auto near = std::ranges::find_if(boxes, is_near); near != boxes.end();
       near = std::ranges::find_if(boxes, is_near)) {
    box.add(near->min);
    box.add(near->max);
    boxes.erase(near);
  }
  boxes.push_back(box);
}

Polygons within(const Polygons& region, const Box<Vec2>& box) {
  Polygons inside;
  for (const Ring& ring : region)
    if (are_near(bounds_mm({ring}), box, 0)) inside.push_back(ring);
  return inside;
}

double around_mm(const Polygons& region) {
  double sum = 0;
  for (const Ring& ring : region)
    for (std::size_t i = 0; i < ring.size(); ++i) sum += distance(to_mm(ring[i]), to_mm(ring[(i + 1) % ring.size()]));
  return sum;
}

}  // namespace

std::vector<Box<Vec2>> columns(const Slices& slices, double apart_mm) {
  std::vector<Box<Vec2>> boxes;
  for (const Polygons outline : slices.outlines)
    for (const Ring& ring : outline) join(boxes, bounds_mm({ring}), apart_mm);
  return boxes;
}

std::optional<Slices> shortest_column(const Slices& slices, double apart_mm) {
  const std::vector<Box<Vec2>> boxes = columns(slices, apart_mm);
  if (boxes.size() < 2) return std::nullopt;
  std::optional<Slices> best;
  double least_mm = INFINITY;
  for (const Box<Vec2>& box : boxes) {
    Slices column = slices;
    double sum_mm = 0;
    for (PackedPolygons& outline : column.outlines) {
      const Polygons inside = within(outline, box);
      sum_mm += around_mm(inside);
      outline = inside;
    }
    if (Polygons(column.outlines.back()).empty() || sum_mm >= least_mm) continue;
    least_mm = sum_mm;
    best = std::move(column);
  }
  return best;
}

}  // namespace cleancolor
