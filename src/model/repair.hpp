// model/repair.hpp
//
// The single steps of model/check.hpp, each a mesh in and a mesh with fewer faults out. `changed`: how much was mended.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/check.hpp"
#include "model/edges.hpp"
#include "model/mesh.hpp"

namespace cleancolor {

struct Repaired {
  Mesh mesh;
  std::size_t changed = 0;
};

/// Equal vertices made one; changed: triangles dropped because two of their corners are one.
Repaired exactly_welded(Mesh mesh);

/// The ends of edges that are not closed, moved together where they are within tolerance_mm; changed: vertices moved.
Repaired nearly_welded(Mesh mesh, std::span<const EdgeUse> uses, double tolerance_mm);

/// Triangles that repeat another one, corner for corner, dropped; changed: how many.
Repaired without_duplicates(Mesh mesh, std::span<const EdgeUse> uses);

/// Neighbours turned alike, in each connected surface as few triangles as possible; changed: triangles turned.
/// Nothing where a surface has one side only, like a Moebius strip.
std::optional<Repaired> consistently_wound(Mesh mesh, std::span<const EdgeUse> uses);

struct ClosedHoles {
  Mesh mesh;
  std::size_t holes = 0;      // closed
  std::size_t triangles = 0;  // added
  double largest_mm = 0;      // size of the largest hole closed
  std::size_t open = 0;       // holes that are too large and not flat
  double largest_open_mm = 0;
  Vec3 where_open_mm;  // a point on the rim of one
};

ClosedHoles without_holes(Mesh mesh, std::span<const EdgeUse> uses, const CheckLimits& limits);

}  // namespace cleancolor
