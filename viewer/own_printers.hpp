// viewer/own_printers.hpp
//
// OwnPrinters: printer profiles of the user's own, which jobs and prints may name beside the built-in ones: that of the
// command line, and those sent to the program.
//
// Other files cannot be named, for whoever asks need not be allowed to read what this program can. For the same reason
// a profile that was sent inherits built-in ones only.
#pragma once

#include <map>
#include <string>

#include "viewer/files.hpp"

namespace cleancolor {

using OwnPrinters = std::map<std::string, FileHandle>;  // by name

/// The name for find_profile() and Settings: an own printer's file, else the name itself.
std::string printer_named(const std::string& name, const OwnPrinters& own);

/// Throws Error("name:line: ...") in words where this text cannot be used as a printer's profile by itself, or would
/// have other files read.
void check_printer(const std::string& toml, const std::string& name);

}  // namespace cleancolor
