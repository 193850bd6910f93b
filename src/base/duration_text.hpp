// base/duration_text.hpp
//
// A time as people say it.
#pragma once

#include <string>

namespace cleancolor {

/// "1 h 02 min", "3 min 20 s", "45 s".  Requires: finite.
std::string duration_text(double seconds);

/// "1d 2h 3m 4s", leaving out what is zero on the left, as in the G-code of slicers.  Requires: finite, >= 0.
std::string duration_in_slicers_words(double seconds);

}  // namespace cleancolor
