// model/transform.hpp
//
// Transform: where a mesh of a file goes, as an affine map.
#pragma once

#include <array>

#include "model/mesh.hpp"

namespace cleancolor {

/// p -> x_axis * p.x + y_axis * p.y + z_axis * p.z + origin. The axes are the rows of a 3MF matrix, in its order.
struct Transform {
  Vec3 x_axis{1, 0, 0};
  Vec3 y_axis{0, 1, 0};
  Vec3 z_axis{0, 0, 1};
  Vec3 origin_mm;

  Vec3 direction(const Vec3& p) const { return x_axis * p.x + y_axis * p.y + z_axis * p.z; }
  Vec3 point(const Vec3& p) const { return direction(p) + origin_mm; }
  double determinant() const { return dot(x_axis, cross(y_axis, z_axis)); }
};

/// inner first, then outer.
Transform composed(const Transform& outer, const Transform& inner);

/// The mesh moved; a mirroring map turns the triangles round, so that outside stays outside.
Mesh transformed(Mesh mesh, const Transform& transform);

}  // namespace cleancolor
