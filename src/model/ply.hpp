// model/ply.hpp
//
// PLY: ascii, binary_little_endian and binary_big_endian.
//
//   bytes of one file  ->  one part
//
// Read are x, y, z of element vertex and the list vertex_indices (or vertex_index) of element face; faces may have any
// number of corners. All else is passed over; colours with a warning, since they are a scan's shading.
#pragma once

#include <string>
#include <string_view>

#include "base/progress.hpp"
#include "model/mesh.hpp"

namespace cleancolor {

/// name: of the file, for messages.  Throws Error.  Cost: one pass.
Part read_ply(std::string_view bytes, const std::string& name, const Progress& progress = {});

}  // namespace cleancolor
