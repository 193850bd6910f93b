// summary_json.hpp
//
// What a slicing run tells of itself, as JSON fields that the command line and the viewer share.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline.hpp"

namespace cleancolor {

/// {"layers", "tool_changes", "time_s", "extruders": [...], "azimuth_deg", "rampart_g"}: `cleancolor slice --help`.
nlohmann::ordered_json summary_fields(const Summary& summary);

/// {"chosen_deg", "best_deg", ..., the curves "exposure_s", "interference_mm3", "fits"}: `cleancolor azimuth --help`.
nlohmann::ordered_json azimuth_fields(const Azimuths& azimuths);

}  // namespace cleancolor
