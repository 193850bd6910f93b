// model/threemf_model.hpp
//
// One model part of a 3MF package: its objects with meshes in mm, and what is to be built.
//
//   XML of 3D/3dmodel.model  ->  ModelPart
//
// Source: 3MF core specification 1.3; production extension 1.1 (p:path).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "model/mesh.hpp"
#include "model/threemf_colours.hpp"
#include "model/transform.hpp"
#include "model/xml.hpp"

namespace cleancolor {

/// A component of an object, or an item of the build.
struct Placed {
  std::string path;  // of the model part that holds the object; empty: this one
  std::uint32_t object = 0;
  Transform transform;
  bool printable = true;
};

struct MeshObject {
  std::string name;
  bool is_model = true;  // not a support or a mere surface
  Mesh mesh;             // empty where there are components
  std::optional<Colour> colour;
  std::string refusal;  // why this object cannot be printed; empty: it can
  bool textured = false;
  std::vector<Placed> components;
};

struct ModelPart {
  std::map<std::uint32_t, MeshObject> objects;
  std::vector<Placed> build;
};

/// where: "globe.3mf: 3D/3dmodel.model", for messages.  Throws Error.
ModelPart read_model_part(const Xml& xml, const std::string& where, const Progress& progress);

}  // namespace cleancolor
