#include "model/mesh.hpp"

#include <algorithm>

namespace cleancolor {

Mesh submesh(const std::vector<Vec3>& vertices, std::span<const Triangle> triangles) {
  std::vector<std::uint32_t> used;
  used.reserve(triangles.size() * 3);
  for (const Triangle& t : triangles) used.insert(used.end(), t.begin(), t.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());

  Mesh mesh;
  mesh.vertices.reserve(used.size());
  for (const std::uint32_t i : used) mesh.vertices.push_back(vertices[i]);
  mesh.triangles.assign(triangles.begin(), triangles.end());
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& i : t) i = std::uint32_t(std::lower_bound(used.begin(), used.end(), i) - used.begin());
  return mesh;
}

Box<Vec3> bounds(const Mesh& mesh) {
  Box<Vec3> box;
  for (const Vec3& v : mesh.vertices) box.add(v);
  return box;
}

double volume_mm3(const Mesh& mesh) {
  // Signed tetrahedra to a point of the mesh: less cancellation than to a far origin.
  if (mesh.vertices.empty()) return 0;
  const Vec3 o = mesh.vertices.front();
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += dot(mesh.vertices[a] - o, cross(mesh.vertices[b] - o, mesh.vertices[c] - o));
  return sum / 6;
}

}  // namespace cleancolor
