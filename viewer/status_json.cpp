#include "viewer/status_json.hpp"

#include <array>

#include "summary_json.hpp"

namespace cleancolor {
namespace {

using Json = nlohmann::ordered_json;

// In the order of the states.
constexpr std::array<const char*, 4> print_states = {"reading", "drawn", "audited", "failed"};
constexpr std::array<const char*, 5> job_states = {"queued", "running", "done", "failed", "cancelled"};

}  // namespace

Json print_row(const PrintStatus& print) {
  Json json = {{"id", print.id}, {"name", print.name}, {"state", print_states[std::size_t(print.state)]}};
  if (!print.error.empty()) json["error"] = print.error;
  return json;
}

Json print_json(const PrintStatus& print) {
  Json json = print_row(print);
  json["stage"] = print.stage;
  json["progress"] = print.progress;
  if (print.summary) json["summary"] = Json::parse(*print.summary);
  return json;
}

Json job_json(const JobStatus& job) {
  Json json = {{"id", job.id},
               {"name", job.name},
               {"state", job_states[std::size_t(job.state)]},
               {"position", job.position},
               {"stage", job.stage},
               {"progress", job.progress},
               {"warnings", job.warnings}};
  if (!job.error.empty()) json["error"] = job.error;
  if (job.print) json["print"] = *job.print;
  if (job.summary) json["summary"] = summary_fields(*job.summary);
  return json;
}

}  // namespace cleancolor
