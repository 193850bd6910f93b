// model/edges.hpp
//
// The edges of a mesh and the triangles that meet in them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/mesh.hpp"

namespace cleancolor {

/// One side of a triangle. half_edge 3 t + k goes from corner k of triangle t to corner (k + 1) % 3.
struct EdgeUse {
  std::uint32_t low = 0;   // the end with the smaller index
  std::uint32_t high = 0;  // the other
  std::uint32_t half_edge = 0;
  bool up = false;  // runs from low to high
};

/// All sides of all triangles, those of one edge next to each other: sorted by low, high, half_edge.
///
/// Requires: no triangle uses a vertex twice.  Cost: linear but for the sorting round each vertex.
std::vector<EdgeUse> edge_uses(const Mesh& mesh);

/// How many sides of the edge that begins at uses[from].
std::size_t edge_size(std::span<const EdgeUse> uses, std::size_t from);

/// Sides that run up minus sides that run down; 0 where the surface is closed at this edge.
int edge_balance(std::span<const EdgeUse> edge);

}  // namespace cleancolor
