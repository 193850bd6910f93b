#include "model/motion_limits.hpp"

#include <limits>

namespace cleancolor {

MotionLimits motion_limits(const Config& c) {
  const auto axes = [](Vec3 v, double e) { return Axes{v.x, v.y, v.z, e}; };
  // 0 leaves it to the limits of the axes.
  const auto along = [](double mm_s2) { return mm_s2 > 0 ? mm_s2 : std::numeric_limits<double>::infinity(); };
  return {.max_speed_mm_s = axes(c.machine_max_feedrate_mm_s, c.machine_max_feedrate_e_mm_s),
          .max_acceleration_mm_s2 = axes(c.machine_max_acceleration_mm_s2, c.machine_max_acceleration_e_mm_s2),
          .max_jerk_mm_s = axes(c.machine_max_jerk_mm_s, c.machine_max_jerk_e_mm_s),
          .extruding_mm_s2 = along(c.machine_max_acceleration_extruding_mm_s2),
          .travel_mm_s2 = along(c.machine_max_acceleration_travel_mm_s2),
          .retracting_mm_s2 = along(c.machine_max_acceleration_retracting_mm_s2)};
}

}  // namespace cleancolor
