#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "audit/picture_parts.hpp"
#include "audit/pictures.hpp"
#include "audit/report_words.hpp"

namespace cleancolor {
namespace {

constexpr double title_height = 46, legend_height = 62, border = 14;
constexpr double text_height = 13;
constexpr double lowest_plot = 160;
constexpr double width_step_mm = 0.02;

// What no real print reaches: a bound on the memory of the picture.
constexpr double most_dashed_px = 2e6;
constexpr std::size_t most_places_drawn = 20'000;

enum class Plastic { auxiliary, inner, outer };

/// Roads that follow each other without a gap.
struct Stroke {
  std::vector<Vec2> points_mm;
  double width_mm = 0;
  std::size_t nozzle = 0;
  Plastic plastic = Plastic::inner;
};

/// The way of an idle nozzle.
struct Way {
  std::vector<Vec2> points_mm;
  std::size_t nozzle = 0;
  bool travel = false;
};

struct LayerDrawing {
  std::vector<Stroke> strokes;
  std::vector<Way> ways;
};

Plastic plastic_of(Role role) {
  if (is_auxiliary(role)) return Plastic::auxiliary;
  switch (role) {
    case Role::external_perimeter:
    case Role::overhang_perimeter:
    case Role::top_solid_infill:
    case Role::ironing:
    case Role::unknown:
      return Plastic::outer;
    default:
      return Plastic::inner;
  }
}

/// Goes through the drives of a layer.
class LayerCollector {
 public:
  LayerCollector(const GcodePrint& print, const AuditMachine& machine, const Timeline& time)
      : print_(print), machine_(machine), time_(time), open_way_(machine.nozzles.size(), no_way) {}

  LayerDrawing drawing(std::uint32_t layer) {
    const auto count = std::uint32_t(print_.moves.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      if (print_.moves[i].layer != layer) continue;
      const std::uint32_t first = i;
      while (i < count && print_.moves[i].layer == layer) ++i;
      for (const Drive& d : drives(print_, machine_, time_, first, i))
        if (d.known && d.layer == layer && d.moves_xy()) add(d);
    }
    return std::move(drawing_);
  }

 private:
  static constexpr std::size_t no_way = ~std::size_t(0);

  void add(const Drive& d) {
    if (d.lays && d.feeds < machine_.nozzles.size()) add_road(d);
    for (std::size_t n = 0; n < machine_.nozzles.size(); ++n) {
      const bool is_used = n < time_.used.size() && time_.used[n];
      const bool touches = machine_.idle_nozzle == IdleNozzle::same_height || n == d.tool;
      if (is_used && touches && !(d.lays && n == d.feeds))
        add_way(d, n);
      else
        open_way_[n] = no_way;
    }
  }

  void add_road(const Drive& d) {
    const Vec2 offset = machine_.nozzles[d.feeds].offset_mm;
    const Plastic plastic = plastic_of(d.role);
    const double width_mm = double(print_.moves[d.move].width_mm);
    const Vec2 from = d.from_mm + offset, to = d.to_mm + offset;
    std::vector<Stroke>& all = drawing_.strokes;
    const bool goes_on = !all.empty() && all.back().nozzle == d.feeds && all.back().plastic == plastic &&
                         std::abs(all.back().width_mm - width_mm) < width_step_mm &&
                         all.back().points_mm.back() == from;
    if (!goes_on) all.push_back({{from}, width_mm, d.feeds, plastic});
    all.back().points_mm.push_back(to);
  }

  void add_way(const Drive& d, std::size_t nozzle) {
    const Vec2 offset = machine_.nozzles[nozzle].offset_mm;
    std::vector<Way>& all = drawing_.ways;
    std::size_t& open = open_way_[nozzle];
    const bool goes_on =
        open != no_way && all[open].travel == !d.lays && all[open].points_mm.back() == d.from_mm + offset;
    if (!goes_on) {
      open = all.size();
      all.push_back({{d.from_mm + offset}, nozzle, !d.lays});
    }
    all[open].points_mm.push_back(d.to_mm + offset);
  }

  const GcodePrint& print_;
  const AuditMachine& machine_;
  const Timeline& time_;
  std::vector<std::size_t> open_way_;  // by nozzle: index of the way that may go on
  LayerDrawing drawing_;
};

/// The plastic of the layer, with a little air around it.
Box<Vec2> view_of(const LayerDrawing& drawing) {
  Box<Vec2> box;
  for (const Stroke& s : drawing.strokes)
    for (const Vec2 p : s.points_mm) box.add(p);
  if (box.empty()) box.add({0, 0});
  const double air_mm = 1 + 0.03 * std::max(box.size().x, box.size().y);
  return {box.min - Vec2{air_mm, air_mm}, box.max + Vec2{air_mm, air_mm}};
}

/// Where mm of the bed lie on the sheet.
struct Sheet {
  Box<Vec2> view_mm;
  Vec2 size;        // of the whole picture
  Box<Vec2> frame;  // that shows the bed
  double scale = 1;

