// model/threemf.hpp
//
// 3MF: a zip package of XML model parts.
//
//   bytes of one file  ->  one part for each mesh that is built, in the order of the build, placed and in mm
//
// Relations lead to the start part; components may nest and lie in other model parts (production extension). Extruders
// come from PrusaSlicer's and Orca/Bambu's config files, colours from base materials and colour groups. Refused:
// painted objects and objects whose triangles name more than one colour (until they can be printed), unknown required
// extensions, negative volumes, cycles, anything that does not fit together. Passed over with a warning: supports,
// modifiers, textures, items not to be printed.
//
// Source: 3MF core specification 1.3, materials extension 1.2, production extension 1.1; files of PrusaSlicer 2.5 and
// Bambu Studio 1.5 to 2.5.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/progress.hpp"
#include "model/mesh.hpp"

namespace cleancolor {

class Archive;

/// name: of the file, for messages.  Throws Error.  Cost: dominated by unpacking and parsing the XML.
std::vector<Part> read_3mf(Archive& archive, const std::string& name, const Progress& progress = {});

}  // namespace cleancolor
