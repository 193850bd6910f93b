// replan/times.hpp
//
// Times: what a file says of how long it prints, told anew.
#pragma once

#include <string>

#include "audit/timeline.hpp"
#include "reader/print.hpp"

namespace cleancolor {

/// Lines "M73 P.. R..", "M73 Q.. S.." and ";TIME_ELAPSED:.." of `after` anew: percent and, where they tell them,
/// minutes and seconds as the print goes now. share: of the slicer's own estimate in ours.
std::string with_progress(const GcodePrint& after, const Timeline& time, double share);

/// The estimates in head and end of the file, longer by that factor.
void correct_estimates(std::string& text, const GcodePrint& before, double longer);

}  // namespace cleancolor
