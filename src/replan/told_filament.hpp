// replan/told_filament.hpp
//
// Told filament: what a file says of how much filament each tool takes, told anew.
//
//   "; filament used [g] = 4.65, 4.61", 1.1 and 1.2 times as much  ->  "; filament used [g] = 5.12, 5.53"
#pragma once

#include <string>
#include <vector>

#include "reader/print.hpp"

namespace cleancolor {

/// Filament of each tool, mm, without what is drawn back; 0: none.
std::vector<double> filament_of_tools_mm(const GcodePrint& print);

/// Lines "filament used", "filament cost" and their totals, of PrusaSlicer and Slic3r, and what the heads of Cura's
/// and BambuStudio's files say: each figure by as much more as its tool takes now. Lines that do not tell one figure
/// for each tool stay, and so do the totals that then cannot be known. Requires: the same tools print in both.
void correct_filament(std::string& text, const GcodePrint& before, const GcodePrint& after);

}  // namespace cleancolor
