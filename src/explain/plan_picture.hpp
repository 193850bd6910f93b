// explain/plan_picture.hpp
//
// Plan picture: one sheet that shows how a layer was planned: three views (plan_panels.hpp) and what they mean.
#pragma once

#include "base/draw.hpp"
#include "explain/plan_panels.hpp"
#include "reader/print.hpp"

namespace cleancolor {

struct PlanPicture {
  double width_px = 1600;
};

/// Cost: about 0.2 s for 5000 roads and 2000 nodes.
Canvas plan_picture(const GcodePrint& print, const PlanScenery& scenery, const PlanPicture& options = {});

}  // namespace cleancolor
