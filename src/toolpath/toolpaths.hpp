// toolpath/toolpaths.hpp
//
// Toolpaths: from the regions of a layer to all its paths, in three steps that run in parallel over the layers.
//
//   regions[k]          ->  shells[k]   perimeters, what is left to fill, open faces   (needs layers k - 1, k + 1)
//   shells[k +- n]      ->  areas[k]    top, bottom, bridge, solid, sparse             (n: number of skin layers)
//   areas[k - 1], [k]   ->  paths[k]    perimeters and fills of every extruder
//
// Results are in the order of extruders, islands and depth; the order of printing is chosen later, in plan/.
#pragma once

#include <vector>

#include "model/config.hpp"
#include "slice/slices.hpp"
#include "toolpath/path.hpp"
#include "toolpath/skins.hpp"

namespace cleancolor {

/// How much of a region perimeters can follow, mm2 of cross-section.
struct Coverage {
  double all_mm2 = 0;
  double lost_mm2 = 0;  // islands too thin for any path
  double thin_mm2 = 0;  // islands thinner than the nozzle, printed as a single line

  Coverage& operator+=(const Coverage& other) {
    all_mm2 += other.all_mm2;
    lost_mm2 += other.lost_mm2;
    thin_mm2 += other.thin_mm2;
    return *this;
  }
};

/// One extruder in one layer.
struct ExtruderShell {
  std::vector<Path> paths;      // perimeters, thin walls, gap fill
  std::vector<Island> islands;  // of the extruder's region; Path::island counts them
  Polygons fill;
  Faces faces;
  Coverage coverage;
};

using LayerShells = std::vector<ExtruderShell>;  // [extruder]
using LayerAreas = std::vector<FillAreas>;       // [extruder]

/// How many neighbouring layers layer_areas looks at to each side.
int skin_reach(const Config& config);

LayerShells layer_shells(const Slices& slices, int layer, const Config& config);

/// shells: of all layers; only those within skin_reach of `layer` are read.
LayerAreas layer_areas(const std::vector<LayerShells>& shells, int layer, const Config& config);

/// The paths of one layer. shells.paths are moved out.
std::vector<Path> layer_paths(const Slices& slices, LayerShells& shells, const LayerAreas* below,
                              const LayerAreas& areas, int layer, const Config& config);

}  // namespace cleancolor
