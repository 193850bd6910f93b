// viewer/status_json.hpp
//
// Prints and jobs as the API tells of them: docs/viewer-api.md.
#pragma once

#include <nlohmann/json.hpp>

#include "viewer/job_queue.hpp"
#include "viewer/print_store.hpp"

namespace cleancolor {

/// id, name and state, and the error where there is one.
nlohmann::ordered_json print_row(const PrintStatus& print);

/// And stage, progress and, from drawn on, the summary.
nlohmann::ordered_json print_json(const PrintStatus& print);

nlohmann::ordered_json job_json(const JobStatus& job);

}  // namespace cleancolor
