#include "model/thumbnails.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "base/error.hpp"

namespace cleancolor {
namespace {

constexpr int max_side_px = 2048;

/// Takes a number of pixels from the front of the text.
std::optional<int> taken_side(std::string_view& text) {
  int pixels = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), pixels);
  if (fault != std::errc() || pixels < 1 || pixels > max_side_px) return std::nullopt;
  text.remove_prefix(std::size_t(end - text.data()));
  return pixels;
}

/// "220x124" or "220x124/PNG".
std::optional<ThumbnailSize> size_of(std::string_view text) {
  const auto width = taken_side(text);
  if (!width || !text.starts_with('x')) return std::nullopt;
  text.remove_prefix(1);
  const auto height = taken_side(text);
  if (!height || !(text.empty() || text == "/PNG")) return std::nullopt;
  return ThumbnailSize{*width, *height};
}

}  // namespace

std::vector<ThumbnailSize> thumbnail_sizes(std::string_view text) {
  std::vector<ThumbnailSize> sizes;
  if (text.empty()) return sizes;
  for (std::string_view rest = text;;) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    std::string_view item = rest.substr(0, comma);
    while (item.starts_with(' ')) item.remove_prefix(1);
    const auto size = size_of(item);
    if (!size) {
      throw Error(fmt::format("thumbnails: '{}' is not a list of sizes such as 16x16,220x124, each side 1 to {}", text,
                              max_side_px));
    }
    sizes.push_back(*size);
    if (comma == rest.size()) return sizes;
    rest.remove_prefix(comma + 1);
  }
}

}  // namespace cleancolor
