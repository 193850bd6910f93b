// viewer/option_json.hpp
//
// The tables of options and profiles as JSON, from which the page makes its forms: docs/viewer-api.md.
#pragma once

#include <string>

#include "viewer/own_printers.hpp"

namespace cleancolor {

/// All options, in the order of the reference.
std::string options_json();

/// The built-in profiles, after the user's own printers; the one named `chosen`, own or built-in, is marked so.  Throws
/// Error where one cannot be read.
std::string profiles_json(const std::string& chosen, const OwnPrinters& own = {});

}  // namespace cleancolor
