#include "model/repair.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "model/triangulate.hpp"
#include "model/weld.hpp"

namespace cleancolor {

namespace {

/// Drops the triangles that use a vertex twice and says how many.
std::size_t drop_degenerate(std::vector<Triangle>& triangles) {
  return std::erase_if(triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
}

constexpr std::uint32_t no_mate = UINT32_MAX;

/// For each half-edge the one on the other side, where exactly two triangles meet.
std::vector<std::uint32_t> mates(std::span<const EdgeUse> uses) {
  std::vector<std::uint32_t> mate(uses.size(), no_mate);
  for (std::size_t i = 0, n = 0; i < uses.size(); i += n) {
    n = edge_size(uses, i);
    if (n != 2) continue;
    mate[uses[i].half_edge] = uses[i + 1].half_edge;
    mate[uses[i + 1].half_edge] = uses[i].half_edge;
  }
  return mate;
}

}  // namespace

Repaired exactly_welded(Mesh mesh) {
  ExactWelder welder(mesh.vertices.size());
  std::vector<std::uint32_t> index;
  index.reserve(mesh.vertices.size());
  for (const Vec3& p : mesh.vertices) index.push_back(welder.add(p));
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& i : t) i = index[i];
  mesh.vertices = welder.take();
  const std::size_t dropped = drop_degenerate(mesh.triangles);
  return {std::move(mesh), dropped};
}

Repaired nearly_welded(Mesh mesh, std::span<const EdgeUse> uses, double tolerance_mm) {
  std::vector<char> candidate(mesh.vertices.size(), 0);
  for (std::size_t i = 0, n = 0; i < uses.size(); i += n) {
    n = edge_size(uses, i);
    if (n > 1 && edge_balance(uses.subspan(i, n)) == 0) continue;
    candidate[uses[i].low] = candidate[uses[i].high] = 1;
  }
  const std::vector<std::uint32_t> into = merged_within(mesh.vertices, candidate, tolerance_mm);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < into.size(); ++i) moved += into[i] != i ? 1 : 0;
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& i : t) i = into[i];
  drop_degenerate(mesh.triangles);
  return {std::move(mesh), moved};
}

Repaired without_duplicates(Mesh mesh, std::span<const EdgeUse> uses) {
  // Only triangles at an edge that is not shared by exactly two can have a double.
  std::vector<std::uint32_t> suspects;
  for (std::size_t i = 0, n = 0; i < uses.size(); i += n) {
    n = edge_size(uses, i);
    if (n == 2 && edge_balance(uses.subspan(i, n)) == 0) continue;
    for (const EdgeUse& use : uses.subspan(i, n)) suspects.push_back(use.half_edge / 3);
  }
  std::sort(suspects.begin(), suspects.end());
  suspects.erase(std::unique(suspects.begin(), suspects.end()), suspects.end());

  // Sorted by their corners, begun at the smallest: doubles stand side by side, the first of them stays.
  const auto key = [&](std::uint32_t i) {
    Triangle t = mesh.triangles[i];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  };
  std::vector<std::pair<Triangle, std::uint32_t>> keyed;
  keyed.reserve(suspects.size());
  for (const std::uint32_t i : suspects) keyed.emplace_back(key(i), i);
  std::sort(keyed.begin(), keyed.end());
  std::vector<char> drop(mesh.triangles.size(), 0);
  std::size_t dropped = 0;
  for (std::size_t i = 1; i < keyed.size(); ++i)
    if (keyed[i].first == keyed[i - 1].first) {
      drop[keyed[i].second] = 1;
      ++dropped;
    }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (!drop[i]) mesh.triangles[kept++] = mesh.triangles[i];
  mesh.triangles.resize(kept);
  return {std::move(mesh), dropped};
}

std::optional<Repaired> consistently_wound(Mesh mesh, std::span<const EdgeUse> uses) {
  const std::vector<std::uint32_t> mate = mates(uses);
  std::vector<char> up(uses.size());
  for (const EdgeUse& use : uses) up[use.half_edge] = use.up;

  enum State : char { unseen, as_it_is, turned };
  std::vector<char> state(mesh.triangles.size(), unseen);
  std::vector<std::uint32_t> surface;  // the triangles of one connected surface; also the queue of the flood
  std::size_t changed = 0;
  for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (state[seed] != unseen) continue;
    surface.assign(1, seed);
    state[seed] = as_it_is;
    std::size_t turned_here = 0;
    for (std::size_t at = 0; at < surface.size(); ++at) {
      const std::uint32_t t = surface[at];
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        if (mate[h] == no_mate) continue;
        const std::uint32_t other = mate[h] / 3;
        const bool same_way = up[h] == up[mate[h]];  // neighbours should pass their edge opposite ways
        const char wanted = same_way == (state[t] == as_it_is) ? turned : as_it_is;
        if (state[other] == unseen) {
          state[other] = wanted;
          turned_here += wanted == turned ? 1 : 0;
          surface.push_back(other);
        } else if (state[other] != wanted) {
          return std::nullopt;
        }
      }
    }
    const bool turn_the_others = turned_here * 2 > surface.size();
    changed += turn_the_others ? surface.size() - turned_here : turned_here;
    for (const std::uint32_t t : surface)
      if ((state[t] == turned) != turn_the_others) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  }
  return Repaired{std::move(mesh), changed};
}

