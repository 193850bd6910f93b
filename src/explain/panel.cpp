#include "explain/panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace cleancolor {
namespace {

constexpr double title_px = 14;
constexpr Colour paper = {0.982, 0.984, 0.988, 1};

double way_px(std::span<const Vec2> points) {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1], points[i]);
  return sum;
}

bool overlap(const Box<Vec2>& a, const Box<Vec2>& b) {
  return a.min.x < b.max.x && b.min.x < a.max.x && a.min.y < b.max.y && b.min.y < a.max.y;
}

Box<Vec2> box_around(Vec2 center, Vec2 half) {
  return {center - half, center + half};
}

}  // namespace

Panel::Panel(Canvas& canvas, const Box<Vec2>& frame, const Box<Vec2>& view_mm)
    : canvas_(canvas), frame_(frame), middle_mm_(view_mm.center()) {
  assert(!frame.empty() && !view_mm.empty());
  scale_ = std::min(frame.size().x / view_mm.size().x, frame.size().y / view_mm.size().y);
}

std::vector<Vec2> Panel::at(std::span<const Vec2> points_mm) const {
  std::vector<Vec2> points;
  points.reserve(points_mm.size());
  for (const Vec2 p : points_mm) points.push_back(at(p));
  return points;
}

bool Panel::shows(Vec2 p_mm) const {
  const Vec2 p = at(p_mm);
  return clipped(p, p, frame_).has_value();
}

void Panel::background(std::string_view title) const {
  const Box<Vec2>& f = frame_;
  const std::vector<std::vector<Vec2>> ring = {{f.min, {f.max.x, f.min.y}, f.max, {f.min.x, f.max.y}}};
  canvas_.fill(ring, paper);
  canvas_.line(ring.front(), 1, grid_ink, true);
  canvas_.text({f.min.x, f.max.y + 7}, title_px, title, ink);
}

void Panel::scale_bar() const {
  const double mm = round_number(frame_.size().x / 5 / scale_);
  const std::string text = fmt::format("{:g} mm", mm);
  const Vec2 right{frame_.max.x - 10, frame_.min.y + 10}, left = right - Vec2{mm * scale_, 0};
  const std::vector<Vec2> bar = {left + Vec2{0, 5}, left, right, right + Vec2{0, 5}};
  canvas_.line(bar, 4, {1, 1, 1, 0.8});
  canvas_.line(bar, 1.5, ink);
  canvas_.text((left + right) * 0.5 + Vec2{-text_width(text, 12) / 2, 6}, 12, text, ink);
}

void Panel::line(std::span<const Vec2> points_mm, double width_px, Colour colour) const {
  for (const auto& piece : clipped(at(points_mm), frame_)) canvas_.line(piece, width_px, colour);
}

void Panel::dashed(std::span<const Vec2> points_mm, double width_px, Colour colour) const {
  for (const auto& piece : clipped(at(points_mm), frame_)) draw_dashed(canvas_, piece, width_px, colour, {4, 3});
}

void Panel::rings(std::span<const std::vector<Vec2>> rings_mm, Colour colour) const {
  std::vector<std::vector<Vec2>> rings;
  for (const auto& ring : rings_mm) rings.push_back(at(ring));
  canvas_.fill(rings, colour);
}

void Panel::arrows(std::span<const Vec2> points_mm, double every_px, double shortest_px, double size_px,
                   Colour colour) const {
  const std::vector<Vec2> points = at(points_mm);
  const double all = way_px(points);
  if (all < shortest_px) return;
  const auto count = std::max(1., std::floor(all / every_px));
  double next = all / count / 2, way = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double step = distance(points[i - 1], points[i]);
    for (; step > 0 && next <= way + step; next += all / count) {
      const Vec2 tip = lerp(points[i - 1], points[i], (next - way) / step);
      if (clipped(tip, tip, frame_)) arrowhead(tip, (points[i] - points[i - 1]) * (1 / step), size_px, colour);
    }
    way += step;
  }
}

void Panel::arrowhead(Vec2 tip, Vec2 direction, double size_px, Colour colour) const {
  const Vec2 left{-direction.y, direction.x};
  tip = tip + direction * (size_px / 2);
  const Vec2 back = tip - direction * size_px;
  const std::vector<std::vector<Vec2>> head = {
      {tip, back + left * (0.42 * size_px), back + direction * (0.25 * size_px), back - left * (0.42 * size_px)}};
  canvas_.fill(head, colour);
}

bool Labels::has_room(const Box<Vec2>& box) const {
  const Box<Vec2>& f = panel_.frame();
  if (box.min.x < f.min.x || box.min.y < f.min.y || box.max.x > f.max.x || box.max.y > f.max.y) return false;
  return std::ranges::none_of(taken_, [&](const Box<Vec2>& other) { return overlap(box, other); });
}

bool Labels::put(Vec2 at_mm, std::string_view text, Colour colour, Look look) {
  constexpr double height = 11.5, directions = 12;
  constexpr std::array<double, 5> distances = {0, 13, 20, 29, 40};
  const Vec2 place = panel_.at(at_mm);
  const Vec2 half{text_width(text, height) / 2 + 4, 7.5};
  const bool is_zone = look == Look::zone;
  for (const double away : distances)
    for (int i = 0; i < int(directions); ++i) {
      if (away == 0 && !is_zone) break;
      const double angle = 2 * std::numbers::pi * (i + 1.5) / directions;
      const double beside = away > 0 ? away + std::max(0., half.x - 7.5) : 0;
      const Vec2 middle = place + Vec2{std::cos(angle) * beside, std::sin(angle) * away};
      const Box<Vec2> box = box_around(middle, Vec2{std::max(half.x, half.y), half.y} + Vec2{1.5, 1.5});
      if (!has_room(box)) continue;
      taken_.push_back(box);
      if (!is_zone) taken_.push_back(box_around(place, {4, 4}));
      Canvas& canvas = panel_.canvas();
      const double straight = std::max(1e-3, half.x - half.y);
      const std::vector<Vec2> leader = {place, middle};
      const std::vector<Vec2> pill = {middle - Vec2{straight, 0}, middle + Vec2{straight, 0}};
      canvas.line(leader, 1, colour);
      canvas.line(pill, 2 * half.y + 1.6, is_zone ? colour : white);
      canvas.line(pill, 2 * half.y, is_zone ? white : colour);
      canvas.text(middle - Vec2{text_width(text, height) * 0.5, 0.36 * height}, height, text, is_zone ? colour : white);
      return true;
    }
  return false;
}

}  // namespace cleancolor
