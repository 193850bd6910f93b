// cli/report.hpp
//
// The summary of a print, for people and for programs.
#pragma once

#include <string>
#include <vector>

#include "pipeline.hpp"

namespace cleancolor {

/// Layers, tool changes, time, and one row for each extruder that was used.
std::string summary_table(const Summary& summary, const SliceRequest& request);

/// One JSON object and a new line; its fields are documented in `cleancolor slice --help`.
std::string summary_json(const Summary& summary, const SliceRequest& request, const std::vector<std::string>& warnings);

/// What 'cleancolor azimuth' prints: no turn, the best one, and that of least interference.
std::string azimuth_table(const Azimuths& azimuths);
std::string azimuth_json(const Azimuths& azimuths);

}  // namespace cleancolor
