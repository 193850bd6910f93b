// model/check.hpp
//
// A mesh made printable, or refused.
//
//   triangles as a file has them  ->  watertight, outward, finite, with volume
//
// Afterwards every edge is passed as often one way as the other, so every slice consists of closed contours; shells
// have positive volume, cavities (which lie inside another shell) may have negative. Mended, each with one warning that
// says what and how much: vertices that should be one, triangles without corners or present twice, triangles turned the
// wrong way, shells inside out, small or flat holes. Accepted with a warning: edges of four or more triangles, shells
// that touch in a vertex, shells that overlap (the slicer unites them). Refused: everything else.
#pragma once

#include <string>

#include "base/progress.hpp"
#include "model/mesh.hpp"

namespace cleancolor {

/// Ways to mend a mesh; defaults are safe.
struct CheckLimits {
  double farthest_mm = 1e7;         // vertices farther away than this are refused
  double weld_mm = 1e-4;            // open edges this near to each other are joined
  double small_hole_mm = 2;         // holes up to this size are closed whatever their shape
  double flat_hole_share = 0.01;    // larger ones where they are flat within this share of their size
  std::size_t hole_edges = 10'000;  // and have no more edges than this
};

/// name: of the part, for messages.  Throws Error where the mesh cannot be made printable.
/// Cost: about linear; 0.1 s for 400 000 sound triangles.
Mesh checked(Mesh mesh, const std::string& name, const Progress& progress = {}, const CheckLimits& limits = {});

}  // namespace cleancolor
