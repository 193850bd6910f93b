#include "replan/replan.hpp"

#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <utility>

#include "audit/timeline.hpp"
#include "base/error.hpp"
#include "replan/attempts.hpp"
#include "replan/dialect_words.hpp"
#include "replan/times.hpp"

namespace cleancolor {
namespace {

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

Replanned unchanged(const GcodePrint& print, std::string reason) {
  return {.text = *print.text, .changed = false, .reason = std::move(reason)};
}

}  // namespace

Replanned replanned(const GcodePrint& print, const AuditMachine& machine, const ReplanRequest& request,
                    const Progress& progress) {
  if (std::string_view(*print.text).substr(0, head_bytes).find(replanned_mark) != std::string_view::npos)
    return unchanged(print, "it was re-planned before");
  require_known_dialect(print);
<<<<<<< HEAD
  const Attempts attempts(print, machine, request, progress);
  const bool judges = request.protection == ReplanProtection::full && !request.keeps_order;
  std::optional<Attempt> made = judges ? attempts.best() : attempts.with(RampartExtent::all);
  if (!made) return unchanged(print, "re-planned it would come out no cleaner than the time is worth");
  Replanned result;
  result.text = std::move(made->text);
  result.has_rampart = made->has_rampart;
  result.removed_mm3 = attempts.removed_mm3();
=======
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
>>>>>>> w-cura
  result.old_time_s = timeline(print, machine).print_time_s;
  const Timeline time = timeline(made->print, machine);
  result.time_s = time.print_time_s;
  if (result.old_time_s <= 0) return result;
  const double told_share = print.facts.told_time_s > 0 ? print.facts.told_time_s / result.old_time_s : 1;
  if (attempts.tells_progress()) result.text = with_progress(made->print, time, told_share);
  correct_estimates(result.text, print, result.time_s / result.old_time_s);
  return result;
}

}  // namespace cleancolor
