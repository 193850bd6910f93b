// replan/written.hpp
//
// Written: the planned layers as G-code in the dialect of the file that they come from.
//
//   text, recovered print, layers in printing order  ->  text
//
// What stands before and after the layers stays to the letter. Between: headers of the layers; for each path the lines
// by which the state differs that it was printed under, the way there with the file's own drawing back, and its own
// roads. A loop that is begun elsewhere goes over its old seam, and leaves as much of a gap at its new one. Where the
// seam lies on another kind of road than the new start, nothing is pushed across the old one instead: amounts stay.
#pragma once

#include <string>
#include <vector>

#include "audit/machine.hpp"
#include "model/config.hpp"
#include "replan/recovered.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

/// header: our line, without its end.
/// Throws Error where a planned path is none of the file's: a fault of the program, never of the file.
/// Requires: layers are those of the recovered print, each with all of its runs.
std::string written(const RecoveredPrint& recovered, const GcodePrint& print, const AuditMachine& machine,
                    const Config& config, const std::vector<Layer>& layers, const std::string& header);

}  // namespace cleancolor
