// model/amf.hpp
//
// AMF: XML with objects, volumes and materials.
//
//   bytes of the XML  ->  one part for each volume, in mm; placed by constellations where there are any
//
// Extruders come from slic3r.extruder metadata of volume or object, colours from volume, material or object. Refused:
// colours of single triangles or vertices that differ (until they can be printed), constellations within themselves.
// Passed over with a warning: curved triangles, modifiers.
//
// Source: ISO/ASTM 52915.
#pragma once

#include <string>
#include <vector>

#include "base/progress.hpp"
#include "model/mesh.hpp"

namespace cleancolor {

/// name: of the file, for messages.  Throws Error.  Cost: dominated by parsing the XML.
std::vector<Part> read_amf(std::string bytes, const std::string& name, const Progress& progress = {});

}  // namespace cleancolor
