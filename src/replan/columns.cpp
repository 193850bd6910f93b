#include "replan/columns.hpp"

#include <algorithm>
#include <functional>
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

double around_mm(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) sum += distance(to_mm(ring[i]), to_mm(ring[(i + 1) % ring.size()]));
  return sum;
}

std::size_t column_of(const Ring& ring, const std::vector<Box<Vec2>>& boxes) {
  const auto holds = [box = bounds_mm({ring})](const Box<Vec2>& column) { return are_near(box, column, 0); };
  return std::size_t(std::ranges::find_if(boxes, holds) - boxes.begin());
}

Slices with_rings(Slices slices, const std::function<bool(const Ring&)>& keeps) {
  for (PackedPolygons& outline : slices.outlines) {
    Polygons rings = outline;
    std::erase_if(rings, std::not_fn(keeps));
    outline = rings;
  }
  return slices;
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
  std::vector<double> around(boxes.size(), 0.);
  std::vector<char> goes_up(boxes.size(), 0);
  for (const Polygons outline : slices.outlines) {
    std::ranges::fill(goes_up, 0);
    for (const Ring& ring : outline) {
      const std::size_t column = column_of(ring, boxes);
      around[column] += around_mm(ring);
      goes_up[column] = 1;
    }
  }
  std::size_t best = boxes.size();
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (goes_up[i] != 0 && (best == boxes.size() || around[i] < around[best])) best = i;
  if (best == boxes.size()) return std::nullopt;
  return with_rings(slices, [&](const Ring& ring) { return column_of(ring, boxes) == best; });
}

Slices without_columns_beside(const Slices& slices, const Slices& part, double apart_mm) {
  const std::vector<Box<Vec2>> boxes = columns(slices, apart_mm);
  std::vector<char> holds_part(boxes.size(), 0);
  for (const Polygons outline : part.outlines)
    for (const Ring& ring : outline)
      if (const std::size_t column = column_of(ring, boxes); column < boxes.size()) holds_part[column] = 1;
  return with_rings(slices, [&](const Ring& ring) { return holds_part[column_of(ring, boxes)] != 0; });
}

}  // namespace cleancolor
