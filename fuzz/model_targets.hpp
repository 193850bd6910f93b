// fuzz/model_targets.hpp
//
// What the fuzz targets of the model readers do with one input, also called by the test that replays seeds and
// findings.
//
// An input is read and, where a reader accepts it, checked; an Error is a fine answer. A mesh that passes the check
// must keep its promise: every edge passed as often one way as the other, a positive volume. Otherwise the target
// aborts.
#pragma once

#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "model/amf.hpp"
#include "model/check.hpp"
#include "model/edges.hpp"
#include "model/obj.hpp"
#include "model/ply.hpp"
#include "model/read.hpp"
#include "model/stl.hpp"
#include "stored_zip.hpp"

namespace cleancolor {

inline void require_promises(const Mesh& mesh) {
  const std::vector<EdgeUse> uses = edge_uses(mesh);
  for (std::size_t i = 0, n = 0; i < uses.size(); i += n) {
    n = edge_size(uses, i);
    if (edge_balance(std::span(uses).subspan(i, n)) != 0) std::abort();
  }
  if (!(volume_mm3(mesh) > 0)) std::abort();
}

template <class Reader>
void read_and_check(const Reader& reader) {
  try {
    for (Part& part : reader()) require_promises(checked(std::move(part.mesh), part.name));
  } catch (const Error&) {
  }
}

inline void fuzz_stl(std::string_view bytes) {
  read_and_check([&] { return std::vector<Part>{read_stl(bytes, "fuzz.stl")}; });
}

/// The bytes as a mesh and as a material library.
inline void fuzz_obj(std::string_view bytes) {
  read_and_check([&] { return read_obj(bytes, "fuzz.obj", read_mtl(bytes)); });
}

inline void fuzz_ply(std::string_view bytes) {
  read_and_check([&] { return std::vector<Part>{read_ply(bytes, "fuzz.ply")}; });
}

inline void fuzz_amf(std::string_view bytes) {
  read_and_check([&] { return read_amf(std::string(bytes), "fuzz.amf"); });
}

/// A zip archive; or, since random changes to one only break its checksums, the texts of the entries, with a line of
/// four dashes between them: start part, a second model part, PrusaSlicer's and Bambu Studio's config.
inline void fuzz_3mf(std::string_view bytes) {
  if (bytes.starts_with("PK")) {
    read_and_check([&] { return read_model_bytes(std::string(bytes), "fuzz.3mf"); });
    return;
  }
  std::vector<std::pair<std::string, std::string>> entries;
  for (const char* name : {"3D/3dmodel.model", "3D/Objects/a.model", "Metadata/Slic3r_PE_model.config",
                           "Metadata/model_settings.config"}) {
    const std::size_t end = bytes.find("\n----\n");
    if (const std::string_view text = bytes.substr(0, end); !text.empty()) entries.emplace_back(name, text);
    if (end == std::string_view::npos) break;
    bytes.remove_prefix(end + 6);
  }
  read_and_check([&] { return read_archive(stored_zip(entries), "fuzz.3mf"); });
}

}  // namespace cleancolor
