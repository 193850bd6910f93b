#include "base/draw.hpp"

#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>

#include "base/error.hpp"

namespace cleancolor {
namespace {

struct SurfaceEnd {
  void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
};
struct ContextEnd {
  void operator()(cairo_t* c) const { cairo_destroy(c); }
};
using Surface = std::unique_ptr<cairo_surface_t, SurfaceEnd>;
using Context = std::unique_ptr<cairo_t, ContextEnd>;

cairo_status_t append(void* text, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

void must_succeed(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw SystemError(std::string("drawing failed: ") + cairo_status_to_string(status));
}

std::string png_of(cairo_surface_t* image) {
  std::string bytes;
  must_succeed(cairo_surface_write_to_png_stream(image, append, &bytes));
  return bytes;
}

void set_colour(cairo_t* c, Colour k) {
  cairo_set_source_rgba(c, k.r, k.g, k.b, k.a);
}

void trace(cairo_t* c, std::span<const Vec2> points, bool closed) {
  cairo_new_sub_path(c);
  for (const Vec2 p : points) cairo_line_to(c, p.x, p.y);
  if (closed) cairo_close_path(c);
}

/// Cairo numbers the surfaces of the whole program; here they are numbered as they come, so that a picture does not
/// depend on what was drawn before it.
std::string with_own_numbers(const std::string& svg) {
  constexpr std::string_view name = "surface";
  std::map<std::string, std::size_t> numbers;
  std::string text;
  for (std::size_t at = 0; at < svg.size();) {
    const std::size_t found = std::min(svg.size(), svg.find(name, at));
    text += svg.substr(at, found - at);
    if (found == svg.size()) break;
    const std::size_t begin = found + name.size();
    const std::size_t end = std::min(svg.size(), svg.find_first_not_of("0123456789", begin));
    const auto [number, is_new] = numbers.try_emplace(svg.substr(begin, end - begin), numbers.size());
    text += name;
    text += std::to_string(number->second);
    at = end;
  }
  return text;
}

}  // namespace

// Drawn once into a recording, played back onto whatever is asked for.
struct Canvas::Picture {
  double width_px;
  double height_px;
  Surface recording;
  Context context;

  Picture(double width, double height, Surface surface, Context c)
      : width_px(width), height_px(height), recording(std::move(surface)), context(std::move(c)) {}
  Picture(const Picture&) = delete;
  /// Cairo never lets go of a recording that it wrote as SVG; emptied at least it can be.
  ~Picture() { cairo_surface_finish(recording.get()); }

  void play(cairo_surface_t* surface) const {
    const Context c(cairo_create(surface));
    cairo_set_source_surface(c.get(), recording.get(), 0, 0);
    cairo_paint(c.get());
    must_succeed(cairo_status(c.get()));
  }
};

Canvas::Canvas(Box<Vec2> view_mm, double pixels_per_mm) {
  assert(!view_mm.empty() && pixels_per_mm > 0);
  const Vec2 size = view_mm.size() * pixels_per_mm;
  const cairo_rectangle_t extents{0, 0, std::ceil(size.x), std::ceil(size.y)};
  Surface recording(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &extents));
  Context context(cairo_create(recording.get()));
  cairo_set_source_rgb(context.get(), 1, 1, 1);
  cairo_paint(context.get());
  cairo_scale(context.get(), pixels_per_mm, -pixels_per_mm);
  cairo_translate(context.get(), -view_mm.min.x, -view_mm.max.y);
  cairo_set_line_cap(context.get(), CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context.get(), CAIRO_LINE_JOIN_ROUND);
  picture_.reset(new Picture(extents.width, extents.height, std::move(recording), std::move(context)));
}

Canvas::~Canvas() = default;
Canvas::Canvas(Canvas&&) noexcept = default;
Canvas& Canvas::operator=(Canvas&&) noexcept = default;

void Canvas::fill(std::span<const std::vector<Vec2>> rings_mm, Colour colour) {
  cairo_t* c = picture_->context.get();
  for (const auto& ring : rings_mm) trace(c, ring, true);
  set_colour(c, colour);
  cairo_fill(c);
}

void Canvas::line(std::span<const Vec2> points_mm, double width_mm, Colour colour, bool closed) {
  cairo_t* c = picture_->context.get();
  trace(c, points_mm, closed);
  cairo_set_line_width(c, width_mm);
  set_colour(c, colour);
  cairo_stroke(c);
}

void Canvas::disc(Vec2 center_mm, double radius_mm, Colour colour) {
  cairo_t* c = picture_->context.get();
  cairo_new_sub_path(c);
  cairo_arc(c, center_mm.x, center_mm.y, radius_mm, 0, 2 * std::numbers::pi);
  set_colour(c, colour);
  cairo_fill(c);
}

void Canvas::text(Vec2 at_mm, double height_mm, std::string_view utf8, Colour colour) {
  cairo_t* c = picture_->context.get();
  cairo_save(c);
  cairo_translate(c, at_mm.x, at_mm.y);
  cairo_scale(c, 1, -1);
  cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(c, height_mm);
  set_colour(c, colour);
  cairo_move_to(c, 0, 0);
  cairo_show_text(c, std::string(utf8).c_str());
  cairo_restore(c);
}

std::string Canvas::png() const {
  const Surface image(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, int(picture_->width_px), int(picture_->height_px)));
  picture_->play(image.get());
  return png_of(image.get());
}

std::string Canvas::svg() const {
  std::string bytes;
  const Surface surface(cairo_svg_surface_create_for_stream(append, &bytes, picture_->width_px, picture_->height_px));
  picture_->play(surface.get());
  cairo_surface_finish(surface.get());
  must_succeed(cairo_surface_status(surface.get()));
  return with_own_numbers(bytes);
}

std::string png(int width, int height, std::span<const std::uint8_t> rgba) {
  assert(rgba.size() == 4 * std::size_t(width) * std::size_t(height));
  const Surface image(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height));
  must_succeed(cairo_surface_status(image.get()));
  cairo_surface_flush(image.get());
  unsigned char* rows = cairo_image_surface_get_data(image.get());
  const int stride = cairo_image_surface_get_stride(image.get());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::uint8_t* p = &rgba[4 * (std::size_t(y) * std::size_t(width) + std::size_t(x))];
      const auto premultiplied = [&](int i) { return (std::uint32_t(p[i]) * p[3] + 127) / 255; };
      const std::uint32_t argb =
          std::uint32_t(p[3]) << 24 | premultiplied(0) << 16 | premultiplied(1) << 8 | premultiplied(2);
      std::memcpy(rows + std::ptrdiff_t(y) * stride + 4 * x, &argb, 4);
    }
  cairo_surface_mark_dirty(image.get());
  return png_of(image.get());
}

}  // namespace cleancolor
