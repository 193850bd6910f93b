#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "audit/picture_parts.hpp"
#include "audit/pictures.hpp"
#include "base/printable.hpp"

namespace cleancolor {
namespace {

constexpr double height_px = 300, left = 58, right = 18, top = 40, bottom = 44;
constexpr double label_height = 12;
constexpr double least_axis_mm3 = 0.001;

/// From data to pixels.
struct Axis {
  double most = 1;  // the data's end
  double begin = 0, end = 1;

  double at(double value) const { return begin + (end - begin) * value / most; }
  double step() const { return round_number(most / 4); }
};

void draw_axes(Canvas& canvas, const Axis& x, const Axis& y) {
  for (int i = 0; i * y.step() <= y.most * (1 + 1e-9); ++i) {
    const double value = i * y.step();
    const std::string text = fmt::format("{:g}", value);
    canvas.line(std::vector<Vec2>{{x.begin, y.at(value)}, {x.end, y.at(value)}}, 1, i == 0 ? pale_ink : grid_ink);
    canvas.text({x.begin - 8 - text_width(text, label_height), y.at(value) - 4}, label_height, text, pale_ink);
  }
  for (int i = 0; i * x.step() <= x.most * (1 + 1e-9); ++i) {
    const double value = i * x.step();
    const std::string text = fmt::format("{:g}", value);
    canvas.line(std::vector<Vec2>{{x.at(value), y.begin}, {x.at(value), y.begin - 4}}, 1, pale_ink);
    canvas.text({x.at(value) - text_width(text, label_height) / 2, y.begin - 18}, label_height, text, pale_ink);
  }
  const std::string name = "height z, mm";
  canvas.text({(x.begin + x.end - text_width(name, label_height)) / 2, 8}, label_height, name, pale_ink);
  canvas.text({8, height_px - 20}, label_height, "mm3 in the layer", pale_ink);
}

/// Names beside their lines, from the right; those that find no room are left out.
void draw_legend(Canvas& canvas, std::span<const HeightCurve> curves, double width_px) {
  double x = width_px - right;
  for (std::size_t i = curves.size(); i-- > 0;) {
    const std::string name = printable(curves[i].name);
    x -= text_width(name, label_height);
    if (x < 150) return;
    canvas.text({x, height_px - 20}, label_height, name, ink);
    canvas.line(std::vector<Vec2>{{x - 24, height_px - 16}, {x - 6, height_px - 16}}, 3, curves[i].colour);
    x -= 44;
  }
}

bool has_volume(const HeightCurve& curve) {
  return std::ranges::any_of(curve.points, [](Vec2 p) { return p.y >= least_axis_mm3; });
}

}  // namespace

std::vector<HeightCurve> height_curves(const GcodePrint& print, const AuditMachine& machine, const AuditResult& result,
                                       std::size_t scenario) {
  const ScenarioResult& judged = result.scenarios[scenario];
  const auto curve = [&](std::string name, Colour colour) {
    HeightCurve c{std::move(name), colour, {}};
    for (const GcodeLayer& layer : print.layers) c.points.push_back({layer.z_mm, 0});
    return c;
  };
  std::vector<HeightCurve> curves;
  for (std::size_t n = 0; n < machine.nozzles.size(); ++n)
    curves.push_back(curve(fmt::format("smears of T{}", n), line_colour(machine, n)));
  for (const Place& p : judged.places)
    if (p.kind == Place::Kind::smear && p.nozzle < curves.size()) curves[p.nozzle].points[p.layer].y += double(p.mm3);
  curves.push_back(curve("holes", {0.1, 0.1, 0.1, 0.9}));
  for (std::size_t i = 0; i < judged.layers.size(); ++i) curves.back().points[i].y = judged.layers[i].hole_volume;
  std::erase_if(curves, [](const HeightCurve& c) { return !has_volume(c); });
  return curves;
}

Canvas height_picture(std::span<const HeightCurve> curves, double width_px) {
  Axis x{.most = 1, .begin = left, .end = width_px - right};
  Axis y{.most = 0, .begin = bottom, .end = height_px - top};
  for (const HeightCurve& c : curves)
    for (const Vec2 p : c.points) {
      x.most = std::max(x.most, p.x);
      y.most = std::max(y.most, p.y);
    }
  y.most = y.most > 0 ? 1.05 * y.most : 1;
  Canvas canvas({{0, 0}, {width_px, height_px}}, 1);
  draw_axes(canvas, x, y);
  for (const HeightCurve& c : curves) {
    std::vector<Vec2> line;
    for (const Vec2 p : c.points) line.push_back({x.at(p.x), y.at(p.y)});
    if (line.empty()) continue;
    std::vector<std::vector<Vec2>> area = {line};
    area[0].push_back({line.back().x, y.begin});
    area[0].push_back({line.front().x, y.begin});
    Colour pale = c.colour;
    pale.a = curves.size() > 3 ? 0 : 0.12;
    canvas.fill(area, pale);
    canvas.line(line, 1.6, c.colour);
  }
  draw_legend(canvas, curves, width_px);
  return canvas;
}

}  // namespace cleancolor
