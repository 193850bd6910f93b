// viewer/report_scene.hpp
//
// The report's scene: prints drawn by the page's own code, with their arrays in the report's file.
//
//   audited files  ->  the page's script and style, and for each print its summary, moves and audit
//
// For print N the scripts hold, as viewer/page/src/data/embedded.ts reads them, "cleancolor-N-summary" (JSON),
// "cleancolor-N-moves" and "cleancolor-N-audit": the bytes that the server answers (docs/viewer-api.md), in zlib's
// format and base64.
#pragma once

#include <cstddef>
#include <span>

#include "audit/report.hpp"
#include "viewer/page.hpp"

namespace cleancolor {

/// Of the scenario that stands first (worst). Empty where the program was built without the page; where the files
/// have more moves than most_moves together, a sentence alone says so.
///
/// printer: nullptr where it is not known.  Cost: about 3 us of CPU and 28 bytes of the report a move.
ReportScene report_scene(std::span<const AuditedFile> files, const Config* printer, int threads = 0,
                         std::size_t most_moves = 3'000'000, std::span<const PageFile> page = page_files());

}  // namespace cleancolor
