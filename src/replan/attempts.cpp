#include "replan/attempts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>

#include "audit/timeline.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "reader/read.hpp"
#include "replan/cura.hpp"
#include "replan/dialect_words.hpp"
#include "replan/found_roles.hpp"
#include "replan/heaters.hpp"
#include "replan/kept_print.hpp"
#include "replan/kept_shield.hpp"
#include "replan/planning.hpp"
#include "replan/planning_config.hpp"
#include "replan/removed.hpp"
#include "replan/same_print.hpp"
#include "replan/written.hpp"

namespace cleancolor {
namespace {

std::string header_line(const ReplanRequest& request, bool has_rampart) {
  std::string what = request.keeps_order ? "order and travel kept" : "order and travel ";
  if (!request.keeps_order) {
    what += request.protection == ReplanProtection::full ? "planned" : "plain";
    if (request.keeps_seams) what += ", seams kept";
    what += has_rampart ? ", rampart added" : ", no rampart";
  }
  return fmt::format("{}{}: {}; paths and settings as sliced", replanned_mark, CLEANCOLOR_VERSION, what);
}

}  // namespace

Attempts::Attempts(const GcodePrint& print, const AuditMachine& machine, const ReplanRequest& request,
                   const Progress& progress)
    : print_(print),
      machine_(machine),
      request_(request),
      progress_(progress),
      config_(planning_config(print, machine, request.printer ? &*request.printer : nullptr)) {
  if (request.protection == ReplanProtection::none) config_.rampart = RampartShape::off;
  if (request.protection != ReplanProtection::full) config_.planner = Planner::plain;
  if (print.facts.dialect == Dialect::slic3r && !tells_roles(print)) {
    if (request.removes_shield)
      throw Error(fmt::format("{}: it does not say which roads are a shield; slice without it", print.name));
    with_roles_ = with_found_roles(print, machine);
  }
  if (print.facts.dialect == Dialect::cura) with_roles_ = with_ironing(print);
  recovered_ = recovered_print(source());
  if (request.removes_shield) removed_ = remove_shield(recovered_, source());
  if (request.removes_tower) removed_.merge(remove_tower(recovered_, source()));
  if (request.keeps_order) return;
  progress.advance("regions", 0);
  scene_ = scene_of(recovered_, source(), machine, request.keeps_seams, request.threads);
  if (config_.planner == Planner::plain) return;
  std::vector<double> height_mm;
  for (const Slab& slab : scene_.storeys.part.slabs) height_mm.push_back(slab.height_mm);
  visibility_.emplace(scene_.storeys.part.outlines, height_mm, SurfaceVisibilityOptions{.threads = request.threads},
                      progress);
}

GcodePrint Attempts::read(std::string text) const {
  GcodePrint made = read_gcode(std::move(text), print_.name);
  const DialectWords& words = *words_of(print_);
  if (!words.times_heaters || !sets_temperatures(recovered_, print_)) return made;
  return read_gcode(with_heaters(recovered_, print_, made, machine_, words.layer_begins.front()), print_.name);
}

Attempt Attempts::planned(RampartExtent extent) const {
  Attempt made;
  Progress own = progress_;
  own.warn = [&](const std::string& warning) { made.warnings.push_back(warning); };
  std::string text;
  {
    const ReplanOptions options{.visibility = visibility_ ? &*visibility_ : nullptr,
                                .knows_bed = print_.facts.dialect != Dialect::cura || request_.printer,
                                .rampart = extent,
                                .threads = request_.threads};
    const ReplannedLayers planned = planned_layers(scene_, recovered_, source(), machine_, config_, options, own);
    progress_.advance("writing", 0);
    made.has_rampart = planned.has_rampart;
    made.stands_apart = planned.stands_apart;
    text = written(recovered_, source(), machine_, config_, planned.layers, header_line(request_, planned.has_rampart));
  }
  made.print = read(std::move(text));
  return made;
}

Attempt Attempts::kept() const {
  Attempt made;
  made.print = read(written_as_in_file(recovered_, source(), config_, header_line(request_, false)));
  require_same(made.print);
  return made;
}

void Attempts::require_same(const GcodePrint& made) const {
  if (const auto what = difference(print_, made, machine_, {removed_, request_.threads}))
    throw Error(
        fmt::format("{}: re-planned it would not be the same print: {}; the file is left as it is. Please "
                    "report it",
                    print_.name, *what));
}

Attempt Attempts::with(RampartExtent extent) const {
  Attempt made = planned(extent);
  require_same(made.print);
  for (const std::string& warning : made.warnings) progress_.warn(warning);
  return made;
}

Attempt Attempts::judged(RampartExtent extent) const {
  Attempt made = planned(extent);
  parallel_for(2, request_.threads, [&](int i) {
    if (i == 0)
      require_same(made.print);
    else
      made.cleanness = cleanness(made.print, machine_, request_.threads, progress_);
  });
  return made;
}

std::optional<Attempt> Attempts::best() const {
  Attempt best;
  Cleanness before;
  // A rampart is made one layer after the other: meanwhile another thread can judge the file.
  std::exception_ptr refused;
  std::atomic<bool> is_refused = false;
  const Progress quiet{.interrupted = [&] { return is_refused || progress_.interrupted(); }};
  parallel_for(2, request_.threads, [&](int i) {
    try {
      if (i == 0)
        best = judged(RampartExtent::all);
      else
        before = cleanness(print_, machine_, 1, quiet);
    } catch (...) {
      if (i == 0) refused = std::current_exception();
      if (i != 0 && !is_refused) throw;
      is_refused = true;
    }
  });
  if (refused) std::rethrow_exception(refused);
  const std::vector<RampartExtent> others =
      best.has_rampart ? worth_trying(best.cleanness, before, config_) : std::vector<RampartExtent>{};
  const bool had_rampart = best.has_rampart, stands_apart = best.stands_apart;
  for (const RampartExtent extent : others) {
    if (extent == RampartExtent::column && !stands_apart) continue;
    try {
      Attempt other = judged(extent);
      if (print_cost(other.cleanness, before, config_) < print_cost(best.cleanness, before, config_))
        best = std::move(other);
    } catch (const Error&) {  // the first one is good all the same
      if (progress_.interrupted()) throw;
    }
  }
  if (!is_worth_it(best.cleanness, before, config_)) return std::nullopt;
  if (had_rampart && !best.has_rampart)
    progress_.warn(
        fmt::format("{}: a rampart would take more time than it is worth; it is re-planned without one", print_.name));
  for (const std::string& warning : best.warnings) progress_.warn(warning);
  best.before = before;
  return best;
}

std::string Attempts::advice() const {
  const bool has_tower = std::ranges::any_of(
      scene_.stops, [](const std::vector<Stop>& stops) { return std::ranges::any_of(stops, &Stop::lays); });
  const bool has_shield = scene_.has_shield;
  const char* options = !has_shield  ? "--remove-tower makes"
                        : !has_tower ? "--remove-shield makes"
                                     : "--remove-tower and --remove-shield make";
  return fmt::format(", unless {} room for a rampart", options);
}

double Attempts::removed_mm3() const {
  double sum = 0;
  for (const auto& [what, mm] : removed_) sum += mm * filament_area_mm2(machine_, what.first);
  return sum;
}

}  // namespace cleancolor