  Vec2 at(Vec2 p_mm) const { return frame.center() + (p_mm - view_mm.center()) * scale; }
};

Sheet sheet_for(const Box<Vec2>& view_mm, const LayerPicture& options) {
  Sheet sheet{.view_mm = view_mm, .size = {}, .frame = {}, .scale = 1};
  const double width = options.width_px - 2 * border;
  sheet.scale = std::min(width / view_mm.size().x, width / view_mm.size().y);
  const double height = std::max(lowest_plot, view_mm.size().y * sheet.scale);
  const double below = options.legend ? legend_height : border;
  sheet.size = {options.width_px, std::ceil(title_height + height + below)};
  sheet.frame.add({border, below});
  sheet.frame.add({border + width, below + height});
  return sheet;
}

class Painter {
 public:
  Painter(const AuditMachine& machine, const Sheet& sheet)
      : machine_(machine), sheet_(sheet), canvas_({{0, 0}, sheet.size}, 1) {}

  void frame() {
    const Box<Vec2>& f = sheet_.frame;
    const std::vector<std::vector<Vec2>> ring = {{f.min, {f.max.x, f.min.y}, f.max, {f.min.x, f.max.y}}};
    canvas_.fill(ring, {0.972, 0.975, 0.98, 1});
  }

  void strokes(const std::vector<Stroke>& all, Plastic plastic) {
    // All borders first: where two roads overlap, neither looks cut.
    for (const bool core : {false, true})
      for (const Stroke& s : all)
        if (s.plastic == plastic) stroke(s, core);
  }

  void ways(const std::vector<Way>& all) {
    double dashed_left_px = most_dashed_px;
    for (const Way& way : all) {
      std::vector<Vec2> points;
      for (const Vec2 p : way.points_mm) points.push_back(sheet_.at(p));
      Colour colour = line_colour(machine_, way.nozzle);
      colour.a = way.travel ? 0.8 : 0.5;
      for (const auto& piece : clipped(points, sheet_.frame)) {
        if (way.travel) dashed_left_px -= length(piece);
        if (way.travel && dashed_left_px > 0)
          draw_dashed(canvas_, piece, 1, colour);
        else
          canvas_.line(piece, 0.9, colour);
      }
    }
  }

  void places(const std::vector<const Place*>& largest_first) {
    for (const Place* p : largest_first) {
      const Vec2 at = sheet_.at(p->at_mm);
      if (!clipped(at, at, sheet_.frame)) continue;
      if (p->kind == Place::Kind::wipe) wipe(at, p->nozzle);
      if (p->kind == Place::Kind::hole) ring(at, radius(double(p->mm3)));
      if (p->kind == Place::Kind::smear) blob(at, radius(double(p->mm3)), p->nozzle);
    }
  }

  void title(const std::string& title, const std::string& beside) {
    const double y = sheet_.size.y - 30;
    canvas_.text({border, y}, 18, title, ink);
    canvas_.text({sheet_.size.x - border - text_width(beside, text_height), y}, text_height, beside, pale_ink);
  }

  void scale_bar();
  void legend(const std::vector<std::size_t>& nozzles);
  Canvas done() && { return std::move(canvas_); }

 private:
  Colour colour_of(std::size_t nozzle) const {
    return nozzle < machine_.nozzles.size() ? colour(machine_.nozzles[nozzle].rgb) : pale_ink;
  }

  static double length(std::span<const Vec2> points) {
    double sum = 0;
    for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1], points[i]);
    return sum;
  }

  /// 1 mm3 is a disc of 24 pixels radius, whatever the layer's size: pictures of layers compare.
  static double radius(double mm3) { return std::max(2., 24 * std::sqrt(mm3)); }

  void stroke(const Stroke& s, bool core) {
    Colour fill = colour_of(s.nozzle);
    if (s.plastic == Plastic::inner) fill = mixed(fill, {1, 1, 1, 1}, 0.45);
    if (s.plastic == Plastic::auxiliary) fill = mixed(fill, {1, 1, 1, 1}, 0.78);
    const Colour edge = lightness(fill) < 0.2 ? mixed(fill, {1, 1, 1, 1}, 0.35) : mixed(fill, {0, 0, 0, 1}, 0.28);
    std::vector<Vec2> points;
    for (const Vec2 p : s.points_mm) points.push_back(sheet_.at(p));
    const double width = std::max(0.8, s.width_mm * sheet_.scale);
    canvas_.line(points, core ? std::max(0.5, 0.78 * width) : width, core ? fill : edge);
  }

  void blob(Vec2 at, double r, std::size_t nozzle) {
    canvas_.disc(at, r + 2.2, {1, 1, 1, 0.9});
    canvas_.disc(at, r + 1, mixed(colour_of(nozzle), {0, 0, 0, 1}, 0.55));
    canvas_.disc(at, r, colour_of(nozzle));
  }

  void ring(Vec2 at, double r) {
    std::vector<Vec2> circle;
    for (int i = 0; i < 32; ++i) circle.push_back(at + r * Vec2{std::cos(i * 0.19634954), std::sin(i * 0.19634954)});
    canvas_.line(circle, 4.2, {1, 1, 1, 0.9}, true);
    canvas_.line(circle, 2, {0, 0, 0, 1}, true);
  }

