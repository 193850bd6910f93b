#include "model/mesh.hpp"

namespace cleancolor {

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
