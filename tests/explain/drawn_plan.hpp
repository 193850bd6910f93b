// For tests of explain: a print of two colours, drawn road by road, and what is made of it.
#pragma once

#include "audit/drawn.hpp"
#include "explain/explanation.hpp"

namespace cleancolor {

inline const std::vector<Vec2> two_nozzles = {{0, 0}, {33, 0}};

/// A closed loop along a rectangle, of the middle of its roads.
inline void draw_loop(Drawing& d, Vec2 min, Vec2 max) {
  d.go(min).lay({max.x, min.y}).lay(max).lay({min.x, max.y}).lay(min);
}

/// Two boxes side by side, 10 x 10 mm, x from 0 and from 10: an inner loop and an outer wall each, and a line of
/// infill.
inline Drawing two_boxes(int layers, OffsetsIn in = OffsetsIn::slicer) {
  Drawing d(drawn_machine(two_nozzles, in));
  for (int k = 0; k < layers; ++k) {
    d.layer(k);
    for (const int t : {0, 1}) {
      const double x = 10. * t;
      d.tool(t).type("Perimeter");
      draw_loop(d, {x + 0.6, 0.6}, {x + 9.4, 9.4});
      d.wall();
      draw_loop(d, {x + 0.2, 0.2}, {x + 9.8, 9.8});
      d.infill().road({x + 1, 5}, {x + 9, 5});
    }
  }
  return d;
}

inline PrintedLayer printed(const Drawing& drawing, std::uint32_t layer = 0) {
  const GcodePrint print = drawing.print();
  return printed_layer(print, drawing.machine(), timeline(print, drawing.machine()), layer);
}

}  // namespace cleancolor
