// Every option at its extremes, alone and in pairs: refused with an Error, or a file that a printer can run.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.hpp"
#include "model/options.hpp"
#include "model/reach.hpp"
#include "model/settings.hpp"
#include "replay.hpp"
#include "sanitized.hpp"
#include "slicing.hpp"

namespace cleancolor {
namespace {

using namespace test;

constexpr double rounding_mm = 0.002;  // of coordinates in the file

// Labels and code of the user's own have no extremes.
std::vector<std::string> extremes(const Option& option) {
  const std::string min = fmt::format("{:g}", option.min), max = fmt::format("{:g}", option.max);
  std::vector<std::string> values;
  switch (option.kind()) {
    case OptionKind::flag:
      return {"0", "1"};
    case OptionKind::integer:
    case OptionKind::number:
      return {min, max, "0"};
    case OptionKind::percent:
      return {"0%", "1%", max + "%", "1000%"};
    case OptionKind::length_or_share:
      return {min, max, "0", "0%", "1%", "1000%"};
    case OptionKind::choice:
      for (const std::string_view choice : option.choices()) values.emplace_back(choice);
      return values;
    case OptionKind::point:
      return {"0x0", fmt::format("0x0,{0}x{0}", min), fmt::format("0x0,{0}x{0}", max)};
    case OptionKind::text:
    case OptionKind::polygon:
      return {};
  }
  return values;
}

std::vector<std::string> assignments(OptionGroup group) {
  std::vector<std::string> all;
  for (const Option& option : options()) {
    if (option.group != group) continue;
    for (const std::string& value : extremes(option)) all.push_back(fmt::format("{}={}", option.name, value));
  }
  return all;
}

// Not a number, infinite, or a speed of nothing, at which a printer stands still for ever.
bool has_impossible_number(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (line.starts_with('G') || line.starts_with('M')) {
      const std::string_view code = line.substr(0, line.find(';'));
      if (code.find("nan") != code.npos || code.find("inf") != code.npos) return true;
      if (code.ends_with(" F0") || code.find(" F0 ") != code.npos) return true;
    }
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
  return false;
}

void expect_within_reach(const Printed& printed, const Config& config) {
  std::vector<Polygons> areas;
  for (int e = 0; e < int(config.extruders.size()); ++e) areas.push_back(offset(reach(config, e), rounding_mm));
  for (const PrintedRoad& road : printed.roads) {
    ASSERT_TRUE(contains(areas[std::size_t(road.tool)], to_nm(road.to)))
        << road.role << " of T" << road.tool << " at " << road.to.x << " " << road.to.y;
  }
  for (const PrintedTravel& travel : printed.travels) {
    ASSERT_TRUE(contains(areas[std::size_t(travel.tool)], to_nm(travel.to)))
        << "travel of T" << travel.tool << " to " << travel.to.x << " " << travel.to.y;
  }
}

void expect_printable(const Sliced& result, const Config& config) {
  EXPECT_TRUE(std::isfinite(result.summary.time_s) && result.summary.time_s >= 0) << result.summary.time_s;
  for (const ExtruderUse& use : result.summary.extruders)
    EXPECT_TRUE(std::isfinite(use.filament_mm) && std::isfinite(use.cost)) << use.filament_mm << " " << use.cost;
  EXPECT_FALSE(has_impossible_number(result.text));
  const Printed printed = replayed(result.text, config);
  EXPECT_GT(printed.roads.size(), 0);
  for (const int percent : printed.percents) EXPECT_TRUE(percent >= 0 && percent <= 100) << percent;
  for (const PrintedRoad& road : printed.roads)
    ASSERT_GE(road.filament_mm, -1e-9) << road.role << " at " << road.to.x << " " << road.to.y;
  expect_within_reach(printed, config);
}

/// Two cubes of 10 mm side by side, one for each nozzle, in coarse layers with every width from the nozzle, on a bed
/// that leaves little room around them. Were they printed, that is, not refused?
bool expect_refused_or_printable(const std::vector<std::string>& options) {
  SCOPED_TRACE(fmt::format("{}", fmt::join(options, " ")));
  std::vector<std::string> set = {"nozzle_diameter=1.5,1.5", "layer_height=1", "first_layer_height=1",
                                  "thumbnails=", "bed_shape=0x0,45x0,45x35,0x35"};
  for (const char* width :
       {"", "first_layer_", "perimeter_", "external_perimeter_", "infill_", "solid_infill_", "top_infill_"})
    set.push_back(std::string(width) + "extrusion_width=0");
  set.insert(set.end(), options.begin(), options.end());
  try {
    const Config config = config_of({.printer = "generic-dual-marlin", .set = set});
    const TestFolder folder;
    const std::vector<Mesh> cubes = {box_mesh({0, 0, 0}, {10, 10, 10}), box_mesh({12, 0, 0}, {22, 10, 10})};
    expect_printable(sliced(folder, cubes, config), config);
  } catch (const SystemError& error) {
    ADD_FAILURE() << error.what();
  } catch (const Error& error) {
    EXPECT_STRNE(error.what(), "");
    return false;
  }
  return true;
}

void expect_all_refused_or_printable(OptionGroup group) {
  const std::vector<std::string> all = assignments(group);
  const auto printed = std::ranges::count_if(
      all, [](const std::string& assignment) { return expect_refused_or_printable({assignment}); });
  EXPECT_GT(printed, std::ssize(all) / 2) << "the options that this test adds to all are refused themselves";
}

TEST(Sweep, ExtremesOfThePrinterAreRefusedOrPrintable) {
  expect_all_refused_or_printable(OptionGroup::printer);
}

TEST(Sweep, ExtremesOfTheMaterialAreRefusedOrPrintable) {
  expect_all_refused_or_printable(OptionGroup::material);
}

TEST(Sweep, ExtremesOfThePrintAreRefusedOrPrintable) {
  expect_all_refused_or_printable(OptionGroup::print);
}

TEST(Sweep, PairsOfExtremesAreRefusedOrPrintable) {
  std::vector<std::string> all;
  for (const OptionGroup group : {OptionGroup::printer, OptionGroup::material, OptionGroup::print})
    for (std::string& assignment : assignments(group)) all.push_back(std::move(assignment));
  std::mt19937 random(1);  // the only seed: the trace names the pair
  for (int i = 0; i < trials(300); ++i)
    expect_refused_or_printable({all[random() % all.size()], all[random() % all.size()]});
}

}  // namespace
}  // namespace cleancolor