  void wipe(Vec2 at, std::size_t nozzle) {
    const std::vector<Vec2> tick = {at + Vec2{0, -5}, at + Vec2{0, 5}};
    canvas_.line(tick, 3.4, {1, 1, 1, 0.9});
    canvas_.line(tick, 1.8, mixed(line_colour(machine_, nozzle), {0, 0, 0, 1}, 0.3));
  }

  const AuditMachine& machine_;
  const Sheet& sheet_;
  Canvas canvas_;
};

void Painter::scale_bar() {
  const double mm = round_number(sheet_.frame.size().x / 5 / sheet_.scale);
  const double length = mm * sheet_.scale;
  const std::string text = fmt::format("{:g} mm", mm);
  const Vec2 right{sheet_.frame.max.x - 10, sheet_.frame.min.y + 10}, left = right - Vec2{length, 0};
  const std::vector<Vec2> bar = {left + Vec2{0, 5}, left, right, right + Vec2{0, 5}};
  canvas_.line(bar, 4, {1, 1, 1, 0.8});
  canvas_.line(bar, 1.5, ink);
  canvas_.text((left + right) * 0.5 + Vec2{-text_width(text, 12) / 2, 6}, 12, text, ink);
}

void Painter::legend(const std::vector<std::size_t>& nozzles) {
  double x = border, y = legend_height - 26;
  const auto say = [&](const std::string& text) {
    canvas_.text({x, y - 4.5}, text_height, text, ink);
    x += text_width(text, text_height) + 20;
  };
  for (const std::size_t n : nozzles) {
    const std::vector<Vec2> sample = {{x + 5, y}, {x + 25, y}};
    canvas_.line(sample, 10, mixed(colour_of(n), {0, 0, 0, 1}, 0.28));
    canvas_.line(sample, 7.5, colour_of(n));
    x += 38;
    say(fmt::format("T{}", n));
  }
  const std::size_t n = nozzles.empty() ? 0 : nozzles.back();
  canvas_.line(std::vector<Vec2>{{x + 5, y}, {x + 25, y}}, 10, {0.86, 0.87, 0.89, 1});
  x += 38;
  say("thrown away");
  canvas_.line(std::vector<Vec2>{{x, y}, {x + 28, y}}, 0.9, line_colour(machine_, n));
  x += 36;
  say("idle, another prints");
  draw_dashed(canvas_, std::vector<Vec2>{{x, y}, {x + 28, y}}, 1, line_colour(machine_, n));
  x += 36;
  say("idle, travelling");
  x = border + 10;
  y -= 24;
  for (const double mm3 : {0.03, 0.1, 0.2}) {
    blob({x, y}, radius(mm3), n);
    x += 2 * radius(mm3) + 8;
  }
  say("smear of 0.03, 0.1, 0.2 mm3");
  ring({x + 4, y}, radius(0.1));
  x += 22;
  say("hole of 0.1 mm3");
  wipe({x + 2, y}, n);
  x += 12;
  say("wipe");
}

std::vector<const Place*> places_of(const ScenarioResult& scenario, std::uint32_t layer) {
  std::vector<const Place*> places;
  for (const Place& p : scenario.places)
    if (p.layer == layer) places.push_back(&p);
  std::ranges::stable_sort(places, [](const Place* a, const Place* b) { return a->mm3 > b->mm3; });
  places.resize(std::min(places.size(), most_places_drawn));
  return places;
}

}  // namespace

Colour line_colour(const AuditMachine& machine, std::size_t nozzle) {
  return nozzle < machine.nozzles.size() ? readable_on_white(colour(machine.nozzles[nozzle].rgb)) : pale_ink;
}

Canvas layer_picture(const GcodePrint& print, const AuditMachine& machine, const AuditResult& result,
                     std::size_t scenario, std::uint32_t layer, const LayerPicture& options) {
  assert(layer < print.layers.size() && scenario < result.scenarios.size() && result.time);
  const LayerDrawing drawing = LayerCollector(print, machine, *result.time).drawing(layer);
  const Sheet sheet = sheet_for(view_of(drawing), options);
  Painter painter(machine, sheet);
  painter.frame();
  for (const Plastic plastic : {Plastic::auxiliary, Plastic::inner, Plastic::outer})
    painter.strokes(drawing.strokes, plastic);
  painter.ways(drawing.ways);
  const ScenarioResult& judged = result.scenarios[scenario];
  painter.places(places_of(judged, layer));
  painter.scale_bar();
  const Figures& figures = judged.layers[layer];
  painter.title(fmt::format("Layer {}, z {:.2f} mm", layer + 1, print.layers[layer].z_mm),
                fmt::format("{}: smears {} mm3, holes {} mm3", judged.name, figure_text(figures.smear_volume(), "mm3"),
                            figure_text(figures.hole_volume, "mm3")));
  if (options.legend) {
    std::vector<std::size_t> used;
    for (std::size_t n = 0; n < machine.nozzles.size() && n < result.time->used.size(); ++n)
      if (result.time->used[n]) used.push_back(n);
    painter.legend(used);
  }
  return std::move(painter).done();
}

}  // namespace cleancolor
