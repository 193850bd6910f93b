#include "plan/seam.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cleancolor {
namespace {

constexpr double follow_mm = 3;    // an aligned seam follows one of the layer below that is at most this far away
constexpr double corner_mm = 1.5;  // a right-angled corner is worth this much detour
constexpr double new_point_mm = 0.3;

/// How sharp the corner is, in [0, 1]: 0 straight on, 1 straight back. Inner corners hide a seam better than outer
/// ones.
double sharpness(const std::vector<Vec2>& points, std::size_t i) {
  const std::size_t n = points.size();
  const Vec2 in = points[i] - points[(i + n - 1) % n], out = points[(i + 1) % n] - points[i];
  const double lengths = length(in) * length(out);
  if (lengths <= 0) return 0;
  const double turn = (1 - dot(in, out) / lengths) / 2;
  return cross(in, out) < 0 ? std::min(1.0, turn * 1.2) : turn;
}

std::size_t sharpest(const std::vector<Vec2>& points) {
  // Of equally sharp corners the rearmost, so that a column of equal loops keeps its seam in one line.
  std::size_t best = 0;
  double best_score = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double score = std::round(sharpness(points, i) * 50);
    const bool further_back =
        points[i].y > points[best].y || (points[i].y == points[best].y && points[i].x > points[best].x);
    if (score > best_score || (score == best_score && further_back)) best_score = score, best = i;
  }
  return best;
}

std::size_t near_corner(const std::vector<Vec2>& points, Vec2 from) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double cost = distance(points[i], from) - 2 * corner_mm * sharpness(points, i);
    if (cost < least) least = cost, best = i;
  }
  return best;
}

struct OnLoop {
  std::size_t segment = 0;
  Vec2 at;
  double distance_mm = std::numeric_limits<double>::infinity();
};

OnLoop nearest_on(const std::vector<Vec2>& points, Vec2 p) {
  OnLoop best;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 q = nearest_on_segment(points[i], points[(i + 1) % points.size()], p);
    if (const double off = distance(p, q); off < best.distance_mm) best = {i, q, off};
  }
  return best;
}

Path begun_at(Path loop, const OnLoop& place) {
  const std::size_t next = (place.segment + 1) % loop.points.size();
  const double to_a = distance(loop.points[place.segment], place.at), to_b = distance(loop.points[next], place.at);
  if (std::min(to_a, to_b) > new_point_mm) return started_on(std::move(loop), place.segment, place.at);
  return started_at(std::move(loop), to_a <= to_b ? place.segment : next);
}

/// The place of the loop nearest to a seam of the layer below, else its sharpest corner.
OnLoop aligned(const Path& loop, const std::vector<Vec2>& seams_below) {
  Box<Vec2> box;
  for (const Vec2 p : loop.points) box.add(p);
  OnLoop best;
  for (const Vec2 seam : seams_below) {
    if (seam.x < box.min.x - follow_mm || seam.x > box.max.x + follow_mm || seam.y < box.min.y - follow_mm ||
        seam.y > box.max.y + follow_mm)
      continue;
    const OnLoop place = nearest_on(loop.points, seam);
    if (place.distance_mm < best.distance_mm) best = place;
  }
  if (best.distance_mm <= follow_mm) return best;
  const std::size_t corner = sharpest(loop.points);
  return {corner, loop.points[corner], 0};
}

/// A point at a share of the loop's length that looks random but is the same in every run.
Path scattered(Path loop, std::uint32_t seed) {
  std::uint32_t h = seed * 2654435761u;  // Knuth's multiplicative hash, then mixed
  h ^= h >> 16;
  h *= 0x45d9f3bu;
  h ^= h >> 16;
  double left = length_mm(loop) * (double(h) / 4294967296.0);
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const Vec2 a = loop.points[i], b = loop.points[(i + 1) % loop.points.size()];
    const double l = distance(a, b);
    if (left <= l && l > 0) return begun_at(std::move(loop), {i, lerp(a, b, left / l), 0});
    left -= l;
  }
  return loop;
}

}  // namespace

Path seamed(Path loop, SeamPosition position, Vec2 from, SeamMemory& memory, std::uint32_t seed) {
  const auto e = std::size_t(loop.extruder);
  if (memory.below.size() <= e) memory.below.resize(e + 1);
  if (memory.here.size() <= e) memory.here.resize(e + 1);
  const auto& points = loop.points;
  switch (position) {
    case SeamPosition::nearest: {
      const std::size_t corner = near_corner(points, from);
      loop = started_at(std::move(loop), corner);
      break;
    }
    case SeamPosition::hidden:
    case SeamPosition::aligned: {
      // The place itself is remembered, not the corner near it that may be taken: else the seam would wander off.
      const OnLoop place = aligned(loop, memory.below[e]);
      memory.here[e].push_back(place.at);
      return begun_at(std::move(loop), place);
    }
    case SeamPosition::rear: {
      const auto rearmost = std::max_element(points.begin(), points.end(), [](Vec2 a, Vec2 b) { return a.y < b.y; });
      const auto corner = std::size_t(rearmost - points.begin());
      loop = started_at(std::move(loop), corner);
      break;
    }
    case SeamPosition::random:
      loop = scattered(std::move(loop), seed);
      break;
  }
  return loop;
}

}  // namespace cleancolor
