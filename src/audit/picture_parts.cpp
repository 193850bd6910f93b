#include "audit/picture_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cleancolor {

Colour mixed(Colour a, Colour b, double share) {
  const auto mix = [&](double x, double y) { return x + (y - x) * share; };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b), a.a};
}

double lightness(Colour c) {
  return 0.299 * c.r + 0.587 * c.g + 0.114 * c.b;
}

Colour readable_on_white(Colour c) {
  constexpr double lightest = 0.45;
  const double l = lightness(c);
  return l <= lightest ? c : mixed(c, {0, 0, 0, 1}, 1 - lightest / l);
}

double text_width(std::string_view utf8, double height) {
  const auto letters = std::ranges::count_if(utf8, [](char c) { return (c & 0xC0) != 0x80; });
  return 0.53 * height * double(letters);
}

// Liang and Barsky: the share of the way that is inside, border by border.
std::optional<std::pair<Vec2, Vec2>> clipped(Vec2 a, Vec2 b, const Box<Vec2>& box) {
  double begin = 0, end = 1;
  const Vec2 d = b - a;
  const std::array<std::pair<double, double>, 4> borders = {
      {{-d.x, a.x - box.min.x}, {d.x, box.max.x - a.x}, {-d.y, a.y - box.min.y}, {d.y, box.max.y - a.y}}};
  for (const auto& [towards, room] : borders) {
    if (towards == 0 && room < 0) return std::nullopt;
    if (towards < 0) begin = std::max(begin, room / towards);
    if (towards > 0) end = std::min(end, room / towards);
  }
  if (begin > end) return std::nullopt;
  return std::pair{begin > 0 ? lerp(a, b, begin) : a, end < 1 ? lerp(a, b, end) : b};
}

std::vector<std::vector<Vec2>> clipped(std::span<const Vec2> way, const Box<Vec2>& box) {
  std::vector<std::vector<Vec2>> pieces;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const auto inside = clipped(way[i - 1], way[i], box);
    if (!inside) continue;
    if (pieces.empty() || pieces.back().back() != inside->first) pieces.push_back({inside->first});
    pieces.back().push_back(inside->second);
  }
  return pieces;
}

void draw_dashed(Canvas& canvas, std::span<const Vec2> way, double width, Colour colour, Dash dash) {
  std::vector<Vec2> stroke;
  double left = dash.on;  // of the dash, or of the gap
  bool is_on = true;
  const auto finish = [&] {
    if (stroke.size() > 1) canvas.line(stroke, width, colour);
    stroke.clear();
  };
  for (std::size_t i = 1; i < way.size(); ++i) {
    const double whole = distance(way[i - 1], way[i]);
    if (is_on && stroke.empty()) stroke.push_back(way[i - 1]);
    for (double done = 0; done < whole;) {
      const double step = std::min(left, whole - done);
      done += step;
      left -= step;
      const Vec2 at = lerp(way[i - 1], way[i], done / whole);
      if (is_on) stroke.push_back(at);
      if (left > 0) continue;
      if (is_on) finish();
      is_on = !is_on;
      left = is_on ? dash.on : dash.off;
      if (is_on) stroke.push_back(at);
    }
  }
  finish();
}

double round_number(double most) {
  const double power = std::pow(10, std::floor(std::log10(most)));
  for (const double digit : {5., 2.})
    if (digit * power <= most) return digit * power;
  return power;
}

}  // namespace cleancolor
