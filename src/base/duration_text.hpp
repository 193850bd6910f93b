// base/duration_text.hpp
//
// A time as people say it.
#pragma once

#include <string>

namespace cleancolor {

/// "1 h 02 min", "3 min 20 s", "45 s".  Requires: finite.
std::string duration_text(double seconds);

}  // namespace cleancolor
