// plan/cleaner_tour.hpp
//
// Cleaner tour: the order of a layer's paths in which idle nozzles are predicted to smear least, and the tour through
// it.
//
//   paths in an allowed order, a tour through them  ->  paths and entries in a better order, its tour
//
// For each run of one extruder the search of exposure_order.hpp; then a tour that minds what paths smear, depending on
// where they are begun. Of both tours the one that is predicted to be cleaner.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plan/exposure_order.hpp"
#include "plan/tour.hpp"

namespace cleancolor {

/// Of an extruder.
OrderWeights order_weights(const Config& config, int extruder);

/// visits: a tour through the paths as they are. Paths, the roadmap's entries and options.entry_cost become those of
/// the tour returned.  Requires: paths not empty.  Cost: that of exposure_order for each run, and of a tour.
std::vector<Visit> cleaner_tour(std::span<Path> paths, Roadmap& roads, const TravelCost& cost, const Config& config,
                                std::uint32_t seed, std::vector<Visit> visits, TourOptions& options);

}  // namespace cleancolor
