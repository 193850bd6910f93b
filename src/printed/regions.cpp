#include "printed/regions.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace cleancolor {
namespace {

constexpr double like_width_mm = 0.02;
constexpr double seam_gap_mm = 1;  // walls that end so near to their start are closed
constexpr int corners_an_end = 8;  // of a stadium's half circle
constexpr double air_mm = 1;       // around all, so that the outside is one piece

bool may_be_outer(Role role) {
  return role == Role::external_perimeter || role == Role::overhang_perimeter || role == Role::unknown;
}

/// Roads one after the other, as one line.
struct RoadLine {
  std::vector<Vec2> points_mm;
  double width_mm = 0;
};

std::vector<RoadLine> lines_of(std::span<const LaidRoad> roads) {
  std::vector<RoadLine> lines;
  for (const LaidRoad& r : roads) {
    const bool goes_on = !lines.empty() && lines.back().points_mm.back() == r.from_mm &&
                         std::abs(lines.back().width_mm - r.width_mm) < like_width_mm;
    if (!goes_on) lines.push_back({{r.from_mm}, r.width_mm});
    lines.back().points_mm.push_back(r.to_mm);
  }
  return lines;
}

/// Seams: the plastic flows together there, whatever gap the file leaves.
void close_seams(std::vector<RoadLine>& lines) {
  for (RoadLine& line : lines) {
    const double gap = distance(line.points_mm.front(), line.points_mm.back());
    if (line.points_mm.size() > 3 && gap > 0 && gap <= seam_gap_mm) line.points_mm.push_back(line.points_mm.front());
  }
}

Polygons plastic_of(const std::vector<RoadLine>& lines, double detail_mm) {
  Polygons rings;
  for (const RoadLine& line : lines) {
    const std::vector<Vec2> points = simplified(line.points_mm, detail_mm);
    for (std::size_t i = 1; i < points.size(); ++i) rings.push_back(stadium(points[i - 1], points[i], line.width_mm));
  }
  return united(rings);
}

/// A piece of plane without outer walls.
struct Face {
  Polygons rings;
  Box<Vec2> box;
  bool filled = false;

  bool has(Vec2 p) const {
    return p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y && contains(rings, to_nm(p));
  }
};

std::vector<Face> faces_between(const Polygons& walls) {
  const Box<Vec2> box = bounds_mm(walls);
  const Vec2 air{air_mm, air_mm};
  const Ring around = rectangle(box.min - air, box.max + air).front();
  std::vector<Face> faces;
  for (const Island& island : islands(difference({around}, walls))) {
    Face face{.rings = polygons(island), .box = bounds_mm({island.outline}), .filled = false};
    if (face.box.min.x > box.min.x - air_mm / 2) faces.push_back(std::move(face));  // else it is the outside
  }
  return faces;
}

}  // namespace

Ring stadium(Vec2 a, Vec2 b, double width_mm) {
  assert(width_mm > 0);
  Ring ring;
  const double r = width_mm / 2, heading = std::atan2(b.y - a.y, b.x - a.x);
  for (const Vec2 end : {b, a}) {
    const double from = heading + (end == b && ring.empty() ? -0.5 : 0.5) * std::numbers::pi;
    for (int i = 0; i <= corners_an_end; ++i) {
      const double angle = from + i * std::numbers::pi / corners_an_end;
      ring.push_back(to_nm(end + Vec2{std::cos(angle), std::sin(angle)} * r));
    }
  }
  return ring;
}

Polygons plastic(std::span<const LaidRoad> roads, double detail_mm) {
  return plastic_of(lines_of(roads), detail_mm);
}

Polygons region(std::span<const LaidRoad> roads, int nozzle, double detail_mm) {
  std::vector<LaidRoad> outer, inner;
  for (const LaidRoad& r : roads)
    if (r.nozzle == nozzle && !is_auxiliary(r.role)) (may_be_outer(r.role) ? outer : inner).push_back(r);
  std::vector<RoadLine> lines = lines_of(outer);
  close_seams(lines);
  const Polygons walls = plastic_of(lines, detail_mm);
  if (walls.empty()) return plastic(inner, detail_mm);
  std::vector<Face> faces = faces_between(walls);
  std::vector<LaidRoad> beyond;
  for (const LaidRoad& r : inner) {
    const Vec2 middle = lerp(r.from_mm, r.to_mm, 0.5);
    const auto in = std::ranges::find_if(faces, [&](const Face& f) { return f.has(middle); });
    if (in != faces.end())
      in->filled = true;
    else if (!contains(walls, to_nm(middle)))
      beyond.push_back(r);
  }
  Polygons all = walls;
  for (const Face& face : faces)
    if (face.filled) all.insert(all.end(), face.rings.begin(), face.rings.end());
  const Polygons rest = plastic(beyond, detail_mm);
  all.insert(all.end(), rest.begin(), rest.end());
  return united(all);
}

bool has_part(std::span<const LaidRoad> roads) {
  return std::ranges::any_of(roads, [](const LaidRoad& r) { return !is_auxiliary(r.role); });
}

double median_depth_mm(std::span<const Vec2> places, const Polygons& region) {
  std::vector<double> depths;
  for (const Vec2 p : places) depths.push_back(border_distance_mm(region, p));
  const auto middle = depths.begin() + std::ptrdiff_t(depths.size() / 2);
  std::ranges::nth_element(depths, middle);
  return *middle;
}

}  // namespace cleancolor
