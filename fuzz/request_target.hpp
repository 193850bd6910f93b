// fuzz/request_target.hpp
//
// What the fuzz target of the viewer's own parsing does with one input, also called by the test that replays seeds and
// findings: the input as a header, as a name, as a query, as a job and as a profile that is sent.
//
// An Error is a fine answer. Nobody gets in without the token, no name leads out of its folder, and a job that is
// accepted can be printed. Otherwise the target aborts.
#pragma once

#include <cstdlib>
#include <string>
#include <string_view>

#include "audit/machine_texts.hpp"
#include "base/error.hpp"
#include "model/validate.hpp"
#include "viewer/access.hpp"
#include "viewer/files.hpp"
#include "viewer/job_request.hpp"

namespace cleancolor {

inline void require(bool promise) {
  if (!promise) std::abort();
}

inline void fuzz_headers(const std::string& text) {
  const Access access{.token = "00112233445566778899aabbccddeeff", .address = "0.0.0.0", .port = 8737};
  const bool has_token = text.find(access.token) != text.npos;
  require(!access.knows_token({.host = "", .origin = "", .cookie = text, .authorization = ""}) || has_token);
  require(!access.knows_token({.host = "", .origin = "", .cookie = "", .authorization = text}) || has_token);
  require(!access.is_host(text) || text.ends_with(":8737"));
  require(text.empty() ||
          !access.is_origin({.host = "127.0.0.1:8737", .origin = text, .cookie = "", .authorization = ""}) ||
          text == "http://127.0.0.1:8737");
}

inline void fuzz_request(std::string_view input) {
  const std::string text(input);
  fuzz_headers(text);
  const std::string name = file_name(text);
  require(!name.empty() && name.size() <= 400 && name.front() != '.' && name.find_first_of("/\\\n\r") == name.npos &&
          name.find('\0') == name.npos);
  for (const auto parse : {+[](const std::string& t) { (void)nozzle_offsets_of(t, "nozzle_offset"); },
                           +[](const std::string& t) { validate(job_request(t, {}).config); },
                           +[](const std::string& t) { check_printer(t, "my.toml"); }}) {
    try {
      parse(text);
    } catch (const Error&) {
    }
  }
}

}  // namespace cleancolor
