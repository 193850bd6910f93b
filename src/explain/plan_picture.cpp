#include "explain/plan_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "explain/plan_table.hpp"

namespace cleancolor {
namespace {

constexpr double border = 18, gap = 24;
constexpr double title_height = 52, panel_title = 26;
constexpr double legend_height = 96;
constexpr double lowest_panel = 160, highest_panel = 1100;
constexpr double plan_share = 0.62;  // of the sheet's width
constexpr double text_px = 13;

/// Frames from the top left corner of the sheet, Y down.
struct Layout {
  Vec2 size;
  Box<Vec2> plan, roadmap, nozzles;
  double legend_y = 0;  // of its top
};

double height_for(const Box<Vec2>& view_mm, double width) {
  return std::clamp(width * view_mm.size().y / view_mm.size().x, lowest_panel, highest_panel);
}

Layout layout_for(const Box<Vec2>& plastic_mm, const Box<Vec2>& carriage_mm, double width_px) {
  const double inner = width_px - 2 * border - gap;
  const double left = std::floor(plan_share * inner), right = inner - left;
  const double plan = height_for(plastic_mm, left), roadmap = height_for(carriage_mm, right);
  const double nozzles = height_for(plastic_mm, right);
  const double column_left = panel_title + plan + legend_height;
  const double column_right = 2 * panel_title + roadmap + gap + nozzles;
  Layout layout;
  layout.size = {width_px, std::ceil(title_height + std::max(column_left, column_right) + border)};
  const auto frame = [&](double x, double top, double width, double height) {
    return Box<Vec2>{{x, layout.size.y - top - height}, {x + width, layout.size.y - top}};
  };
  // What one column has more room for, its panels take.
  const double spare_left = std::max(0., column_right - column_left), spare_right = column_left - column_right;
  const double plan_height = plan + spare_left, add = std::max(0., spare_right) / 2;
  const double top = title_height + panel_title;
  layout.plan = frame(border, top, left, plan_height);
  layout.roadmap = frame(border + left + gap, top, right, roadmap + add);
  layout.nozzles = frame(border + left + gap, top + roadmap + add + gap + panel_title, right, nozzles + add);
  layout.legend_y = layout.plan.min.y - 14;
  return layout;
}

class Legend {
 public:
  Legend(Canvas& canvas, Vec2 top_left, double width)
      : canvas_(canvas), left_(top_left.x), at_(top_left), width_(width) {
    at_.y -= text_px;
  }

  /// A sample that draw(middle) draws, 30 pixels wide, and what it means.
  template <class Draw>
  void say(const std::string& text, Draw draw) {
    const double needed = 38 + text_width(text, text_px) + 16;
    if (at_.x > left_ && at_.x + needed > left_ + width_) next_row();
    draw(at_ + Vec2{15, 4.5});
    canvas_.text(at_ + Vec2{38, 0}, text_px, text, ink);
    at_.x += needed;
  }
  void line(const std::string& text, double width, Colour colour) {
    say(text, [&](Vec2 m) { canvas_.line(std::vector<Vec2>{m - Vec2{14, 0}, m + Vec2{14, 0}}, width, colour); });
  }
  void dashed(const std::string& text, double width, Colour colour) {
    say(text, [&](Vec2 m) {
      draw_dashed(canvas_, std::vector<Vec2>{m - Vec2{14, 0}, m + Vec2{14, 0}}, width, colour, {4, 3});
    });
  }
  void next_row() { at_ = {left_, at_.y - 23}; }

 private:
  Canvas& canvas_;
  double left_;
  Vec2 at_;
  double width_;
};

bool has_role(const Explanation& plan, bool (*is_it)(Role)) {
  return std::ranges::any_of(plan.printed.runs, [&](const PrintedRun& r) {
    return std::ranges::any_of(r.path.stretches, [&](const Stretch& s) { return is_it(s.road.role); });
  });
}

void draw_legend(Canvas& canvas, const Layout& layout, const PlanScenery& s) {
  Legend legend(canvas, {layout.plan.min.x, layout.legend_y}, layout.plan.size().x);
  for (const int n : s.plan.used) {
    legend.say(fmt::format("extruder {}", n + 1), [&](Vec2 m) {
      const std::vector<Vec2> sample = {m - Vec2{9, 0}, m + Vec2{9, 0}};
      canvas.line(sample, 11, road_colour(s.machine, n, RoadLook::inner));
      canvas.line(sample, 5, road_colour(s.machine, n, RoadLook::outer));
    });
  }
  const int last = s.plan.used.empty() ? 0 : s.plan.used.back();
  if (has_role(s.plan, is_auxiliary))
    legend.line(has_role(s.plan, [](Role r) { return r == Role::rampart; }) ? "rampart" : "skirt, support ...", 7,
                road_colour(s.machine, last, RoadLook::auxiliary));
  if (has_role(s.plan, [](Role r) { return r == Role::refill; }))
    legend.line("refill", 5, road_colour(s.machine, last, RoadLook::refill));
  legend.say("outer wall begins", [&](Vec2 m) { draw_start(canvas, m); });
  legend.say("and ends", [&](Vec2 m) { draw_end(canvas, m); });
  legend.next_row();
  legend.line("travel", 1.4, tour_ink);
  legend.line("a nozzle over visible plastic of another colour", 2.2, bad_ink);
  legend.line("and where the carriage is then", 10, barred_ink);
  legend.next_row();
  legend.line("roadmap", 0.8, road_ink);
  legend.line("idle, another prints", 0.9, nozzle_line(s.machine, last));
  legend.dashed("travelling", 1, nozzle_line(s.machine, last));
}

}  // namespace

Canvas plan_picture(const GcodePrint& print, const PlanScenery& s, const PlanPicture& options) {
  const Box<Vec2> plastic_mm = plastic_view(s), carriage_mm = carriage_view(s);
  const Layout layout = layout_for(plastic_mm, carriage_mm, options.width_px);
  Canvas canvas({{0, 0}, layout.size}, 1);
  const PlanTotals t = totals(s.plan);

  const Panel plan(canvas, layout.plan, plastic_mm);
  plan.background("");
  const std::size_t shown = draw_plan(plan, s);
  std::string title = "Paths in their order, and the travel between them";
  if (shown < s.plan.runs.size()) title += fmt::format(" ({} of {} numbers find room)", shown, s.plan.runs.size());
  canvas.text({layout.plan.min.x, layout.plan.max.y + 7}, 14, title, ink);

  const Panel roadmap(canvas, layout.roadmap, carriage_mm);
  roadmap.background(fmt::format("Roadmap, in the frame of nozzle 1: {} nodes, {} arcs", t.nodes, t.arcs));
  draw_roadmap(roadmap, s);

  const Panel nozzles(canvas, layout.nozzles, plastic_mm);
  nozzles.background("Where every nozzle is while it does not print");
  draw_nozzles(nozzles, s);

  canvas.text({border, layout.size.y - 32}, 19, fmt::format("Layer {}, z {:.2f} mm", s.plan.layer + 1, s.plan.z_mm),
              ink);
  const std::string beside =
      fmt::format("{} paths, {:.0f} mm of road; hops {:.0f} mm, {} of them over visible plastic of another colour",
                  s.plan.runs.size(), t.printed_mm, t.hops_mm, t.hops_over_foreign);
  canvas.text({border + 230, layout.size.y - 32}, text_px, beside, pale_ink);
  canvas.text({layout.size.x - border - text_width(print.name, text_px), layout.size.y - 32}, text_px, print.name,
              pale_ink);
  draw_legend(canvas, layout, s);
  return canvas;
}

}  // namespace cleancolor
