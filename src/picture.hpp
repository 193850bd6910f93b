// picture.hpp
//
// Pictures of the coloured parts: the preview and the thumbnails in the G-code.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "gcode/writer.hpp"
#include "model/config.hpp"
#include "model/mesh.hpp"

namespace cleancolor {

/// PNG of all parts in the colours of their filaments: filament_colour, else extruder_colour, else the file's colour,
/// else one of a fixed list.
std::string picture(std::span<const Part> parts, const Config& config, int width_px, int height_px);

/// One for each size in config.thumbnails ("16x16,220x124"); throws Error where the list cannot be read.
std::vector<Thumbnail> thumbnails(std::span<const Part> parts, const Config& config);

}  // namespace cleancolor
