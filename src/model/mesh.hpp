// model/mesh.hpp
//
// Mesh: triangles over shared vertices, in mm. Part: a mesh, and which extruder prints it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/vec.hpp"

namespace cleancolor {

using Triangle = std::array<std::uint32_t, 3>;

/// Corners counterclockwise seen from outside; every index < vertices.size(). Watertight only after model/check.hpp.
struct Mesh {
  std::vector<Vec3> vertices;  // mm
  std::vector<Triangle> triangles;
};

struct Part {
  std::string name;  // "globe.3mf: ocean", for messages
  Mesh mesh;
  std::optional<int> extruder;       // 0-based, where the file or the command line says
  std::optional<std::uint32_t> rgb;  // 0xRRGGBB, where the file says
  std::string material;              // where the file names a material without a colour; equal names, equal material
};

/// These triangles with only the vertices that they use, in the vertices' order.  Cost: n log n in the triangles.
Mesh submesh(const std::vector<Vec3>& vertices, std::span<const Triangle> triangles);

Box<Vec3> bounds(const Mesh& mesh);

/// Signed volume, mm3; positive where the triangles face outward.  Cost: one pass.
double volume_mm3(const Mesh& mesh);

}  // namespace cleancolor
