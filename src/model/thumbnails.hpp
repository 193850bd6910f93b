// model/thumbnails.hpp
//
// The option thumbnails: "16x16, 220x124/PNG" -> sizes of pictures.
#pragma once

#include <string_view>
#include <vector>

namespace cleancolor {

struct ThumbnailSize {
  int width_px = 0;  // 1 to 2048, as is the height
  int height_px = 0;
};

/// The sizes in their order; none for an empty text. Newer PrusaSlicers append the format: only PNG is known.
/// Throws Error for anything else.
std::vector<ThumbnailSize> thumbnail_sizes(std::string_view text);

}  // namespace cleancolor
