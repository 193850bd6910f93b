// model/threemf_colours.hpp
//
// The colour and material groups of a 3MF model part, and which of them a surface uses.
//
// Source: 3MF core specification 1.3, section 5 (basematerials); materials and properties extension 1.2 (colorgroup,
// texture2dgroup, compositematerials, multiproperties); the materials of drafts before 1.0.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/xml.hpp"

namespace cleancolor {

/// What a material looks like, or is called where it has no colour.
struct Colour {
  std::optional<std::uint32_t> rgb;
  std::string material;

  friend bool operator==(const Colour&, const Colour&) = default;
};

class ColourGroups {
 public:
  /// Whether the element is a group of colours or materials.
  static bool is_group(pugi::xml_node node);

  /// where: for messages.  Throws Error where a group has no id or an id that is taken.
  void add(pugi::xml_node group, const std::string& where);

  struct Group {
    enum class Kind { colours, texture, mixture } kind = Kind::colours;
    std::vector<Colour> colours;
  };

  const Group* find(std::uint32_t id) const;
  bool has(std::uint32_t id) const { return groups_.contains(id); }

 private:
  std::map<std::uint32_t, Group> groups_;
  std::map<std::uint32_t, std::uint32_t> legacy_rgb_;  // <color> of drafts before 1.0
};

/// Collects the colours that a surface names. Most triangles name what the one before named, which costs a comparison.
class SurfaceColours {
 public:
  SurfaceColours(const ColourGroups& groups, std::string where) : groups_(groups), where_(std::move(where)) {}

  /// Throws Error where group or index do not exist.
  void use(std::uint32_t group, std::uint32_t index);

  const std::optional<Colour>& first() const { return first_; }
  bool several() const { return several_; }
  bool textured() const { return textured_; }

 private:
  const ColourGroups& groups_;
  std::string where_;
  std::optional<std::pair<std::uint32_t, std::uint32_t>> last_;
  std::optional<Colour> first_;
  bool several_ = false;
  bool textured_ = false;
};

}  // namespace cleancolor
