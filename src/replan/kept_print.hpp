// replan/kept_print.hpp
//
// Kept print: the G-code of a recovered print in its own order, on its own ways: the file's moves, in our words.
//
//   recovered print, its text  ->  text of the G-code, whole
#pragma once

#include <string>

#include "model/config.hpp"
#include "reader/print.hpp"
#include "replan/recovered.hpp"

namespace cleancolor {

/// Each road, way, lift and move of filament as in the file. header: our line, without its end.
std::string written_as_in_file(const RecoveredPrint& recovered, const GcodePrint& print, const Config& config,
                               const std::string& header);

}  // namespace cleancolor
