// audit/picture_parts.hpp
//
// What pictures are put together from: colours, dashes, clipping, round numbers. Here a unit is a pixel, Y up.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "base/draw.hpp"
#include "base/vec.hpp"

namespace cleancolor {

inline constexpr Colour ink = {0.13, 0.14, 0.16, 1};       // of texts
inline constexpr Colour pale_ink = {0.42, 0.44, 0.48, 1};  // of what explains
inline constexpr Colour grid_ink = {0.88, 0.89, 0.91, 1};  // of what must not catch the eye

/// share 0: a, 1: b; alpha is a's.
Colour mixed(Colour a, Colour b, double share);

/// How light an eye sees it, in [0, 1].
double lightness(Colour c);

/// The same hue, dark enough for a thin line on white.
Colour readable_on_white(Colour c);

/// About how wide Canvas::text draws it; fonts differ.
double text_width(std::string_view utf8, double height);

/// The part of a -> b inside the box.
std::optional<std::pair<Vec2, Vec2>> clipped(Vec2 a, Vec2 b, const Box<Vec2>& box);

/// A way cut into what lies inside the box.
std::vector<std::vector<Vec2>> clipped(std::span<const Vec2> way, const Box<Vec2>& box);

struct Dash {
  double on = 5, off = 4;
};
void draw_dashed(Canvas& canvas, std::span<const Vec2> way, double width, Colour colour, Dash dash = {});

/// The largest of 1, 2, 5, 10, 20 ... that is not more.  Requires: most > 0.
double round_number(double most);

}  // namespace cleancolor
