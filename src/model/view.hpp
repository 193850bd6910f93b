// model/view.hpp
//
// The option view_direction: "none" or degrees.
#pragma once

#include <optional>
#include <string_view>

namespace cleancolor {

/// Where somebody looks at the print from, in [0, 360]; nothing for "none".  Throws Error for anything else.
std::optional<double> view_direction_deg(std::string_view text);

}  // namespace cleancolor
