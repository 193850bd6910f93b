#include "model/threemf_vendor.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "model/limits.hpp"

namespace cleancolor {

namespace {

std::string_view metadata(pugi::xml_node node, std::string_view key) {
  for (const pugi::xml_node child : node.children("metadata"))
    if (attribute(child, "key") == key) return attribute(child, "value");
  return {};
}

/// 1-based in the file; 0 means that the object decides.
std::optional<int> extruder_of(pugi::xml_node node, const std::string& where) {
  const std::string_view text = metadata(node, "extruder");
  if (text.empty()) return std::nullopt;
  const auto extruder = number<int>(text);
  if (!extruder || *extruder < 0 || *extruder > 1000)
    throw Error(fmt::format("{}: '{}' is no extruder number; save the project again", where, shown(text)));
  return *extruder == 0 ? std::nullopt : std::optional(*extruder - 1);
}

VolumeKind kind_of(pugi::xml_node node) {
  const std::string_view subtype = attribute(node, "subtype");  // Orca, Bambu
  const std::string_view type = metadata(node, "volume_type");  // PrusaSlicer
  if (subtype == "negative_part" || type == "NegativeVolume") return VolumeKind::negative;
  const bool is_solid = (subtype.empty() || subtype == "normal_part") && (type.empty() || type == "ModelPart") &&
                        metadata(node, "modifier") != "1";
  return is_solid ? VolumeKind::solid : VolumeKind::helper;
}

VendorVolume volume_of(pugi::xml_node node, const std::string& where) {
  VendorVolume volume;
  volume.name = metadata(node, "name");
  volume.extruder = extruder_of(node, where);
  volume.kind = kind_of(node);
  return volume;
}

}  // namespace

VendorObjects read_vendor_config(const Xml& xml, const std::string& where) {
  VendorObjects objects;
  for (const pugi::xml_node node : xml.root().children("object")) {
    const auto id = id_attribute(node, "id");
    if (!id) continue;
    VendorObject object;
    object.name = metadata(node, "name");
    object.extruder = extruder_of(node, where);
    for (const pugi::xml_node child : node.children()) {
      if (!is(child, "volume") && !is(child, "part")) continue;
      VendorVolume volume = volume_of(child, where);
      if (is(child, "volume")) {
        const auto first = id_attribute(child, "firstid"), last = id_attribute(child, "lastid");
        if (!first || !last || *first > *last)
          throw Error(
              fmt::format("{}: object {}: a volume without a range of triangles; save the project again", where, *id));
        volume.first_triangle = *first;
        volume.last_triangle = *last;
        object.by_range = true;
      } else {
        volume.id = id_attribute(child, "id").value_or(0);
      }
      if (object.volumes.size() == max_parts)
        throw Error(fmt::format("{}: object {}: too many volumes; simplify the project", where, *id));
      object.volumes.push_back(std::move(volume));
    }
    objects.insert_or_assign(*id, std::move(object));
  }
  return objects;
}

}  // namespace cleancolor
