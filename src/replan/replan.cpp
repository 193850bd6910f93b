#include "replan/replan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "audit/timeline.hpp"
#include "base/error.hpp"
#include "reader/read.hpp"
#include "replan/attempts.hpp"
#include "replan/cura.hpp"
#include "replan/dialect_words.hpp"
#include "replan/file_parts.hpp"
#include "replan/times.hpp"
#include "replan/told_filament.hpp"

namespace cleancolor {
namespace {

std::string_view producer_of(const GcodePrint& print) {
  return print.facts.producer.empty() ? std::string_view("an unknown slicer") : print.facts.producer;
}

void require_known_dialect(const GcodePrint& print) {
  if (words_of(print) != nullptr) return;
  if (print.facts.dialect == Dialect::cleancolor)
    throw Error(fmt::format("{}: cleancolor made it, so it is planned already", print.name));
  throw Error(
      fmt::format("{}: made by {}; only files of PrusaSlicer, SuperSlicer, Slic3r, "
                  "OrcaSlicer, BambuStudio and Cura are re-planned so far",
                  print.name, producer_of(print)));
}

/// A file that was cut off has no code that switches the heaters off.
void require_whole(const GcodePrint& print) {
  const std::string_view text = *print.text;
  const std::size_t last = text.rfind('\n') + 1;
  const bool half_a_line = last < text.size() && text[last] != ';';
  const std::string_view elapsed = words_of(print)->elapsed;
  const std::size_t told = elapsed.empty() ? text.npos : text.rfind(elapsed), layer = text.rfind("\n;LAYER:");
  const bool half_a_layer = told != text.npos && layer != text.npos && told < layer;
  if (half_a_line || half_a_layer)
    throw Error(fmt::format("{}: it ends in the middle of a {}: it was cut off; export it again", print.name,
                            half_a_line ? "line" : "layer"));
}

Replanned unchanged(const GcodePrint& print, std::string reason) {
  return {.text = *print.text, .changed = false, .reason = std::move(reason)};
}

/// Whether all of its lines end with CR and LF, as Windows has them.
bool has_windows_line_ends(std::string_view text) {
  std::ptrdiff_t ends = 0;
  for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1), ++ends)
    if (at == 0 || text[at - 1] != '\r') return false;
  return ends > 0 && std::ranges::count(text, '\r') == ends;
}

std::string with_windows_line_ends(std::string_view text) {
  std::string ended;
  ended.reserve(text.size() + text.size() / 16);
  for (const char c : text) {
    if (c == '\n') ended += '\r';
    ended += c;
  }
  return ended;
}

Replanned with_plain_line_ends(const GcodePrint& print, const AuditMachine& machine, const ReplanRequest& request,
                               const Progress& progress) {
  std::string text = *print.text;
  std::erase(text, '\r');
  Replanned result = replanned(read_gcode(std::move(text), print.name), machine, request, progress);
  result.text = with_windows_line_ends(result.text);
  return result;
}

}  // namespace

Replanned replanned(const GcodePrint& print, const AuditMachine& machine, const ReplanRequest& request,
                    const Progress& progress) {
  if (has_windows_line_ends(*print.text)) return with_plain_line_ends(print, machine, request, progress);
  if (std::string_view(*print.text).substr(0, head_bytes).find(replanned_mark) != std::string_view::npos)
    return unchanged(print, "it was re-planned before");
  require_known_dialect(print);
  require_whole(print);
  const Attempts attempts(print, machine, request, progress);
  const bool judges = request.protection == ReplanProtection::full && !request.keeps_order;
  std::optional<Attempt> made = judges                ? attempts.best()
                                : request.keeps_order ? attempts.kept()
                                                      : attempts.with(RampartExtent::all);
  if (!made)
    return unchanged(print, "re-planned it would come out no cleaner than the time is worth" + attempts.advice());
  if (print.facts.dialect == Dialect::cura && !request.printer && made->has_rampart)
    progress.warn(
        fmt::format("{}: the file does not say how large the bed is; {:g} mm around the print are taken to be free for "
                    "the rampart: name the printer (--printer) to be sure",
                    print.name, cura_free_mm));
  Replanned result;
  result.has_rampart = made->has_rampart;
  if (judges) result.gain = Gain{made->before, made->cleanness};
  result.removed_mm3 = attempts.removed_mm3();
  result.old_time_s = judges ? made->before.time_s : timeline(print, machine).print_time_s;
  const Timeline time = timeline(made->print, machine);
  result.time_s = time.print_time_s;
  const double told_share =
      print.facts.told_time_s > 0 && result.old_time_s > 0 ? print.facts.told_time_s / result.old_time_s : 1;
  result.text = attempts.tells_progress() ? with_progress(made->print, time, told_share) : *made->print.text;
  for (const double mm : filament_of_tools_mm(print)) result.old_filament_mm += mm;
  for (const double mm : filament_of_tools_mm(made->print)) result.filament_mm += mm;
  if (!request.keeps_order) correct_filament(result.text, print, made->print);
  if (result.old_time_s > 0) correct_estimates(result.text, print, result.time_s / result.old_time_s);
  return result;
}

}  // namespace cleancolor
