// viewer/option_json.hpp
//
// The tables of options and profiles as JSON, from which the page makes its forms: docs/viewer-api.md.
#pragma once

#include <string>

namespace cleancolor {

/// All options, in the order of the reference.
std::string options_json();

/// The built-in profiles, after own_printer where it is not empty: that of the user, marked as chosen, which may also
/// be a built-in one.  Throws Error where it cannot be read.
std::string profiles_json(const std::string& own_printer);

}  // namespace cleancolor
