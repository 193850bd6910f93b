#include "model/xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "model/limits.hpp"

namespace cleancolor {

namespace {

/// No more than this is what pugixml's tree takes: a node for each element and each text, and the attributes.
std::size_t tree_bytes(std::string_view bytes) {
  constexpr std::size_t node_bytes = 64, attribute_bytes = 40;
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  std::size_t nodes = 0;
  for (std::size_t i = bytes.find('<'); i != std::string_view::npos; i = bytes.find('<', i + 1)) {
    if (i + 1 < bytes.size() && bytes[i + 1] != '/') ++nodes;
    std::size_t before = i;
    while (before > 0 && is_space(bytes[before - 1])) --before;
    if (before > 0 && bytes[before - 1] != '>') ++nodes;  // a text
  }
  return nodes * node_bytes + std::size_t(std::count(bytes.begin(), bytes.end(), '=')) * attribute_bytes;
}

}  // namespace

Xml::Xml(std::string bytes, const std::string& name) : bytes_(std::move(bytes)) {
  if (tree_bytes(bytes_) > max_xml_tree_bytes)
    throw Error(fmt::format("{}: too large, {} MB of XML; simplify the mesh", name, bytes_.size() / 1'000'000));
  const pugi::xml_parse_result result =
      document_.load_buffer_inplace(bytes_.data(), bytes_.size(), pugi::parse_escapes | pugi::parse_embed_pcdata);
  if (!result)
    throw Error(fmt::format("{}: byte {}: not well-formed XML ({}); export the model again", name, result.offset,
                            result.description()));
}

std::string_view local_name(const char* name) {
  const std::string_view whole = name;
  const std::size_t colon = whole.find(':');
  return colon == std::string_view::npos ? whole : whole.substr(colon + 1);
}

std::string_view attribute(pugi::xml_node node, std::string_view name) {
  for (const pugi::xml_attribute a : node.attributes())
    if (local_name(a.name()) == name) return a.value();
  return {};
}

std::optional<std::uint32_t> id_attribute(pugi::xml_node node, std::string_view name) {
  const auto id = number<std::uint32_t>(attribute(node, name));
  return id && *id != UINT32_MAX ? id : std::nullopt;
}

std::optional<std::uint32_t> rgb_of(std::string_view text) {
  if (!text.starts_with('#') || (text.size() != 7 && text.size() != 9)) return std::nullopt;
  std::uint32_t rgb = 0;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + 7, rgb, 16);
  if (error != std::errc{} || end != text.data() + 7) return std::nullopt;
  return rgb;
}

}  // namespace cleancolor
