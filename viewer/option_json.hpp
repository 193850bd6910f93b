// viewer/option_json.hpp
//
// The tables of options and profiles as JSON, from which the page makes its forms: docs/viewer-api.md.
#pragma once

#include <string>

#include "model/profile.hpp"

namespace cleancolor {

/// All options, in the order of the reference.
std::string options_json();

/// How the user came to a printer.
struct PrinterRow {
  bool chosen = false;  // named by --printer
  bool sent = false;    // to the program, which can forget it
};

/// An object of the list of profiles. Throws Error as with_profile does.
std::string printer_row(const Profile& printer, PrinterRow row);

/// The objects of all built-in profiles and of what protects, with commas between them; the printer named `chosen` is
/// marked so.
std::string built_in_rows(const std::string& chosen);

}  // namespace cleancolor
