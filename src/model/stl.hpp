// model/stl.hpp
//
// STL, binary and ASCII.
//
//   bytes of one file  ->  one part
//
// Solids of one ASCII file become one mesh, since a file is what a person gives an extruder. Vertices at the same place
// are one vertex; normals and attribute bytes are not looked at, the order of the corners decides. Refused: numbers
// that are not finite, a count that does not fit the length, no triangles, more than 5 million triangles.
#pragma once

#include <string>
#include <string_view>

#include "base/progress.hpp"
#include "model/mesh.hpp"

namespace cleancolor {

/// Whether the bytes are a binary STL by their length alone: 84 + 50 x count.
bool is_binary_stl(std::string_view bytes);

/// name: of the file, for messages.  Throws Error.  Cost: one pass.
Part read_stl(std::string_view bytes, const std::string& name, const Progress& progress = {});

}  // namespace cleancolor
