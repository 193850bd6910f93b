#include "model/transform.hpp"

#include <utility>

namespace cleancolor {

Transform composed(const Transform& outer, const Transform& inner) {
  return {outer.direction(inner.x_axis), outer.direction(inner.y_axis), outer.direction(inner.z_axis),
          outer.point(inner.origin_mm)};
}

Mesh transformed(Mesh mesh, const Transform& transform) {
  for (Vec3& p : mesh.vertices) p = transform.point(p);
  if (transform.determinant() < 0)
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

}  // namespace cleancolor
