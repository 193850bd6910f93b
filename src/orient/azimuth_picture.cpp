#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/draw.hpp"
#include "orient/azimuth.hpp"

namespace cleancolor {
namespace {

constexpr double radius = 100;  // of the largest value; the picture's unit is as good as any
constexpr double text_height = 6;
constexpr Colour ink = colour(0x222222), grid = colour(0xD0D4DA), no_room = colour(0xECEEF1);
constexpr Colour exposure_colour = colour(0xD55E00), interference_colour = colour(0x0072B2);

Vec2 at(double degrees, double r) {
  const double angle = degrees * std::numbers::pi / 180;
  return {r * std::cos(angle), r * std::sin(angle)};
}

void compass(Canvas& canvas, const Azimuths& azimuths) {
  for (std::size_t a = 0; a < azimuths.fits.size(); ++a) {
    if (azimuths.fits[a]) continue;
    const std::vector<std::vector<Vec2>> wedge{{{0, 0}, at(double(a) - 0.5, radius), at(double(a) + 0.5, radius)}};
    canvas.fill(wedge, no_room);
  }
  for (const double share : {0.25, 0.5, 0.75, 1.}) {
    std::vector<Vec2> ring;
    for (int a = 0; a < 360; a += 3) ring.push_back(at(a, share * radius));
    canvas.line(ring, 0.4, grid, true);
  }
  for (int a = 0; a < 360; a += 30) {
    canvas.line(std::vector<Vec2>{{0, 0}, at(a, radius)}, 0.4, grid);
    const std::string text = fmt::format("{}\u00B0", a);
    const double width = 0.55 * text_height * double(text.size() - 1);
    canvas.text(at(a, radius + 9) - Vec2{width / 2, text_height / 3}, text_height, text, ink);
  }
}

/// The disc of the choice lies on the curve; that of the second is smaller, so that both are seen.
void curve(Canvas& canvas, const std::vector<double>& values, const std::optional<int>& best, double size_mm,
           Colour colour) {
  const double largest = std::max(std::ranges::max(values), 1e-9);
  std::vector<Vec2> points;
  for (std::size_t a = 0; a < values.size(); ++a) points.push_back(at(double(a), radius * values[a] / largest));
  canvas.line(points, 1.2, colour, true);
  if (!best) return;
  const Vec2 mark = at(*best, radius * at_azimuth(values, *best) / largest);
  canvas.line(std::vector<Vec2>{{0, 0}, at(*best, radius)}, 0.4, colour);
  canvas.disc(mark, size_mm, colour);
}

void legend(Canvas& canvas, double y, std::string_view name, std::string_view unit, const std::vector<double>& values,
            const std::optional<int>& best, Colour colour) {
  const double left = -radius - 20;
  canvas.line(std::vector<Vec2>{{left, y + 2}, {left + 12, y + 2}}, 1.2, colour);
  std::string text =
      fmt::format("{}: outer ring {:.1f} {}, not turned {:.1f}", name, std::ranges::max(values), unit, values[0]);
  if (best) text += fmt::format(", at {}\u00B0 {:.1f}", *best, at_azimuth(values, *best));
  canvas.text({left + 16, y}, text_height, text, ink);
}

void legend_of_grey(Canvas& canvas, double y) {
  const double left = -radius - 20;
  canvas.fill(std::vector<std::vector<Vec2>>{{{left, y}, {left + 12, y}, {left + 12, y + 4}, {left, y + 4}}}, no_room);
  canvas.text({left + 16, y}, text_height, "no room on the bed", ink);
}

}  // namespace

std::string azimuth_svg(const Azimuths& azimuths) {
  Canvas canvas({{-radius - 25, -radius - 60}, {radius + 65, radius + 20}}, 3);
  compass(canvas, azimuths);
  curve(canvas, azimuths.interference_mm3, azimuths.least_interference_deg, 3.5, interference_colour);
  curve(canvas, azimuths.exposure_s, azimuths.chosen_deg(), 2.2, exposure_colour);
  legend(canvas, -radius - 28, "exposure", "s", azimuths.exposure_s, azimuths.chosen_deg(), exposure_colour);
  legend(canvas, -radius - 38, "interference", "mm3", azimuths.interference_mm3, azimuths.least_interference_deg,
         interference_colour);
  if (std::ranges::find(azimuths.fits, 0) != azimuths.fits.end()) legend_of_grey(canvas, -radius - 48);
  return canvas.svg();
}

}  // namespace cleancolor
