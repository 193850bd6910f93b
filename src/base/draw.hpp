// base/draw.hpp
//
// Canvas: draws the same picture to PNG and to SVG, in mm, Y up. For tests, reports and documentation.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.hpp"

namespace cleancolor {

struct Colour {
  double r = 0, g = 0, b = 0, a = 1;  // each in [0, 1], not premultiplied
};

/// 0xRRGGBB.
constexpr Colour colour(std::uint32_t rgb, double alpha = 1) {
  return {double(rgb >> 16 & 255) / 255, double(rgb >> 8 & 255) / 255, double(rgb & 255) / 255, alpha};
}

class Canvas {
 public:
  /// Shows view_mm; white.  Requires: view_mm not empty; pixels_per_mm > 0; at most 32000 pixels a side.
  Canvas(Box<Vec2> view_mm, double pixels_per_mm);
  ~Canvas();
  Canvas(Canvas&&) noexcept;
  Canvas& operator=(Canvas&&) noexcept;

  /// The region that rings bound by the non-zero rule.
  void fill(std::span<const std::vector<Vec2>> rings_mm, Colour colour);

  /// A line with round ends and joins.
  void line(std::span<const Vec2> points_mm, double width_mm, Colour colour, bool closed = false);

  void disc(Vec2 center_mm, double radius_mm, Colour colour);

  /// Upright text; at_mm is the left end of its base line.
  void text(Vec2 at_mm, double height_mm, std::string_view utf8, Colour colour);

  std::string png() const;  // the bytes of a file
  std::string svg() const;

 private:
  struct Picture;
  std::unique_ptr<Picture> picture_;
};

/// The bytes of a PNG file. rgba: rows from the top, 4 bytes a pixel, not premultiplied.
/// Requires: rgba.size() == 4 * width * height.
std::string png(int width, int height, std::span<const std::uint8_t> rgba);

}  // namespace cleancolor