namespace {

using Rim = std::vector<std::uint32_t>;  // vertices, in the sense in which a cap must follow them

/// The rims of all holes, each vertex at most once in each.
///
/// The open sides together form closed walks, since the three sides of every triangle do: as many of them lead to a
/// vertex as lead away from it. A walk that comes back to one of its vertices leaves a finished rim behind.
std::vector<Rim> rims(std::size_t vertices, std::span<const EdgeUse> uses) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides;  // from, to, along the cap
  for (std::size_t i = 0, n = 0; i < uses.size(); i += n) {
    n = edge_size(uses, i);
    const int balance = edge_balance(uses.subspan(i, n));
    for (int k = 0; k < std::abs(balance); ++k)
      sides.push_back(balance > 0 ? std::pair{uses[i].high, uses[i].low} : std::pair{uses[i].low, uses[i].high});
  }
  std::sort(sides.begin(), sides.end());
  std::vector<std::uint32_t> next(vertices + 1, 0);  // the first unused side from each vertex
  for (const auto& side : sides) ++next[side.first + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  const std::vector<std::uint32_t> end(next.begin() + 1, next.end());

  std::vector<Rim> rims;
  constexpr std::uint32_t nowhere = UINT32_MAX;
  std::vector<std::uint32_t> place(vertices, nowhere);  // of each vertex in the walk
  Rim walk;
  for (const auto& side : sides) {
    std::uint32_t at = side.first;
    while (next[at] < end[at]) {
      place[at] = std::uint32_t(walk.size());
      walk.push_back(at);
      at = sides[next[at]++].second;
      if (place[at] == nowhere) continue;
      rims.emplace_back(walk.begin() + place[at], walk.end());
      walk.resize(place[at]);
      for (const std::uint32_t v : rims.back()) place[v] = nowhere;
    }
  }
  return rims;
}

/// Size of the rim, and how far its points are from their common plane.
struct RimShape {
  double size_mm = 0;
  double height_mm = 0;
};

RimShape shape(const std::vector<Vec3>& corners) {
  Box<Vec3> box;
  Vec3 sum, normal;
  for (const Vec3& p : corners) {
    box.add(p);
    sum = sum + p;
  }
  const Vec3 middle = sum * (1.0 / double(corners.size()));
  for (std::size_t i = 0; i < corners.size(); ++i)
    normal = normal + cross(corners[i] - middle, corners[(i + 1) % corners.size()] - middle);
  RimShape shape{length(box.size()), 0};
  if (length(normal) < 1e-12) return shape;  // a crack: all on one line, or folded on itself
  for (const Vec3& p : corners)
    shape.height_mm = std::max(shape.height_mm, std::abs(dot(p - middle, normal)) / length(normal));
  return shape;
}

}  // namespace

ClosedHoles without_holes(Mesh mesh, std::span<const EdgeUse> uses, const CheckLimits& limits) {
  ClosedHoles result;
  std::vector<Vec3> corners;
  const auto leave_open = [&](const Rim& rim, double size_mm) {
    ++result.open;
    if (size_mm < result.largest_open_mm) return;
    result.largest_open_mm = size_mm;
    result.where_open_mm = mesh.vertices[rim.front()];
  };
  for (const Rim& rim : rims(mesh.vertices.size(), uses)) {
    corners.clear();
    for (const std::uint32_t i : rim) corners.push_back(mesh.vertices[i]);
    const RimShape rim_shape = shape(corners);
    const bool is_flat = rim_shape.height_mm <= limits.flat_hole_share * rim_shape.size_mm;
    if (rim.size() > limits.hole_edges || (rim_shape.size_mm > limits.small_hole_mm && !is_flat)) {
      leave_open(rim, rim_shape.size_mm);
      continue;
    }
    for (const Triangle& t : triangulated(corners)) mesh.triangles.push_back({rim[t[0]], rim[t[1]], rim[t[2]]});
    ++result.holes;
    result.triangles += rim.size() - 2;
    result.largest_mm = std::max(result.largest_mm, rim_shape.size_mm);
  }
  result.mesh = std::move(mesh);
  return result;
}

}  // namespace cleancolor
