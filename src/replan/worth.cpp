#include "replan/worth.hpp"

#include <algorithm>

#include "audit/audit.hpp"

namespace cleancolor {
namespace {

constexpr double most_longer = 1.3;                       // times the file's time
constexpr double late_weight = 10;                        // of each second beyond
constexpr double worth_planning = 0.05;                   // longer by a rampart
constexpr double passed_share = 0.02, passed_mm3 = 0.05;  // of smears and weighted holes: the error of a forecast
// What a good order alone leaves of smears and holes, at best: of seven models it leaves a quarter to all of the one
// and half to all of the other, but for those that are clean already.
constexpr double least_smear_left = 0.2, least_holes_left = 0.5;

double spoilt_mm3(const Cleanness& print, const Config& config) {
  return print.smear_mm3 + config.weight_hole_volume * print.hole_mm3;
}

}  // namespace

Cleanness cleanness(const GcodePrint& print, const AuditMachine& machine, int threads, const Progress& progress) {
  AuditOptions options;
  options.scenarios = {scenarios().front()};
  options.threads = threads;
  const AuditResult result =
      audit(print, machine, options,
            {.warn = [](const std::string&) {}, .advance = progress.advance, .interrupted = progress.interrupted});
  const Figures& total = result.scenarios.front().total;
  return {total.smear_volume(), total.hole_volume, result.print_time_s};
}

double print_cost(const Cleanness& print, const Cleanness& before, const Config& config) {
  const double late_s = std::max(0., print.time_s - most_longer * before.time_s);
  return spoilt_mm3(print, config) + config.weight_time * (print.time_s + (late_weight - 1) * late_s);
}

std::vector<RampartExtent> worth_trying(const Cleanness& with_rampart, const Cleanness& before, const Config& config) {
  const double cost = print_cost(with_rampart, before, config);
  if (with_rampart.time_s <= (1 + worth_planning) * before.time_s) return {};
  std::vector<RampartExtent> result{RampartExtent::column};
  const Cleanness at_best{least_smear_left * before.smear_mm3, least_holes_left * before.hole_mm3, before.time_s};
  if (print_cost(at_best, before, config) < cost) result.push_back(RampartExtent::none);
  return result;
}

bool is_worth_it(const Cleanness& print, const Cleanness& before, const Config& config) {
  const double now_mm3 = spoilt_mm3(print, config), before_mm3 = spoilt_mm3(before, config);
  const double error_mm3 = passed_share * before_mm3 + passed_mm3;
  if (now_mm3 > before_mm3 + error_mm3) return false;
  const bool saves_more_than_it_takes = now_mm3 < before_mm3 - error_mm3 &&
                                        now_mm3 * print.time_s < before_mm3 * before.time_s &&
                                        print.time_s <= most_longer * before.time_s;
  return saves_more_than_it_takes || print_cost(print, before, config) < print_cost(before, before, config);
}

}  // namespace cleancolor
