// viewer/api.hpp
//
// The API without the network: a request as plain values -> an answer. docs/viewer-api.md is its manual.
//
// Whether somebody may ask is settled before (viewer/access.hpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "viewer/files.hpp"
#include "viewer/job_queue.hpp"
#include "viewer/own_printers.hpp"
#include "viewer/print_store.hpp"

namespace cleancolor {

struct ApiOptions {
  MachineRequest machine = {};  // of G-code that is looked at, where nothing else is said
  std::string printer = "";     // of the command line: a name, or a file, which jobs may then name, too
  int threads = 0;
  std::uint64_t most_gcode_bytes = 1'000'000'000;
  std::uint64_t most_mesh_bytes = 256'000'000;
  std::uint64_t most_json_bytes = 1'000'000;
  std::uint64_t most_profile_bytes = 64'000;
  std::size_t most_kept_bytes = 4'000'000'000;  // of prints, ready to be sent
};

using Query = std::multimap<std::string, std::string>;

struct Asked {
  std::string method;  // "GET", "POST" ...
  std::string path;    // decoded, without the query
  Query query = {};
  std::string body = "";   // of POST, where it is no upload
  FileHandle upload = {};  // else
};

struct Answer {
  int status = 200;
  std::string type = "application/json";
  Bytes body = {};             // nullptr: what file holds
  std::string_view page = {};  // or a file of the page
  FileHandle file = {};        // sent as a download
  std::string file_name = "";  // under this name
  std::string allow = "";      // of 405
};

/// What a POST's body may be.
struct BodyRule {
  std::uint64_t most_bytes = 0;
  bool upload = false;  // goes to a file
};

class Api {
 public:
  /// Throws Error where the printer's profile cannot be used, SystemError where no files can be kept.
  explicit Api(ApiOptions options);

  /// Never throws what a request can cause: that becomes an answer of 400 and above.
  Answer answer(const Asked& asked);

  /// Nothing where no body is taken here; then answer() says why.
  std::optional<BodyRule> body_rule(const std::string& method, const std::string& path) const;

  /// Where an upload goes.  Throws ApiError where it would be refused anyway, before anybody sends it.
  FileHandle new_upload(const Asked& asked);

  /// Files that the user named; they stay where they are. Throws Error where there are too many.
  void add_print(const std::filesystem::path& file);
  void add_mesh(const std::filesystem::path& file);

  const std::filesystem::path& temporary() const { return folder_.path(); }

 private:
  struct Mesh {
    std::string name;
    std::uint64_t bytes = 0;
    FileHandle file;
  };

  Answer routed(const Asked& asked);
  Answer prints(const Asked& asked);
  Answer print(const Asked& asked, int id, const std::string& part);
  Answer meshes(const Asked& asked);
  Answer mesh(const Asked& asked, int id);
  Answer profiles(const Asked& asked);
  Answer profile(const Asked& asked, const std::string& name);
  Answer jobs(const Asked& asked);
  Answer job(const Asked& asked, int id);
  Answer page(const Asked& asked) const;
  MachineRequest machine_of(const Query& query) const;
  int keep_mesh(Mesh mesh);
  Job new_job(const std::string& body);

  ApiOptions options_;
  Bytes option_table_;
  OwnPrinters printers_;
  std::string built_in_rows_;  // of the list of profiles
  TempFolder folder_;
  std::mutex mutex_;
  std::map<int, Mesh> meshes_;  // guarded
  int last_mesh_ = 0;
  PrintStore prints_;
  JobQueue jobs_;  // gives to the prints, so it ends first
};

/// {"error": {"message", "field"}}
Answer refusal(int status, const std::string& message, const std::string& field = "");

}  // namespace cleancolor
