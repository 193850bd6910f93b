// toolpath/skins.hpp
//
// Skins: which part of the region to fill is solid, which hangs in the air and which is sparse.
//
//   what lies above and below each layer  ->  top, bridge, solid and sparse areas of a layer
//
// A place is top where no part at all covers it, bottom where none lies below: a colour covered by another needs no
// skin unless interface_shells. Tops and bottoms are carried down and up through top_solid_layers and
// bottom_solid_layers.
#pragma once

#include <span>

#include "base/polygon.hpp"

namespace cleancolor {

/// Open faces of one extruder in one layer.
///
/// top, bottom: within the region to fill, grown by 3 mm so that their lines have something to hold on to. top_cover,
/// bottom_cover: these and the faces among the perimeters; what lies right under or over them must be solid, or slopes
/// would be left with holes between the perimeters of one layer and those of the next. Rings may overlap there.
struct Faces {
  Polygons top, bottom;
  Polygons top_cover, bottom_cover;
  bool on_bed = false;  // the bottom rests on the bed: solid, not a bridge
};

/// region: what the extruder prints; fill: what its perimeters leave; above, below: what covers and carries it.
/// line_mm: width of an outer road; faces narrower than a fifth of it are inaccuracies.
Faces faces(const Polygons& region, const Polygons& fill, const Polygons& above, const Polygons& below, bool on_bed,
            double line_mm);

struct FillAreas {
  Polygons top;     // solid, seen from above
  Polygons bottom;  // solid, on the bed
  Polygons bridge;  // solid, nothing below
  Polygons solid;   // solid, inside
  Polygons sparse;
};

struct SkinOptions {
  int top_layers = 3;
  int bottom_layers = 3;
  double solid_below_area_mm2 = 70;  // smaller sparse islands are made solid
  double solid_spacing_mm = 0.4;     // solid strips narrower than 6 lines are widened by 3
  bool all_solid = false;            // fill_density = 100 %
};

/// The areas of layer `layer`, disjoint; their union is fills[layer].
///
/// fills and all_faces are those of one extruder for layers first ... first + size - 1, which must hold all layers
/// within max(top_layers, bottom_layers) - 1 of `layer` that exist.
FillAreas fill_areas(const Polygons& fill, int layer, int first, std::span<const Faces* const> all_faces,
                     const SkinOptions& options);

}  // namespace cleancolor
