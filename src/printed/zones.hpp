// printed/zones.hpp
//
// Zones: connected pieces of the nozzles' regions in a layer, and which of them a path belongs to.
//
//   regions of each nozzle  ->  zones;  path  ->  zone
#pragma once

#include <vector>

#include "base/polygon.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

/// A connected piece of one nozzle's region.
struct Zone {
  int nozzle = 0;
  Polygons region;
  Box<Vec2> box;
};

/// By nozzle, then in the order of its outlines.
std::vector<Zone> zones_of(const std::vector<Polygons>& regions);

/// The zone of the path's nozzle in which most of some places of the path lie; -1: none, or auxiliary plastic.
int zone_of(const Path& path, const std::vector<Zone>& zones);

}  // namespace cleancolor
