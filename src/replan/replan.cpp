#include "replan/replan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "audit/timeline.hpp"
#include "base/error.hpp"
#include "model/text_scan.hpp"
#include "reader/read.hpp"
#include "replan/cura.hpp"
#include "replan/dialect_words.hpp"
#include "replan/found_roles.hpp"
#include "replan/heaters.hpp"
#include "replan/planning.hpp"
#include "replan/recovered.hpp"
#include "replan/removed.hpp"
#include "replan/same_print.hpp"
#include "replan/written.hpp"

namespace cleancolor {
namespace {

constexpr std::string_view mark = "; replanned by cleancolor ";
constexpr std::size_t head_bytes = 4096;

std::string_view producer_of(const GcodePrint& print) {
  return print.facts.producer.empty() ? std::string_view("an unknown slicer") : print.facts.producer;
}

void require_known_dialect(const GcodePrint& print) {
  if (words_of(print.facts.dialect) != nullptr) return;
  if (print.facts.dialect == Dialect::cleancolor)
    throw Error(fmt::format("{}: cleancolor made it, so it is planned already", print.name));
  throw Error(fmt::format("{}: made by {}; only files of PrusaSlicer, Slic3r and Cura are re-planned so far",
                          print.name, producer_of(print)));
}

std::string header_line(const ReplanRequest& request, bool has_rampart) {
  const char* what = request.keeps_order                            ? "order and travel kept"
                     : request.protection != ReplanProtection::full ? "order and travel plain"
                                                                    : "order and travel planned";
  return fmt::format("{}{}: {}{}; paths and settings as sliced", mark, CLEANCOLOR_VERSION, what,
                     has_rampart ? ", rampart added" : "");
}

std::string duration_text(double seconds) {
  const long all = std::lround(seconds);
  const long d = all / 86400, h = all / 3600 % 24, m = all / 60 % 60, s = all % 60;
  std::string text;
  if (d > 0) text += fmt::format("{}d ", d);
  if (d > 0 || h > 0) text += fmt::format("{}h ", h);
  if (all >= 60) text += fmt::format("{}m ", m);
  return text + fmt::format("{}s", s);
}

/// Cura: whole seconds in the head; its engine alone writes the same number each time.
void correct_cura_head(std::string& text, double share) {
  constexpr std::string_view placeholder = "6666";
  for (const std::string_view tag : {";TIME:", ";PRINT.TIME:"}) {
    const std::size_t at = text.substr(0, head_bytes).find(tag);
    if (at == text.npos) continue;
    const std::size_t begin = at + tag.size(), end = std::min(text.find('\n', begin), text.size());
    const auto told_s = number<double>(std::string_view(text).substr(begin, end - begin));
    if (!told_s || text.compare(begin, end - begin, placeholder) == 0) continue;
    text.replace(begin, end - begin, fmt::format("{}", std::lround(*told_s * share)));
  }
}

/// The slicer's own estimates, longer by as much as the print is.
void correct_estimates(std::string& text, double told_s, double share) {
  constexpr std::array<std::string_view, 2> tags = {"\n; estimated printing time (normal mode) = ",
                                                    "\n; estimated printing time (silent mode) = "};
  if (told_s <= 0) return;
  for (const std::string_view tag : tags) {
    const std::size_t at = text.rfind(tag);
    if (at == text.npos) continue;
    const std::size_t begin = at + tag.size(), end = std::min(text.find('\n', begin), text.size());
    text.replace(begin, end - begin, duration_text(told_s * share));
  }
}

/// Lines "M73 P.. R.." and ";TIME_ELAPSED:.." anew: percent and, where they tell them, minutes and seconds as the print
/// goes now.
std::string with_progress(const GcodePrint& after, const Timeline& time, double share) {
  const std::string_view elapsed = words_of(after.facts.dialect)->elapsed;
  const std::string_view text = *after.text;
  std::string result;
  result.reserve(text.size());
  double done_s = 0;
  std::size_t move = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    const bool tells_elapsed = !elapsed.empty() && line.starts_with(elapsed);
    if (tells_elapsed || line.starts_with("M73 P"))
      for (; move < after.moves.size() && after.moves[move].offset < at; ++move) done_s += time.duration_s[move];
    if (tells_elapsed) {
      result += fmt::format("{}{:.6f}", elapsed, done_s * share);
    } else if (line.starts_with("M73 P")) {
      const double left_s = std::max(0., time.print_time_s - done_s);
      const bool ends = move == after.moves.size() || left_s < 1;
      result += fmt::format("M73 P{}", ends ? 100 : std::min(99, int(100 * done_s / time.print_time_s)));
      if (line.find(" R") != line.npos) result += fmt::format(" R{}", ends ? 0 : std::lround(left_s * share / 60));
    } else {
      result += line;
    }
    if (end < text.size()) result += '\n';
    at = end + 1;
  }
  return result;
}

}  // namespace

