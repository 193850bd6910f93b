// base/vec.hpp
//
// Vec2, Vec3: points and displacements in mm, as doubles. Polygons have integer points of their own: base/polygon.hpp.
#pragma once

#include <algorithm>
#include <cmath>

namespace cleancolor {

struct Vec2 {
  double x = 0;
  double y = 0;

  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator*(Vec2 a, double s) { return {a.x * s, a.y * s}; }
  friend constexpr Vec2 operator*(double s, Vec2 a) { return a * s; }
  friend constexpr bool operator==(Vec2, Vec2) = default;
};

constexpr double dot(Vec2 a, Vec2 b) {
  return a.x * b.x + a.y * b.y;
}
constexpr double cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}
constexpr double length_squared(Vec2 a) {
  return dot(a, a);
}
inline double length(Vec2 a) {
  return std::sqrt(dot(a, a));
}
inline double distance(Vec2 a, Vec2 b) {
  return length(b - a);
}
constexpr Vec2 lerp(Vec2 a, Vec2 b, double t) {
  return a + (b - a) * t;
}
/// The place of the segment from a to b that is nearest to p.
constexpr Vec2 nearest_on_segment(Vec2 a, Vec2 b, Vec2 p) {
  const double squared = length_squared(b - a);
  return lerp(a, b, squared > 0 ? std::clamp(dot(p - a, b - a) / squared, 0., 1.) : 0);
}
/// Turned about the origin, counterclockwise.
inline Vec2 turned(Vec2 v, double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

struct Vec3 {
  double x = 0;
  double y = 0;
  double z = 0;

  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator*(Vec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(double s, Vec3 a) { return a * s; }
  friend constexpr bool operator==(Vec3, Vec3) = default;
};

constexpr double dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) {
  return std::sqrt(dot(a, a));
}
inline double distance(Vec3 a, Vec3 b) {
  return length(b - a);
}

/// An axis-aligned box; empty until a point is added.
template <class V>
struct Box;

template <>
struct Box<Vec2> {
  Vec2 min{INFINITY, INFINITY};
  Vec2 max{-INFINITY, -INFINITY};

  bool empty() const { return min.x > max.x; }
  Vec2 size() const { return max - min; }
  Vec2 center() const { return (min + max) * 0.5; }
  void add(Vec2 p) {
    min = {std::fmin(min.x, p.x), std::fmin(min.y, p.y)};
    max = {std::fmax(max.x, p.x), std::fmax(max.y, p.y)};
  }
};

template <>
struct Box<Vec3> {
  Vec3 min{INFINITY, INFINITY, INFINITY};
  Vec3 max{-INFINITY, -INFINITY, -INFINITY};

  bool empty() const { return min.x > max.x; }
  Vec3 size() const { return max - min; }
  Vec3 center() const { return (min + max) * 0.5; }
  void add(Vec3 p) {
    min = {std::fmin(min.x, p.x), std::fmin(min.y, p.y), std::fmin(min.z, p.z)};
    max = {std::fmax(max.x, p.x), std::fmax(max.y, p.y), std::fmax(max.z, p.z)};
  }
};

}  // namespace cleancolor
