// slice/slices.hpp
//
// Slices: what each extruder prints in each layer, as polygons.
//
//   parts (meshes with extruders), layer heights  ->  regions[layer][extruder]
//
// A layer is cut at its middle. Contours follow the mesh exactly, on the 1 nm grid, and are then thinned out so that no
// dropped point lies farther than resolution_mm from what stays. Where two parts share a face both keep the same
// points, so that they still touch without a gap afterwards.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/packed_polygons.hpp"
#include "base/progress.hpp"
#include "model/config.hpp"
#include "model/mesh.hpp"

namespace cleancolor {

/// One layer of plastic: from print_z - height up to print_z, cut at its middle.
struct Slab {
  double print_z_mm = 0;
  double height_mm = 0;
  double slice_z_mm() const { return print_z_mm - height_mm / 2; }
};

/// The layers of an object that reaches from 0 to top_mm: all whose middle is below the top.
std::vector<Slab> slabs(double top_mm, double first_layer_height_mm, double layer_height_mm);

/// Cross-section of a watertight mesh at z_mm, as rings with the inside on their left, not simplified.
///
/// A plane exactly through corners is taken just above them, at the mesh's top just below: a cube cut at its bottom and
/// at its top gives its full square.  Cost: one pass over the mesh; for many planes use slices().
Polygons cross_section(const Mesh& mesh, double z_mm);

struct Slices {
  std::vector<Slab> slabs;
  std::vector<std::vector<PackedPolygons>> regions;  // [layer][extruder], disjoint within a layer
  std::vector<PackedPolygons> outlines;              // [layer], all extruders together
};

/// What is done where parts of different extruders claim the same place.
enum class Overlap { refuse, first, last };

struct SliceOptions {
  int extruders = 1;
  double first_layer_height_mm = 0.3;
  double layer_height_mm = 0.3;
  double resolution_mm = 0.02;
  double closing_radius_mm = 0.049;         // cracks up to twice this wide are closed
  double xy_size_compensation_mm = 0;       // > 0 grows; not across a border between two extruders
  double elefant_foot_compensation_mm = 0;  // the first layer shrinks by this, not across such a border
  Overlap overlap = Overlap::refuse;        // where parts of different extruders overlap by more than 0.05 mm
  int threads = 1;
};

/// Cuts all parts. Overlaps below 0.05 mm go to the lower extruder, with a warning; so does, warned of as well, what
/// begins in mid-air.
///
/// Throws Error where parts overlap by more and the rule is refuse, and where nothing reaches the first layer's middle.
/// Requires: checked meshes (model/check.hpp), standing on z = 0; every part has an extruder < options.extruders.
/// Cost: triangles x layers that each crosses, then about 1 ms a layer for the polygons.
Slices slices(std::span<const Part> parts, const SliceOptions& options, const Progress& progress = {});

}  // namespace cleancolor
