// viewer/job_request.hpp
//
// The body of POST /api/jobs -> what to slice.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline.hpp"
#include "viewer/own_printers.hpp"

namespace cleancolor {

constexpr std::size_t most_meshes = 256;  // that are kept, and so that a job can name

struct JobMesh {
  int id = 0;
  std::optional<int> extruder;  // 0-based; empty: as the file says, else the next one
};

struct JobRequest {
  std::vector<JobMesh> meshes;        // at least one
  std::optional<double> azimuth_deg;  // as in SliceRequest
  Config config;
};

/// Throws ApiError 400 with the field at fault: for what is no JSON, has fields or types that are not documented, names
/// a profile or option that does not exist or a value that is out of range, or options that do not go together.
JobRequest job_request(std::string_view body, const OwnPrinters& own);

}  // namespace cleancolor
