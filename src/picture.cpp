#include "picture.hpp"

#include <array>
#include <charconv>

#include "base/render.hpp"
#include "model/thumbnails.hpp"

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

}  // namespace

std::string picture(std::span<const Part> parts, const Config& config, int width_px, int height_px) {
  std::vector<Body> bodies;
  for (const Part& part : parts) bodies.push_back({part.mesh.vertices, part.mesh.triangles, colour(part, config)});
  return rendered_png(bodies, {.width_px = width_px, .height_px = height_px});
}

std::vector<Thumbnail> thumbnails(std::span<const Part> parts, const Config& config) {
  std::vector<Thumbnail> result;
  for (const auto& [width_px, height_px] : thumbnail_sizes(config.thumbnails))
    result.push_back({width_px, height_px, picture(parts, config, width_px, height_px)});
  return result;
}

}  // namespace cleancolor
