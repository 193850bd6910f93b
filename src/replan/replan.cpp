#include "replan/replan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "audit/timeline.hpp"
#include "base/error.hpp"
#include "reader/read.hpp"
#include "replan/planning.hpp"
#include "replan/recovered.hpp"
#include "replan/same_print.hpp"
#include "replan/worth.hpp"
#include "replan/written.hpp"

namespace cleancolor {
namespace {

constexpr std::string_view mark = "; replanned by cleancolor ";
constexpr std::size_t head_bytes = 4096;

std::string_view producer_of(const GcodePrint& print) {
  return print.facts.producer.empty() ? std::string_view("an unknown slicer") : print.facts.producer;
}

void require_known_dialect(const GcodePrint& print) {
  if (print.facts.dialect == Dialect::prusaslicer) return;
  if (print.facts.dialect == Dialect::cleancolor)
    throw Error(fmt::format("{}: cleancolor made it, so it is planned already", print.name));
  throw Error(
      fmt::format("{}: made by {}; only files of PrusaSlicer are re-planned so far", print.name, producer_of(print)));
}

std::string header_line(const ReplanRequest& request, bool has_rampart) {
  std::string what = request.keeps_order ? "order and travel kept" : "order and travel ";
  if (!request.keeps_order) {
    what += request.protection == ReplanProtection::full ? "planned" : "plain";
    what += has_rampart ? ", rampart added" : ", no rampart";
  }
  return fmt::format("{}{}: {}; paths and settings as sliced", mark, CLEANCOLOR_VERSION, what);
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

/// Lines "M73 P.. R.." anew: percent and minutes as the print goes now.
std::string with_progress(const GcodePrint& after, const Timeline& time, double share) {
  const std::string_view text = *after.text;
  std::string result;
  result.reserve(text.size());
  double done_s = 0;
  std::size_t move = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    if (line.starts_with("M73 P")) {
      for (; move < after.moves.size() && after.moves[move].offset < at; ++move) done_s += time.duration_s[move];
      const double left_s = std::max(0., time.print_time_s - done_s);
      const bool ends = move == after.moves.size() || left_s < 1;
      result += fmt::format("M73 P{} R{}", ends ? 100 : std::min(99, int(100 * done_s / time.print_time_s)),
                            ends ? 0 : std::lround(left_s * share / 60));
    } else {
      result += line;
    }
    if (end < text.size()) result += '\n';
    at = end + 1;
  }
  return result;
}

/// The print as one plan makes it.
struct Attempt {
  std::string text;
  GcodePrint print;
  bool has_rampart = false, stands_apart = false;
  Cleanness cleanness = {};
};

class Attempts {
 public:
  Attempts(const GcodePrint& print, const AuditMachine& machine, const ReplanRequest& request, const Progress& progress)
      : print_(print),
        machine_(machine),
        request_(request),
        progress_(progress),
        config_(planning_config(print, machine, request.printer ? &*request.printer : nullptr)),
        recovered_(recovered_print(print)) {
    if (request.protection == ReplanProtection::none || request.keeps_order) config_.rampart = RampartShape::off;
    if (request.protection != ReplanProtection::full) config_.planner = Planner::plain;
  }

  Attempt with(RampartExtent extent) const {
    ReplannedLayers planned =
        planned_layers(recovered_, print_, machine_, config_,
                       {.plans = !request_.keeps_order, .rampart = extent, .threads = request_.threads}, progress_);
    progress_.advance("writing", 0);
    Attempt made{
        .text = written(recovered_, print_, machine_, config_, planned.layers,
                        {.as_in_file = request_.keeps_order, .header = header_line(request_, planned.has_rampart)}),
        .print = {},
        .has_rampart = planned.has_rampart,
        .stands_apart = planned.stands_apart};
    made.print = read_gcode(made.text, print_.name);
    if (const auto what = difference(print_, made.print, machine_))
      throw Error(
          fmt::format("{}: re-planned it would not be the same print: {}; the file is left as it is. Please "
                      "report it",
                      print_.name, *what));
    return made;
  }

  /// The one that costs least; nothing where the file itself does.
  std::optional<Attempt> best() const {
    Attempt best = with(RampartExtent::all);
    const Cleanness before = judged(print_);
    best.cleanness = judged(best.print);
    const std::vector<RampartExtent> others =
        best.has_rampart ? worth_trying(best.cleanness, before, config_) : std::vector<RampartExtent>{};
    const bool had_rampart = best.has_rampart, stands_apart = best.stands_apart;
    for (const RampartExtent extent : others) {
      if (extent == RampartExtent::column && !stands_apart) continue;
      Attempt other = with(extent);
      other.cleanness = judged(other.print);
      if (print_cost(other.cleanness, before, config_) < print_cost(best.cleanness, before, config_))
        best = std::move(other);
    }
    if (had_rampart && !best.has_rampart)
      progress_.warn(fmt::format("{}: a rampart would take more time than it is worth; it is re-planned without one",
                                 print_.name));
    if (!is_worth_it(best.cleanness, before, config_)) return std::nullopt;
    return best;
  }

  bool tells_progress() const { return recovered_.progress_lines > 0; }

 private:
  Cleanness judged(const GcodePrint& print) const { return cleanness(print, machine_, request_.threads, progress_); }

  const GcodePrint& print_;
  const AuditMachine& machine_;
  const ReplanRequest& request_;
  const Progress& progress_;
  Config config_;
  RecoveredPrint recovered_;
};

Replanned unchanged(const GcodePrint& print, std::string reason) {
  return {.text = *print.text, .changed = false, .reason = std::move(reason)};
}

}  // namespace

Replanned replanned(const GcodePrint& print, const AuditMachine& machine, const ReplanRequest& request,
                    const Progress& progress) {
  if (std::string_view(*print.text).substr(0, head_bytes).find(mark) != std::string_view::npos)
    return unchanged(print, "it was re-planned before");
  require_known_dialect(print);
  const Attempts attempts(print, machine, request, progress);
  const bool judges = request.protection == ReplanProtection::full && !request.keeps_order;
  std::optional<Attempt> made = judges ? attempts.best() : attempts.with(RampartExtent::all);
  if (!made) return unchanged(print, "re-planned it would come out no cleaner than the time is worth");
  Replanned result;
  result.text = std::move(made->text);
  result.has_rampart = made->has_rampart;
  result.old_time_s = timeline(print, machine).print_time_s;
  const Timeline time = timeline(made->print, machine);
  result.time_s = time.print_time_s;
  if (result.old_time_s <= 0) return result;
  const double told_share = print.facts.told_time_s > 0 ? print.facts.told_time_s / result.old_time_s : 1;
  if (attempts.tells_progress()) result.text = with_progress(made->print, time, told_share);
  correct_estimates(result.text, print.facts.told_time_s, result.time_s / result.old_time_s);
  return result;
}

}  // namespace cleancolor
