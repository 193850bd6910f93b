// model/ini_dialect.hpp
//
// What the configurations of PrusaSlicer and Slic3r say in words other than ours.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace cleancolor {

/// Our name of an option that had another once: "fill_gaps" -> "gap_fill_enabled". Unknown names stay.
std::string_view current_name(std::string_view key);

struct Replacement {
  std::string_view value;  // empty: there is none
  bool differs = false;    // the print will look different: worth a warning
};

/// The nearest value we have for one of theirs: ("fill_pattern", "honeycomb") -> grid.
Replacement nearest_value(std::string_view option, std::string_view value);

/// Would the key have changed the print? False for notes, for settings of a feature that is off, and for values that
/// mean what is done here anyway.  value_of: the value of another key of the same file, "" where it is absent.
bool matters(std::string_view key, std::string_view value,
             const std::function<std::string_view(std::string_view)>& value_of);

}  // namespace cleancolor
