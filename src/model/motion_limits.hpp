// model/motion_limits.hpp
//
// The printer's options as limits of its motion.
#pragma once

#include "base/motion.hpp"
#include "model/config.hpp"

namespace cleancolor {

/// The printer's limits; an acceleration of 0 along moves of one kind means no limit but those of the axes.
MotionLimits motion_limits(const Config& config);

}  // namespace cleancolor
