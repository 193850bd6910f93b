#include "model/shells.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <utility>

namespace cleancolor {

namespace {

std::uint32_t root(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) {
    parent[i] = parent[parent[i]];
    i = parent[i];
  }
  return i;
}

struct ShellFacts {
  Box<Vec3> box;
  double volume_mm3 = 0;
};

ShellFacts facts(const Mesh& mesh, std::span<const std::uint32_t> shell) {
  ShellFacts facts;
  const Vec3 o = mesh.vertices[mesh.triangles[shell.front()][0]];
  for (const std::uint32_t i : shell) {
    const auto& [a, b, c] = mesh.triangles[i];
    for (const std::uint32_t v : {a, b, c}) facts.box.add(mesh.vertices[v]);
    facts.volume_mm3 += dot(mesh.vertices[a] - o, cross(mesh.vertices[b] - o, mesh.vertices[c] - o)) / 6;
  }
  return facts;
}

bool contains(const Box<Vec3>& box, Vec3 p) {
  return p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y && p.z >= box.min.z &&
         p.z <= box.max.z;
}

Vec3 center(const Mesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) * (1.0 / 3);
}

/// Turns and tests shells; counts its work so that a hostile file cannot keep it busy.
class Turning {
 public:
  Turning(Mesh mesh, Shells shells) : mesh_(std::move(mesh)), shells_(std::move(shells)) {
    for (const auto& shell : shells_.triangles) facts_.push_back(facts(mesh_, shell));
  }

  Outward outward() {
    Outward result;
    const std::size_t count = shells_.triangles.size();
    std::vector<char> is_turned(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
      if (facts_[i].volume_mm3 >= 0 || is_turned[i] || lies_in_another(i)) continue;
      turn(i, is_turned);
      for (std::size_t k = 0; k < count && count > 1; ++k)
        if (k != i && !is_turned[k] && lies_in(k, i)) turn(k, is_turned);
    }
    result.turned = std::size_t(std::count(is_turned.begin(), is_turned.end(), char(1)));
    result.tested_all = work_ < max_work;
    work_ = max_work - std::min(max_work, sampling_work);
    for (std::size_t i = 0; i < count; ++i) result.overlapping += overlaps_another(i) ? 1 : 0;
    result.mesh = std::move(mesh_);
    return result;
  }

 private:
  static constexpr std::size_t max_work = 100'000'000;   // triangles looked at: seconds
  static constexpr std::size_t sampling_work = 250'000;  // likewise, for the warning about overlaps

  void turn(std::size_t i, std::vector<char>& is_turned) {
    is_turned[i] = 1;
    facts_[i].volume_mm3 = -facts_[i].volume_mm3;
    for (const std::uint32_t t : shells_.triangles[i]) std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]);
  }

  bool lies_in_another(std::size_t i) {
    for (std::size_t k = 0; k < shells_.triangles.size(); ++k)
      if (k != i && lies_in(i, k)) return true;
    return false;
  }

  /// Whether a point of shell i is inside shell k, whichever way this faces.
  bool lies_in(std::size_t i, std::size_t k) {
    const Vec3 p = center(mesh_, shells_.triangles[i].front());
    ++work_;
    return contains(facts_[k].box, p) && is_inside(k, p);
  }

  bool is_inside(std::size_t k, Vec3 p) {
    if (work_ >= max_work) return false;
    work_ += shells_.triangles[k].size();
    return std::abs(winding(mesh_, shells_.triangles[k], p)) > 0.5;
  }

  /// Whether a few points of an outward shell lie inside another outward shell.
  bool overlaps_another(std::size_t i) {
    constexpr std::size_t samples = 12;
    const auto& shell = shells_.triangles[i];
    if (facts_[i].volume_mm3 <= 0) return false;
    for (std::size_t k = 0; k < shells_.triangles.size() && work_ < max_work; ++k) {
      ++work_;
      if (k == i || facts_[k].volume_mm3 <= 0) continue;
      const std::size_t step = std::max<std::size_t>(1, shell.size() / samples);
      for (std::size_t s = 0; s < shell.size(); s += step)
        for (const std::uint32_t v : mesh_.triangles[shell[s]]) {
          // A little towards the inside of the shell's box: a point on a shared face is no overlap.
          const Vec3 p = mesh_.vertices[v] + (facts_[i].box.center() - mesh_.vertices[v]) * 1e-3;
          if (contains(facts_[k].box, p) && is_inside(k, p) && is_inside(i, p)) return true;
        }
    }
    return false;
  }

  Mesh mesh_;
  Shells shells_;
  std::vector<ShellFacts> facts_;
  std::size_t work_ = 0;
};

std::size_t touching_vertices(const Mesh& mesh, const Shells& shells) {
  std::vector<std::uint32_t> shell_of(mesh.vertices.size(), UINT32_MAX);
  std::vector<char> touches(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (shell_of[v] != UINT32_MAX && shell_of[v] != shells.of_triangle[t]) touches[v] = 1;
      shell_of[v] = shells.of_triangle[t];
    }
  return std::size_t(std::count(touches.begin(), touches.end(), char(1)));
}

}  // namespace

Shells shells(const Mesh& mesh, std::span<const EdgeUse> uses) {
  std::vector<std::uint32_t> parent(mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), 0U);
  for (std::size_t i = 1; i < uses.size(); ++i) {
    if (uses[i].low != uses[i - 1].low || uses[i].high != uses[i - 1].high) continue;
    const std::uint32_t a = root(parent, uses[i].half_edge / 3), b = root(parent, uses[i - 1].half_edge / 3);
    parent[std::max(a, b)] = std::min(a, b);
  }
  Shells result;
  result.of_triangle.resize(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t first = root(parent, t);
    if (first == t) {
      result.of_triangle[t] = std::uint32_t(result.triangles.size());
      result.triangles.emplace_back();
    } else {
      result.of_triangle[t] = result.of_triangle[first];
    }
    result.triangles[result.of_triangle[t]].push_back(t);
  }
  return result;
}

double winding(const Mesh& mesh, std::span<const std::uint32_t> shell, Vec3 point) {
  double angle = 0;
  for (const std::uint32_t i : shell) {
    const auto& [ia, ib, ic] = mesh.triangles[i];
    const Vec3 a = mesh.vertices[ia] - point, b = mesh.vertices[ib] - point, c = mesh.vertices[ic] - point;
    const double la = length(a), lb = length(b), lc = length(c);
    angle += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4 * std::numbers::pi);
}

Outward facing_outward(Mesh mesh, std::span<const EdgeUse> uses) {
  Shells found = shells(mesh, uses);
  const std::size_t touching = found.triangles.size() > 1 ? touching_vertices(mesh, found) : 0;
  Outward result = Turning(std::move(mesh), std::move(found)).outward();
  result.touching = touching;
  return result;
}

}  // namespace cleancolor
