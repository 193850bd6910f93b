// explain/panel.hpp
//
// Panel: a frame of the sheet through which a part of the bed is seen, and the marks that all panels share.
//
// On the sheet a unit is a pixel, Y up.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "audit/picture_parts.hpp"
#include "base/draw.hpp"

namespace cleancolor {

inline constexpr Colour tour_ink = {0.16, 0.18, 0.22, 1};  // of travel
inline constexpr Colour bad_ink = {0.84, 0.08, 0.12, 1};   // over visible plastic of another colour
inline constexpr Colour barred_ink = {0.99, 0.87, 0.86, 1};
inline constexpr Colour road_ink = {0.66, 0.70, 0.75, 1};  // of the roadmap
inline constexpr Colour white = {1, 1, 1, 1};

class Panel {
 public:
  /// Shows view_mm in the middle of the frame, as large as it goes.  Requires: neither is empty.
  Panel(Canvas& canvas, const Box<Vec2>& frame, const Box<Vec2>& view_mm);

  Canvas& canvas() const { return canvas_; }
  const Box<Vec2>& frame() const { return frame_; }
  double scale() const { return scale_; }
  Vec2 at(Vec2 p_mm) const { return frame_.center() + (p_mm - middle_mm_) * scale_; }
  std::vector<Vec2> at(std::span<const Vec2> points_mm) const;
  bool shows(Vec2 p_mm) const;

  void background(std::string_view title) const;
  void scale_bar() const;

  /// What of it the frame shows.
  void line(std::span<const Vec2> points_mm, double width_px, Colour colour) const;
  void dashed(std::span<const Vec2> points_mm, double width_px, Colour colour) const;
  void rings(std::span<const std::vector<Vec2>> rings_mm, Colour colour) const;

  /// Arrowheads along the way, about every so many pixels, at least one where the way is no shorter than shortest_px.
  void arrows(std::span<const Vec2> points_mm, double every_px, double shortest_px, double size_px,
              Colour colour) const;

 private:
  void arrowhead(Vec2 tip, Vec2 direction, double size_px, Colour colour) const;

  Canvas& canvas_;
  Box<Vec2> frame_;
  Vec2 middle_mm_;
  double scale_ = 1;
};

/// Labels that do not hide each other.
class Labels {
 public:
  explicit Labels(const Panel& panel) : panel_(panel) {}

  enum class Look { number, zone };  // of paths: beside the place, white on colour; of zones: on it, if there is room

  /// A label with a line to its place, where there is room for it near there.  Returns whether there was.
  bool put(Vec2 at_mm, std::string_view text, Colour colour, Look look = Look::number);

 private:
  bool has_room(const Box<Vec2>& box) const;

  const Panel& panel_;
  std::vector<Box<Vec2>> taken_;
};

}  // namespace cleancolor
