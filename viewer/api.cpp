#include "viewer/api.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "audit/machine_texts.hpp"
#include "base/text_parts.hpp"
#include "model/profile.hpp"
#include "model/settings.hpp"
#include "viewer/api_error.hpp"
#include "viewer/job_request.hpp"
#include "viewer/option_json.hpp"
#include "viewer/page.hpp"
#include "viewer/status_json.hpp"

namespace cleancolor {
namespace {

using Json = nlohmann::ordered_json;

Answer json_answer(const Json& json) {
  return {.body = std::make_shared<const std::string>(json.dump(-1, ' ', false, Json::error_handler_t::replace))};
}

Answer method_not_allowed(const std::string& allow) {
  Answer answer = refusal(405, "this can only be asked with " + allow);
  answer.allow = allow;
  return answer;
}

bool reads(const Asked& asked) {
  return asked.method == "GET" || asked.method == "HEAD";
}

/// For a print, or for that of a job.
ApiError no_room() {
  return {503, fmt::format("there is no room for another print ({} at most, with those of jobs to come); "
                           "forget a print first",
                           PrintStore::most_prints)};
}

ApiError nothing(std::string_view what, int id) {
  return {404, fmt::format("there is no {} {}", what, id)};
}

std::string text_of(const Query& query, const std::string& name) {
  const auto found = query.find(name);
  return found == query.end() ? "" : found->second;
}

/// 0, which nothing has, where the text is no id.
int id_of(std::string_view text) {
  int id = 0;
  return text.size() < 10 && parse_whole(text, id) && id > 0 ? id : 0;
}

}  // namespace

Answer refusal(int status, const std::string& message, const std::string& field) {
  Json error = {{"message", message}};
  if (!field.empty()) error["field"] = field;
  Answer answer = json_answer({{"error", error}});
  answer.status = status;
  return answer;
}

Api::Api(ApiOptions options)
    : options_(std::move(options)),
      option_table_(std::make_shared<const std::string>(options_json())),
      printers_(options_.printer),
      built_in_rows_(built_in_rows(options_.printer)),
      prints_(options_.threads, options_.most_kept_bytes),
      jobs_(prints_) {}

void Api::add_print(const std::filesystem::path& file) {
  if (!prints_.add({.name = file.filename().string(),
                    .file = std::make_shared<StoredFile>(file, /*owned=*/false),
                    .machine = options_.machine}))
    throw Error(fmt::format("{}: too many files; at most {}", file.string(), PrintStore::most_prints));
}

void Api::add_mesh(const std::filesystem::path& file) {
  std::error_code fault;
  const auto bytes = std::filesystem::file_size(file, fault);
  if (fault) throw SystemError(fmt::format("{}: {}", file.string(), fault.message()));
  keep_mesh({file.filename().string(), bytes, std::make_shared<StoredFile>(file, /*owned=*/false)});
}

std::optional<BodyRule> Api::body_rule(const std::string& method, const std::string& path) const {
  if (method != "POST") return std::nullopt;
  if (path == "/api/prints") return BodyRule{options_.most_gcode_bytes, true};
  if (path == "/api/meshes") return BodyRule{options_.most_mesh_bytes, true};
  if (path == "/api/jobs") return BodyRule{options_.most_json_bytes, false};
  if (path == "/api/profiles") return BodyRule{options_.most_profile_bytes, false};
  return std::nullopt;
}

FileHandle Api::new_upload(const Asked& asked) {
  if (asked.path == "/api/prints") {
    machine_of(asked.query);
    if (!prints_.room()) throw no_room();
  }
  return folder_.new_file(file_name(text_of(asked.query, "name")));
}

Answer Api::answer(const Asked& asked) {
  try {
    return routed(asked);
  } catch (const ApiError& e) {
    return refusal(e.status(), e.what(), e.field());
  } catch (const std::exception& e) {
    return refusal(500, e.what());
  }
}

Answer Api::routed(const Asked& asked) {
  const std::vector<std::string_view> parts = split(asked.path, '/');  // the first is empty
  if (parts.size() < 3 || parts[1] != "api") return page(asked);
  const std::string_view kind = parts[2];
  const int id = parts.size() > 3 ? id_of(parts[3]) : 0;
  if (parts.size() == 3) {
    if (kind == "prints") return prints(asked);
    if (kind == "meshes") return meshes(asked);
    if (kind == "jobs") return jobs(asked);
    if (kind == "profiles") return profiles(asked);
    if (kind == "options") return reads(asked) ? Answer{.body = option_table_} : method_not_allowed("GET");
  } else if (parts.size() == 4) {
    if (kind == "prints") return print(asked, id, "");
    if (kind == "meshes") return mesh(asked, id);
    if (kind == "jobs") return job(asked, id);
    if (kind == "profiles") return profile(asked, std::string(parts[3]));
  } else if (parts.size() == 5 && kind == "prints") {
    return print(asked, id, std::string(parts[4]));
  }
  throw ApiError(404, "there is no such address");
}

Answer Api::page(const Asked& asked) const {
  const std::string_view path = asked.path == "/" ? std::string_view("/index.html") : asked.path;
  for (const PageFile& file : page_files()) {
    if (file.path != path) continue;
    if (!reads(asked)) return method_not_allowed("GET");
    return {.type = std::string(content_type(path)), .page = file.bytes};
  }
  throw ApiError(404, "there is no such address");
}

/// What the query says of the printer counts more than the command line.
MachineRequest Api::machine_of(const Query& query) const {
  MachineRequest machine = options_.machine;
  const auto take = [&](const char* field, const auto& action) {
    const std::string text = text_of(query, field);
    if (text.empty()) return;
    try {
      action(text);
    } catch (const Error& e) {
      throw ApiError(400, e.what(), field);
    }
  };
  take("printer", [&](const std::string& name) {
    if (name == options_.printer) return;
    const OwnPrinterHandle own = printers_.find(name);
    if (!own && !is_built_in(OptionGroup::printer, name)) throw Error(fmt::format("printer: there is no '{}'", name));
    machine.printer = own ? config_of(own->profile, {}) : config_of({.printer = name});
    machine.nozzle_offset_mm = {};
  });
  take("nozzle_offset",
       [&](const std::string& text) { machine.nozzle_offset_mm = nozzle_offsets_of(text, "nozzle_offset"); });
  take("offsets_in", [&](const std::string& text) { machine.offsets_in = offsets_in_of(text, "offsets_in"); });
  take("idle_nozzle", [&](const std::string& text) { machine.idle_nozzle = idle_nozzle_of(text, "idle_nozzle"); });
  return machine;
}

Answer Api::prints(const Asked& asked) {
  if (reads(asked)) {
    Json rows = Json::array();
    for (const PrintStatus& print : prints_.list()) rows.push_back(print_row(print));
    return json_answer(rows);
  }
  if (asked.method != "POST") return method_not_allowed("GET, POST");
  const auto id = prints_.add(
      {.name = asked.upload->path().filename().string(), .file = asked.upload, .machine = machine_of(asked.query)});
  if (!id) throw no_room();
  return json_answer({{"id", *id}});
}

Answer Api::print(const Asked& asked, int id, const std::string& part) {
  const auto found = prints_.find(id);
  if (!found) throw nothing("print", id);
  const PrintStatus& print = *found;
  if (part.empty() && asked.method == "DELETE") {
    prints_.forget(id);
    return json_answer(Json::object());
  }
  const auto ready = [&](const Bytes& bytes, const std::string& type) -> Answer {
    if (!bytes)
      throw ApiError(409, print.error.empty() ? "the print is still being read; ask again later" : print.error);
    return {.type = type, .body = bytes};
  };
  if (!part.empty() && part != "moves" && part != "audit" && part != "audit.json" && part != "gcode")
    throw ApiError(404, "there is no such address");
  if (!reads(asked)) return method_not_allowed(part.empty() ? "GET, DELETE" : "GET");
  if (part == "moves") return ready(print.moves, "application/octet-stream");
  if (part == "audit") return ready(print.audit, "application/octet-stream");
  if (part == "audit.json") return ready(print.audit_json, "application/json");
  if (part == "gcode") return {.type = "text/x.gcode", .file = print.file, .file_name = print.name};
  return json_answer(print_json(print));
}

int Api::keep_mesh(Mesh mesh) {
  const std::lock_guard lock(mutex_);
  if (meshes_.size() >= most_meshes)
    throw ApiError(503, fmt::format("there are {} meshes already; forget one", most_meshes));
  meshes_[++last_mesh_] = std::move(mesh);
  return last_mesh_;
}

Answer Api::meshes(const Asked& asked) {
  const auto row = [](int id, const Mesh& mesh) {
    return Json{{"id", id}, {"name", mesh.name}, {"bytes", mesh.bytes}};
  };
  if (reads(asked)) {
    const std::lock_guard lock(mutex_);
    Json rows = Json::array();
    for (const auto& [id, mesh] : meshes_) rows.push_back(row(id, mesh));
    return json_answer(rows);
  }
  if (asked.method != "POST") return method_not_allowed("GET, POST");
  const std::filesystem::path& path = asked.upload->path();
  const Mesh mesh{path.filename().string(), std::filesystem::file_size(path), asked.upload};
  return json_answer(row(keep_mesh(mesh), mesh));
}

Answer Api::mesh(const Asked& asked, int id) {
  if (asked.method != "DELETE") return method_not_allowed("DELETE");
  const std::lock_guard lock(mutex_);
  if (meshes_.erase(id) == 0) throw nothing("mesh", id);
  return json_answer(Json::object());
}

Answer Api::profiles(const Asked& asked) {
  if (reads(asked)) {
    std::string rows = "[";
    for (const OwnPrinterHandle& printer : printers_.all()) rows += printer->row + ",";
    return {.body = std::make_shared<const std::string>(rows + built_in_rows_ + "]")};
  }
  if (asked.method != "POST") return method_not_allowed("GET, POST");
  const std::string name = file_name(text_of(asked.query, "name"));
  printers_.keep(name, asked.body);
  return json_answer({{"name", name}});
}

Answer Api::profile(const Asked& asked, const std::string& name) {
  if (asked.method != "DELETE") return method_not_allowed("DELETE");
  if (!printers_.forget(name)) throw ApiError(404, fmt::format("no printer '{}' was sent here", name));
  return json_answer(Json::object());
}

Job Api::new_job(const std::string& body) {
  const JobRequest asked = job_request(body, printers_);
  Job job;
  {
    const std::lock_guard lock(mutex_);
    for (const JobMesh& mesh : asked.meshes) {
      const auto found = meshes_.find(mesh.id);
      if (found == meshes_.end()) throw ApiError(400, fmt::format("there is no mesh {}", mesh.id), "meshes");
      job.request.files.push_back({found->second.file->path(), mesh.extruder});
      job.meshes.push_back(found->second.file);
    }
  }
  job.name = file_name(job.request.files.front().path.stem().string() + ".gcode");
  job.output = folder_.new_file(job.name);
  job.request.config = asked.config;
  job.request.azimuth_deg = asked.azimuth_deg;
  job.request.output = job.output->path();
  job.request.threads = options_.threads;
  return job;
}

Answer Api::jobs(const Asked& asked) {
  if (reads(asked)) {
    Json rows = Json::array();
    for (const JobStatus& job : jobs_.list()) rows.push_back(job_json(job));
    return json_answer(rows);
  }
  if (asked.method != "POST") return method_not_allowed("GET, POST");
  Job job = new_job(asked.body);
  PrintStore::Room room = prints_.room();
  if (!room) throw no_room();
  const auto id = jobs_.add(std::move(job), std::move(room));
  if (!id) throw ApiError(503, fmt::format("{} jobs wait already; try again later", JobQueue::most_waiting));
  return json_answer({{"id", *id}});
}

Answer Api::job(const Asked& asked, int id) {
  if (asked.method == "DELETE") {
    if (!jobs_.remove(id)) throw nothing("job", id);
    return json_answer(Json::object());
  }
  const auto found = jobs_.find(id);
  if (!found) throw nothing("job", id);
  if (!reads(asked)) return method_not_allowed("GET, DELETE");
  return json_answer(job_json(*found));
}

}  // namespace cleancolor