Replanned replanned(const GcodePrint& print, const AuditMachine& machine, const ReplanRequest& request,
                    const Progress& progress) {
  Replanned result;
  if (std::string_view(*print.text).substr(0, head_bytes).find(mark) != std::string_view::npos) {
    result.text = *print.text;
    result.changed = false;
    return result;
  }
  require_known_dialect(print);
  const bool finds_roles = print.facts.dialect == Dialect::slic3r && !tells_roles(print);
  if (finds_roles && request.removes_shield)
    throw Error(fmt::format("{}: it does not say which roads are a shield; slice without it", print.name));
  Config config = planning_config(print, machine, request.printer ? &*request.printer : nullptr);
  if (request.protection == ReplanProtection::none || request.keeps_order) config.rampart = RampartShape::off;
  if (request.protection != ReplanProtection::full) config.planner = Planner::plain;
  const GcodePrint with_roles = finds_roles ? with_found_roles(print, machine) : GcodePrint{};
  const GcodePrint& source = finds_roles ? with_roles : print;
  RecoveredPrint recovered = recovered_print(source);
  RemovedFilament removed;
  if (request.removes_shield) removed = remove_shield(recovered, source);
  if (request.removes_tower) removed.merge(remove_tower(recovered, source));
  for (const auto& [what, mm] : removed) result.removed_mm3 += mm * filament_area_mm2(machine, what.first);
  const std::vector<Layer> layers = planned_layers(
      recovered, source, machine, config, {.plans = !request.keeps_order, .threads = request.threads}, progress);
  const auto is_ours = [](const Path& path) { return path.source < 0; };
  const bool has_rampart =
      std::ranges::any_of(layers, [&](const Layer& layer) { return std::ranges::any_of(layer.paths, is_ours); });
  if (print.facts.dialect == Dialect::cura && !request.printer && has_rampart)
    progress.warn(
        fmt::format("{}: the file does not say how large the bed is; {:g} mm around the print are taken to be free for "
                    "the rampart: name the printer (--printer) to be sure",
                    print.name, cura_free_mm));
  progress.advance("writing", 0);
  result.text = written(recovered, source, machine, config, layers,
                        {.as_in_file = request.keeps_order, .header = header_line(request, has_rampart)});
  GcodePrint after = read_gcode(result.text, print.name);
  const DialectWords& words = *words_of(print.facts.dialect);
  if (words.times_heaters && sets_temperatures(recovered, print)) {
    result.text = with_heaters(recovered, print, after, machine, words.layer_begins.front());
    after = read_gcode(result.text, print.name);
  }
  if (const auto what = difference(print, after, machine, removed))
    throw Error(
        fmt::format("{}: re-planned it would not be the same print: {}; the file is left as it is. Please "
                    "report it",
                    print.name, *what));
  result.old_time_s = timeline(print, machine).print_time_s;
  const Timeline time = timeline(after, machine);
  result.time_s = time.print_time_s;
  if (result.old_time_s <= 0) return result;
  const double told_share = print.facts.told_time_s > 0 ? print.facts.told_time_s / result.old_time_s : 1;
  if (!recovered.progress_line.empty() || recovered.elapsed_lines > 0)
    result.text = with_progress(after, time, told_share);
  const double longer = result.time_s / result.old_time_s;
  correct_estimates(result.text, print.facts.told_time_s, longer);
  if (print.facts.dialect == Dialect::cura) correct_cura_head(result.text, longer);
  return result;
}

}  // namespace cleancolor
