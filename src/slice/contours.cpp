#include "slice/contours.hpp"

#include <algorithm>
#include <utility>

namespace cleancolor {
namespace {

using EdgeKey = std::uint64_t;

EdgeKey edge_key(std::uint32_t a, std::uint32_t b) {
  return a < b ? EdgeKey(a) << 32 | b : EdgeKey(b) << 32 | a;
}

/// One triangle's share of the contour: from the edge that goes down through the plane to the one that goes up.
struct Cut {
  EdgeKey from;
  EdgeKey to;
  Point at;  // on the edge `from`
};

/// Where the edge meets the plane. The ends are ordered by position, not by index, so that two meshes that share an
/// edge get the same point to the last bit.
Point edge_point(Vec3 a, Vec3 b, double z) {
  if (std::pair(a.z, std::pair(a.x, a.y)) > std::pair(b.z, std::pair(b.x, b.y))) std::swap(a, b);
  const double t = b.z > a.z ? std::clamp((z - a.z) / (b.z - a.z), 0.0, 1.0) : 0;
  return to_nm({a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t});
}

/// Rings from cuts: each goes on with the cut that starts on the edge where it ends.
Polygons chained(std::vector<Cut> cuts) {
  std::sort(cuts.begin(), cuts.end(),
            [](const Cut& a, const Cut& b) { return std::pair(a.from, a.to) < std::pair(b.from, b.to); });
  std::vector<char> used(cuts.size(), 0);
  const auto next_of = [&](EdgeKey edge) {
    auto it = std::lower_bound(cuts.begin(), cuts.end(), edge, [](const Cut& c, EdgeKey e) { return c.from < e; });
    while (it != cuts.end() && it->from == edge && used[std::size_t(it - cuts.begin())]) ++it;
    return it != cuts.end() && it->from == edge ? std::size_t(it - cuts.begin()) : cuts.size();
  };
  Polygons result;
  for (std::size_t first = 0; first < cuts.size(); ++first) {
    if (used[first]) continue;
    Ring ring;
    for (std::size_t i = first; i < cuts.size(); i = next_of(cuts[i].to)) {
      used[i] = 1;
      const Point p = cuts[i].at;
      if (ring.empty() || p != ring.back()) ring.push_back(p);
    }
    while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    if (ring.size() >= 3) result.push_back(std::move(ring));
  }
  return result;
}

}  // namespace

PlaneCuts::PlaneCuts(const Mesh& mesh, std::span<const double> z_mm) : mesh_(mesh), z_mm_(z_mm.begin(), z_mm.end()) {
  top_mm_ = bounds(mesh).max.z;
  const auto planes_of = [&](const Triangle& t) {
    const auto [low, high] = std::minmax({mesh.vertices[t[0]].z, mesh.vertices[t[1]].z, mesh.vertices[t[2]].z});
    const auto first = std::lower_bound(z_mm_.begin(), z_mm_.end(), low) - z_mm_.begin();
    const auto last = std::upper_bound(z_mm_.begin() + first, z_mm_.end(), high) - z_mm_.begin();
    return std::pair(std::size_t(first), std::size_t(last));
  };
  // Counted, then filled: a list per plane in two passes.
  std::vector<std::uint32_t> count(z_mm_.size() + 1, 0);
  for (const Triangle& t : mesh.triangles) {
    const auto [first, last] = planes_of(t);
    for (std::size_t k = first; k < last; ++k) ++count[k + 1];
  }
  for (std::size_t k = 1; k < count.size(); ++k) count[k] += count[k - 1];
  first_ = count;
  triangles_.resize(count.back());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [first, last] = planes_of(mesh.triangles[i]);
    for (std::size_t k = first; k < last; ++k) triangles_[count[k]++] = i;
  }
}

Polygons PlaneCuts::rings(std::size_t plane) const {
  const double z = z_mm_[plane];
  const bool at_top = z >= top_mm_;
  const auto above = [&](std::uint32_t v) {
    const double vz = mesh_.vertices[v].z;
    return at_top ? vz >= z : vz > z;
  };
  std::vector<Cut> cuts;
  for (std::uint32_t i = first_[plane]; i < first_[plane + 1]; ++i) {
    const Triangle& t = mesh_.triangles[triangles_[i]];
    const bool up[3] = {above(t[0]), above(t[1]), above(t[2])};
    if (up[0] == up[1] && up[1] == up[2]) continue;
    Cut cut{};
    for (int e = 0; e < 3; ++e) {
      const std::uint32_t a = t[std::size_t(e)], b = t[std::size_t((e + 1) % 3)];
      if (up[e] && !up[(e + 1) % 3]) {
        cut.from = edge_key(a, b);
        cut.at = edge_point(mesh_.vertices[a], mesh_.vertices[b], z);
      } else if (!up[e] && up[(e + 1) % 3]) {
        cut.to = edge_key(a, b);
      }
    }
    cuts.push_back(cut);
  }
  return chained(std::move(cuts));
}

}  // namespace cleancolor
