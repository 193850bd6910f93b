// model/obj.hpp
//
// Wavefront OBJ: v, f, usemtl and the diffuse colours of the material library.
//
//   bytes of one file  ->  one part, or one part for each material
//
// Faces may have any number of corners, indices may be negative (counted from the last vertex), texture and normal
// indices are skipped. A surface that changes its material from face to face is a painted surface and refused;
// materials whose faces share no vertex are bodies of their own. Lines of no interest (groups, curves, normals) are
// passed over.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.hpp"
#include "model/mesh.hpp"

namespace cleancolor {

using MaterialColours = std::map<std::string, std::uint32_t, std::less<>>;  // name -> 0xRRGGBB

/// File names in the mtllib lines, in order.
std::vector<std::string> material_libraries(std::string_view obj_bytes);

/// Diffuse colours (Kd) of a material library. Malformed lines are passed over: colours are no reason to refuse a mesh.
MaterialColours read_mtl(std::string_view bytes);

/// name: of the file, for messages.  Throws Error.  Cost: one pass.
std::vector<Part> read_obj(std::string_view bytes, const std::string& name, const MaterialColours& colours = {});

}  // namespace cleancolor
