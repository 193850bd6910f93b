#include "picture.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>

#include "base/error.hpp"
#include "base/render.hpp"

namespace cleancolor {
namespace {

// Far apart in hue and lightness, for filaments whose colour nobody has said.
constexpr std::array<std::uint32_t, 6> palette = {0x3B7DD8, 0xF2A93B, 0x4CAF50, 0xD64545, 0x9C5BB5, 0x8D8D8D};

std::uint32_t colour(const Part& part, const Config& config) {
  const auto extruder = std::size_t(*part.extruder);
  for (const std::string& text :
       {config.extruders[extruder].filament_colour, config.extruders[extruder].extruder_colour}) {
    std::uint32_t rgb = 0;
    if (text.size() == 7 && text[0] == '#' &&
        std::from_chars(text.data() + 1, text.data() + 7, rgb, 16).ptr == text.data() + 7)
      return rgb;
  }
  return part.rgb.value_or(palette[extruder % palette.size()]);
}

/// "220x124" -> 220, 124.
std::pair<int, int> size_px(std::string_view text) {
  int width = 0, height = 0;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, width);
  if (first.ptr != end && *first.ptr == 'x') {
    // PrusaSlicer 2.7 and later append the format: 220x124/PNG. Only PNG is written.
    const auto second = std::from_chars(first.ptr + 1, end, height);
    const std::string_view rest(second.ptr, std::size_t(end - second.ptr));
    if ((rest.empty() || rest == "/PNG") && width >= 1 && height >= 1 && width <= 2048 && height <= 2048)
      return {width, height};
  }
  throw Error(fmt::format("thumbnails: '{}' is not a size such as 220x124 (each side 1 to 2048)", text));
}

}  // namespace

std::string picture(std::span<const Part> parts, const Config& config, int width_px, int height_px) {
  std::vector<Body> bodies;
  for (const Part& part : parts) bodies.push_back({part.mesh.vertices, part.mesh.triangles, colour(part, config)});
  return rendered_png(bodies, {.width_px = width_px, .height_px = height_px});
}

std::vector<Thumbnail> thumbnails(std::span<const Part> parts, const Config& config) {
  std::vector<Thumbnail> result;
  std::string_view list = config.thumbnails;
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    std::string_view item = list.substr(0, comma);
    while (item.starts_with(' ')) item.remove_prefix(1);
    list.remove_prefix(std::min(comma + 1, list.size()));
    const auto [width, height] = size_px(item);
    result.push_back({width, height, picture(parts, config, width, height)});
  }
  return result;
}

}  // namespace cleancolor
