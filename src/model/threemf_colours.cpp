#include "model/threemf_colours.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace cleancolor {

bool ColourGroups::is_group(pugi::xml_node node) {
  for (const char* name :
       {"basematerials", "colorgroup", "texture2dgroup", "compositematerials", "multiproperties", "material", "color"})
    if (is(node, name)) return true;
  return false;
}

void ColourGroups::add(pugi::xml_node node, const std::string& where) {
  const auto id = id_attribute(node, "id");
  if (!id) throw Error(fmt::format("{}: a {} without id; export the model again", where, node.name()));
  if (is(node, "color")) {
    legacy_rgb_[*id] = rgb_of(attribute(node, "value")).value_or(0xFFFFFF);
    return;
  }
  Group group;
  if (is(node, "basematerials") || is(node, "colorgroup")) {
    for (const pugi::xml_node child : node.children()) {
      Colour colour{rgb_of(attribute(child, is(child, "base") ? "displaycolor" : "color")), {}};
      if (!colour.rgb) colour.material = attribute(child, "name");
      if (is(child, "base") || is(child, "color")) group.colours.push_back(std::move(colour));
    }
  } else if (is(node, "material")) {
    const auto rgb = legacy_rgb_.find(id_attribute(node, "colorid").value_or(UINT32_MAX));
    group.colours.push_back(rgb != legacy_rgb_.end() ? Colour{rgb->second, {}} : Colour{{}, fmt::format("{}", *id)});
  } else {
    group.kind = is(node, "texture2dgroup") ? Group::Kind::texture : Group::Kind::mixture;
  }
  if (!groups_.emplace(*id, std::move(group)).second)
    throw Error(fmt::format("{}: two resources have the id {}; export the model again", where, *id));
}

const ColourGroups::Group* ColourGroups::find(std::uint32_t id) const {
  const auto found = groups_.find(id);
  return found == groups_.end() ? nullptr : &found->second;
}

void SurfaceColours::use(std::uint32_t group_id, std::uint32_t index) {
  if (last_ == std::pair{group_id, index}) return;
  last_ = {group_id, index};
  const ColourGroups::Group* group = groups_.find(group_id);
  if (group == nullptr)
    throw Error(fmt::format("{}: colour group {} does not exist; export the model again", where_, group_id));
  if (group->kind == ColourGroups::Group::Kind::texture) {
    textured_ = true;
    return;
  }
  if (group->kind == ColourGroups::Group::Kind::mixture)
    throw Error(fmt::format("{}: mixed materials cannot be printed; give each body one colour", where_));
  if (index >= group->colours.size())
    throw Error(fmt::format("{}: colour {} of group {} does not exist; it has {}; export the model again", where_,
                            index, group_id, group->colours.size()));
  const Colour& colour = group->colours[index];
  if (!first_)
    first_ = colour;
  else if (!(*first_ == colour))
    several_ = true;
}

}  // namespace cleancolor
