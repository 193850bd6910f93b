// model/shells.hpp
//
// Shells: the connected closed surfaces of a mesh, and which way they face.
#pragma once

#include <span>
#include <vector>

#include "model/edges.hpp"
#include "model/mesh.hpp"

namespace cleancolor {

struct Shells {
  std::vector<std::uint32_t> of_triangle;             // index of the shell of each triangle
  std::vector<std::vector<std::uint32_t>> triangles;  // of each shell, ascending
};

/// Triangles that share an edge are of one shell; shells are numbered by their first triangle.
Shells shells(const Mesh& mesh, std::span<const EdgeUse> uses);

/// How often the shell winds round the point: 1 inside, 0 outside, -1 inside a shell that faces inward.
/// Source: van Oosterom and Strackee, The solid angle of a plane triangle, 1983.  Cost: one pass over the shell.
double winding(const Mesh& mesh, std::span<const std::uint32_t> shell, Vec3 point);

struct Outward {
  Mesh mesh;
  std::size_t turned = 0;       // shells
  std::size_t overlapping = 0;  // shells that reach into another one
  std::size_t touching = 0;     // vertices where shells touch
  bool tested_all = true;       // false: so many nested shells that the test was given up
};

/// Shells that lie in no other one are turned to face outward, together with all that lies inside them.
///
/// A shell that faces inward is a cavity where it lies inside another one. Overlaps are looked for by samples: a small
/// one may go unnoticed, which costs a warning only.
Outward facing_outward(Mesh mesh, std::span<const EdgeUse> uses);

}  // namespace cleancolor
