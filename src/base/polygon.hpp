// base/polygon.hpp
//
// Polygons on an integer grid of 1 nm, and what Clipper does with them, in mm.
//
// A Ring is closed and does not repeat its first point. Polygons are rings that bound a region by the non-zero rule:
// after any operation below, outlines run counterclockwise, holes clockwise, and none cross. Coordinates stay exact up
// to
// +-1073 mm, where Clipper computes in 64 bits; the pipeline refuses larger beds.
#pragma once

#include <polyclipping/clipper.hpp>
#include <vector>

#include "base/vec.hpp"

namespace cleancolor {

using Point = ClipperLib::IntPoint;  // X, Y in nm
using Ring = ClipperLib::Path;
using Polygons = ClipperLib::Paths;

inline constexpr double nm_per_mm = 1e6;
inline constexpr double mm_per_nm = 1e-6;

inline Point to_nm(Vec2 p) {
  return {std::llround(p.x * nm_per_mm), std::llround(p.y * nm_per_mm)};
}
inline Vec2 to_mm(Point p) {
  return {double(p.X) * mm_per_nm, double(p.Y) * mm_per_nm};
}

inline void append(Polygons& to, const Polygons& from) {
  to.insert(to.end(), from.begin(), from.end());
}
std::vector<Vec2> to_mm(const Ring& ring);

/// One connected piece: an outline (counterclockwise) and its holes (clockwise).
struct Island {
  Ring outline;
  Polygons holes;
};

enum class Corners { miter, round, square };

// Boolean operations, by the non-zero rule.  Cost: Clipper, about n log n in the number of points.
Polygons united(const Polygons& a);
Polygons united(const Polygons& a, const Polygons& b);
/// Outer rings alone, united: what lies in a hole lies inside.
Polygons filled(const Polygons& region);
Polygons intersection(const Polygons& a, const Polygons& b);
Polygons difference(const Polygons& a, const Polygons& b);

/// The region grown (delta > 0) or shrunk by delta_mm. Mitred corners are cut at 3 times delta.
Polygons offset(const Polygons& region, double delta_mm, Corners corners = Corners::miter);

/// Shrunk by radius_mm and grown again: what a disc of that radius can reach (up to the corners).
Polygons opened(const Polygons& region, double radius_mm, Corners corners = Corners::miter);

/// Grown and shrunk again: gaps narrower than 2 x radius_mm are filled.
Polygons closed(const Polygons& region, double radius_mm, Corners corners = Corners::miter);

/// Every ring with as few of its points as keep within tolerance_mm of the dropped ones (Douglas-Peucker); rings that
/// collapse are dropped. Not checked for new crossings: tolerance_mm is small against the details of the region.
Polygons simplified(const Polygons& region, double tolerance_mm);

/// An open line likewise; both ends stay.
std::vector<Vec2> simplified(const std::vector<Vec2>& line, double tolerance_mm);

/// Connected pieces in the order of their outlines in region; an island inside a hole is an island of its own.
std::vector<Island> islands(const Polygons& region);
Polygons polygons(const Island& island);

double area_mm2(const Ring& ring);  // signed: counterclockwise positive
double area_mm2(const Polygons& region);
double length_mm(const Ring& ring);  // closed
double length_mm(const Polygons& region);
Box<Vec2> bounds_mm(const Polygons& region);
bool contains(const Polygons& region, Point p);  // the border counts as inside

/// From p to the nearest place on the rings, inside or out; infinite where there are none.  Cost: all edges.
double border_distance_mm(const Polygons& region, Vec2 p_mm);

Polygons rectangle(Vec2 min_mm, Vec2 max_mm);
Ring convex_hull(const Polygons& region);

}  // namespace cleancolor
