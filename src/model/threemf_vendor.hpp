// model/threemf_vendor.hpp
//
// Which extruder prints what, as PrusaSlicer and Orca/Bambu Studio write it beside the meshes of a 3MF package.
//
//   Metadata/Slic3r_PE_model.config, Metadata/model_settings.config  ->  per object: name, extruder, volumes or parts
//
// PrusaSlicer cuts one mesh into volumes by ranges of triangles; Orca and Bambu make each volume a component. Extruders
// are 1-based in both files, 0 or absent: that of the object; they are 0-based here.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/xml.hpp"

namespace cleancolor {

/// What a volume is there for. Only solids are printed as they are.
enum class VolumeKind { solid, negative, helper };

struct VendorVolume {
  std::string name;
  std::optional<int> extruder;  // 0-based
  VolumeKind kind = VolumeKind::solid;
  std::uint32_t first_triangle = 0;  // PrusaSlicer: the range, last included
  std::uint32_t last_triangle = 0;
  std::uint32_t id = 0;  // Orca and Bambu: the object that the component refers to; several may share it
};

struct VendorObject {
  std::string name;
  std::optional<int> extruder;  // 0-based
  std::vector<VendorVolume> volumes;
  bool by_range = false;  // volumes are ranges of triangles
};

using VendorObjects = std::map<std::uint32_t, VendorObject>;  // by object id in the root model part

/// Either file; where: for messages.  Throws Error where a number cannot be read.
VendorObjects read_vendor_config(const Xml& xml, const std::string& where);

}  // namespace cleancolor
