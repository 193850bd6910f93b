// plan/tour.hpp
//
// Tour: the cheapest way through all paths of a layer in a given order: where each is begun, and how to get there.
//
//   roadmap, paths in order  ->  for each path its start, and the places passed on the way to it
//
// One shortest path search in stages: stage k starts from all places where path k can be left, at their cost so far,
// and ends at all places where path k + 1 can be entered. So a start is chosen for the way to it and for the way on.
// Open paths are walked in either direction. Entering and leaving a path where it can be seen costs extra.
//
// Layers are planned side by side, so where a layer comes from is not known yet. Where its first path can be begun
// anywhere, the search from the end back gives the cost to go from each start, and the start is chosen afterwards.
//
// Source: Hergel and Lefebvre, Clean color, section 6.4.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "plan/roadmap.hpp"

namespace cleancolor {

/// How one path of the order is walked.
struct Visit {
  std::uint32_t entry = 0;      // of Roadmap::entries of the path
  std::vector<Vec2> travel_mm;  // places of the carriage on the way here, both ends left out
  double travel_cost = 0;
  double travel_way_mm = 0;
};

struct TourOptions {
  std::optional<Vec2> from_mm;  // where the carriage is; nothing: anywhere
  double slack_mm = 15;         // a stage goes on so far beyond its best entry

  /// What walking the path from this entry costs, beside the way there; nothing: 0.
  std::function<double(std::size_t path, std::uint32_t entry)> entry_cost;
};

/// Visits of all paths in their order.
/// Cost: about 2 ms for 50 paths and 2500 nodes.
std::vector<Visit> tour(const Roadmap& map, std::span<const Path> paths, const TravelCost& cost,
                        const TourOptions& options = {});

/// The cheapest tour from each entry of the first path, for a start that is chosen when the layer below is planned.
struct CostToGo {
  std::vector<double> cost;                      // [entry of the first path]: of its walk and all that follows
  std::vector<std::vector<std::uint16_t>> next;  // [path][its entry]: the entry of the next path
};

/// The same search from the last path to the first. Costs are those of tour(), whose own hold for the cheapest start
/// alone, within 1 % where what oozes out on the way matters; they are infinite where no way within slack_mm leads on.
/// options.from_mm is not looked at. Cost: as tour(); memory: some 2 bytes for each entry of all paths.
CostToGo cost_to_go(const Roadmap& map, std::span<const Path> paths, const TravelCost& cost,
                    const TourOptions& options = {});

/// The entry of the first path with the least cost of the way there and all that follows; the first of equals.
std::uint32_t cheapest_start(const Roadmap& map, const Path& first, const TravelCost& cost, const CostToGo& to_go,
                             Vec2 from_mm);

/// The visit of path k from an entry of path k - 1.  Requires: k > 0.
Visit visit_from(const Roadmap& map, std::span<const Path> paths, const TravelCost& cost, std::size_t k,
                 std::uint32_t entry_before, std::uint32_t entry);

/// The cheapest way from one node to each of others, for the nozzle of an extruder.
struct WayLength {
  double cost = 0, way_mm = 0;
};
std::vector<WayLength> ways(const Roadmap& map, const TravelCost& cost, int extruder, std::uint32_t from,
                            std::span<const std::uint32_t> to);

/// A way between any two places of the carriage, for the nozzle of an extruder.
struct PlannedWay {
  std::vector<Vec2> between_mm;  // places passed, both ends left out
  double cost = 0, way_mm = 0;
};
PlannedWay way_between(const Roadmap& map, const TravelCost& cost, int extruder, Vec2 from_mm, Vec2 to_mm);

/// The path begun at the entry.
Path begun(Path path, const Roadmap& map, std::size_t index, std::uint32_t entry);

}  // namespace cleancolor
