// model/xml.hpp
//
// XML trees for the readers of 3MF and AMF. Includes pugixml: for sources of model/ only.
#pragma once

#include <cstdint>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "model/text_scan.hpp"

namespace cleancolor {

/// A parsed document and the bytes that it points into.
class Xml {
 public:
  /// name: "globe.3mf: 3D/3dmodel.model", for messages.  Throws Error where the XML is not well-formed, or where the
  /// tree would take more than max_xml_tree_bytes.
  Xml(std::string bytes, const std::string& name);

  pugi::xml_node root() const { return document_.document_element(); }

 private:
  std::string bytes_;
  pugi::xml_document document_;
};

/// The name without its namespace prefix: "m:colorgroup" -> "colorgroup".
std::string_view local_name(const char* name);

inline bool is(pugi::xml_node node, std::string_view name) {
  return local_name(node.name()) == name;
}

/// The value of the attribute of this local name; empty where there is none.
std::string_view attribute(pugi::xml_node node, std::string_view name);

/// An attribute that is a whole number >= 0 below 2^32 - 1.
std::optional<std::uint32_t> id_attribute(pugi::xml_node node, std::string_view name);

/// "#RRGGBB" or "#RRGGBBAA" -> 0xRRGGBB.
std::optional<std::uint32_t> rgb_of(std::string_view text);

}  // namespace cleancolor
