// model/option_table.hpp
//
// The table behind model/options.hpp: one row per option.
#pragma once

#include <span>

#include "model/options.hpp"

namespace cleancolor {

std::span<const Option> option_table();

}  // namespace cleancolor
